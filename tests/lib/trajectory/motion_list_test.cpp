#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "lib/math/random.h"
#include "lib/scenario/scenario_list.h"
#include "lib/trajectory/motion_scenarios.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"
#include "solvers/lp/makers.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/task_in_time.h"

// Lists of scenarios in time: the value is the least of the values of the scenarios, each alone.

namespace maxwrench {
namespace {

constexpr const char* kSenses = "set = [[0,0,0,0,0,1], [0,0,0,0,0,-2]]";
constexpr const char* kTwoLosses =
    "[loss]\ncases = [['front_left_vertical'], ['rear_right_vertical']]\n";

std::unique_ptr<TrajectorySolver> list_ipm() { return make_trajectory_ipm(); }

/// The task of one scenario of a list.
Problem alone(const Problem& problem, const ScenarioChoice& choice) {
  Problem one = problem;
  const ScenarioList& list = problem.scenarios;
  one.scenarios.wrenches = {list.wrenches[static_cast<std::size_t>(choice.wrench)]};
  one.scenarios.limits = {list.limits[static_cast<std::size_t>(choice.limits)]};
  return one;
}

Trajectory trajectory_of(const Problem& problem, const Eigen::MatrixXd& knots,
                         const TrajectorySolverMaker& make, Wrench wrench = Wrench::kPure) {
  TrajectoryEvaluator evaluator(problem, wrench, make, false);
  evaluator.evaluate(knots);
  evaluator.evaluate_between_knots();
  return evaluator.trajectory();
}

Eigen::MatrixXd shaken(const Problem& problem, std::uint64_t seed, double by) {
  Random random(seed);
  Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
  for (double& q : knots.reshaped()) q += random.uniform(-by, by);
  return knots;
}

/// A list of one scenario is the task, bit for bit.
TEST(MotionList, OfOneIsTheTask) {
  for (const char* name : {"valve_trajectory", "valve_impulse"}) {
    const Problem list = task_in_time(name, "set = [[0,0,0,0,0,1]]", "");
    const Problem task = task_in_time(name, "c = [0,0,0,0,0,1]", "");
    ASSERT_FALSE(list.scenarios.empty());
    ASSERT_TRUE(task.scenarios.empty());
    const Eigen::MatrixXd knots = constant_knots(task, task.theta_r_default);
    for (const TrajectorySolverMaker& make :
         {TrajectorySolverMaker(make_facets_or_ipm), TrajectorySolverMaker(list_ipm)}) {
      const Trajectory a = trajectory_of(list, knots, make), b = trajectory_of(task, knots, make);
      ASSERT_EQ(a.status, Status::kOptimal) << name << ": " << a.reason.c_str();
      EXPECT_EQ(a.value, b.value) << name;
      EXPECT_EQ(a.value_between_knots, b.value_between_knots) << name;
      EXPECT_EQ(a.gradient, b.gradient) << name;
      EXPECT_EQ(a.solution.u, b.solution.u) << name;
    }
  }
}

/// Lists of each form.
struct MotionListForm {
  const char *name, *task, *wrench, *tables;
  double rates = 1;  ///< factor of the limits of effort rates
};

const MotionListForm kMotionListForms[] = {
    {"senses", "valve_trajectory", kSenses, ""},
    {"losses", "valve_trajectory", "", kTwoLosses},
    {"weaker", "valve_trajectory", "", "[uncertainty]\nthrust = 0.1\ntorque = 0.05\n"},
    {"all", "valve_trajectory", "set = [[0,0,0,0,0,1], [0,0,5,0,0,1]]", kTwoLosses},
    {"hold", "valve_trajectory", "c = [0,0,0,0,0,1]\nhold = true", kTwoLosses},
    {"slow", "valve_trajectory", kSenses, kTwoLosses, 0.1},
    {"impulse", "valve_impulse", kSenses, ""},
    {"impulse, losses", "valve_impulse", "", kTwoLosses},
};

/// Each scenario alone is a task of its own; the list holds the least of their values, and the one
/// that decides has it.
TEST(MotionList, HoldsTheLeastValueOfItsScenarios) {
  for (const MotionListForm& form : kMotionListForms) {
    Problem problem = task_in_time(form.task, form.wrench, form.tables);
    problem.robot.u_rate_max *= form.rates;
    const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
    double least = kInfinity, least_between = kInfinity;
    std::string decides;
    for (const ScenarioChoice& choice : all_scenarios(problem.scenarios)) {
      if (problem.scenarios.wrenches[static_cast<std::size_t>(choice.wrench)].hold) continue;
      const Problem one = alone(problem, choice);
      const Trajectory each = trajectory_of(one, knots, list_ipm);
      ASSERT_EQ(each.status, Status::kOptimal) << form.name << ": " << each.reason.c_str();
      least_between = std::min(least_between, each.value_between_knots);
      if (each.value >= least) continue;
      least = each.value;
      decides = describe(problem.scenarios, choice);
    }
    for (const TrajectorySolverMaker& make :
         {TrajectorySolverMaker(make_facets_or_ipm), TrajectorySolverMaker(list_ipm)}) {
      const Trajectory all = trajectory_of(problem, knots, make);
      ASSERT_EQ(all.status, Status::kOptimal) << form.name << ": " << all.reason.c_str();
      EXPECT_NEAR(all.value, least, 1e-6 * (1 + least)) << form.name;
      EXPECT_NEAR(all.value_between_knots, least_between, 1e-6 * (1 + least)) << form.name;
      EXPECT_EQ(describe(problem.scenarios, all.decides), decides) << form.name;
      ASSERT_GE(all.decides_at, 0);
      ASSERT_LT(all.decides_at, static_cast<int>(all.instants.size()));
      const Instant& at = all.instants[static_cast<std::size_t>(all.decides_at)];
      EXPECT_NEAR(at.beta(), all.value, 1e-6 * (1 + least)) << form.name;
      EXPECT_LT((at.h - at.beta() * at.c).norm(), 1e-9 * (1 + at.h.norm())) << form.name;
      // The efforts of the scenario that decides balance every instant within its limits.
      const Zonotope& set =
          problem.scenarios.limits[static_cast<std::size_t>(all.decides.limits)].actuation;
      for (const Instant& each : all.instants) {
        EXPECT_LT((set.B * each.u - each.tau_d - each.J.transpose() * each.h).norm(), 1e-6)
            << form.name << " at " << each.t;
        EXPECT_TRUE(((each.u - set.u_max).array() < 1e-6).all()) << form.name << " at " << each.t;
        EXPECT_TRUE(((set.u_min - each.u).array() < 1e-6).all()) << form.name << " at " << each.t;
      }
    }
  }
}

/// More scenarios never raise the value.
TEST(MotionList, MoreScenariosNeverRaiseTheValue) {
  const Problem one = task_in_time("valve_trajectory", "set = [[0,0,0,0,0,1]]", "");
  const Problem two = task_in_time("valve_trajectory", "set = [[0,0,0,0,0,1], [0,0,5,0,0,1]]", "");
  const Problem six =
      task_in_time("valve_trajectory", "set = [[0,0,0,0,0,1], [0,0,5,0,0,1]]", kTwoLosses);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Eigen::MatrixXd knots = shaken(one, seed, 0.02);
    const double a = trajectory_of(one, knots, make_facets_or_ipm).value;
    const double b = trajectory_of(two, knots, make_facets_or_ipm).value;
    const double c = trajectory_of(six, knots, make_facets_or_ipm).value;
    EXPECT_LE(b, a + 1e-7) << seed;
    EXPECT_LE(c, b + 1e-7) << seed;
  }
}

/// Central differences of the value, where one scenario decides.
TEST(MotionList, GradientIsThatOfTheScenarioThatDecides) {
  constexpr double kStep = 1e-6;
  for (const auto& [name, wrench] :
       {std::pair("valve_trajectory", Wrench::kPure), std::pair("valve_trajectory", Wrench::kAny),
        std::pair("valve_impulse", Wrench::kPure)}) {
    const Problem problem =
        task_in_time(name, "set = [[0,0,0,0,0,1], [0,0,2,0,0,1.5]]", kTwoLosses);
    TrajectoryEvaluator evaluator(problem, wrench, make_facets_or_ipm, false);
    const bool impulse = std::string(name) == "valve_impulse";
    Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
    if (!impulse) knots = shaken(problem, 3, 0.01);
    const Trajectory at = evaluator.evaluate(knots);
    ASSERT_EQ(at.status, Status::kOptimal) << name << ": " << at.reason.c_str();
    for (Eigen::Index i = 0; i < knots.size(); i += 7) {
      Eigen::MatrixXd moved = knots;
      moved.reshaped()[i] += kStep;
      const Trajectory up = evaluator.evaluate(moved);
      moved.reshaped()[i] -= 2 * kStep;
      const Trajectory down = evaluator.evaluate(moved);
      if (up.status != Status::kOptimal || down.status != Status::kOptimal) continue;
      const double right = (up.value - at.value) / kStep, left = (at.value - down.value) / kStep;
      const double slack = 2e-3 * (1 + std::abs(right));
      const double slope = at.gradient.reshaped()[i];
      EXPECT_GE(slope, std::min(left, right) - slack) << name << " " << i;
      EXPECT_LE(slope, std::max(left, right) + slack) << name << " " << i;
    }
  }
}

/// A scenario that no efforts balance is named.
TEST(MotionList, NamesTheScenarioThatIsInfeasible) {
  const Problem problem = task_in_time(
      "valve_trajectory", "",
      "[loss]\ncases = [['front_left_vertical'], ['front_left_horizontal', 'rear_left_horizontal', "
      "'front_right_horizontal']]\n");
  const Trajectory trajectory =
      trajectory_of(problem, constant_knots(problem, problem.theta_r_default), make_facets_or_ipm);
  EXPECT_EQ(trajectory.status, Status::kInfeasible);
  EXPECT_THAT(trajectory.reason.str(), testing::HasSubstr("front_left_horizontal dead and "));
  EXPECT_EQ(trajectory.decides_at, -1);
}

/// With one factor at all instants the interval of a list is what all its scenarios permit: the
/// payload of a robot with either of two dead thrusters.
TEST(MotionList, PayloadOfLossesIsTheLeast) {
  const std::string folder = MAXWRENCH_SOURCE_DIR "/examples/tasks/";
  std::string text = read_text(folder + "carry_steel_along.toml");
  text.replace(text.find("../../"), 6, MAXWRENCH_SOURCE_DIR "/");
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "task.toml") << text << "\n" << kTwoLosses;
  const Problem problem = load_problem((temporary.path() / "task.toml").string());
  EXPECT_EQ(std::string(problem.unit()), "kg");
  const Eigen::MatrixXd knots = default_knots(problem);
  double least = kInfinity;
  for (const ScenarioChoice& choice : all_scenarios(problem.scenarios)) {
    const Trajectory each = trajectory_of(alone(problem, choice), knots, make_facets_or_ipm);
    ASSERT_EQ(each.status, Status::kOptimal) << each.reason.c_str();
    least = std::min(least, each.value);
  }
  for (const TrajectorySolverMaker& make :
       {TrajectorySolverMaker(make_facets_or_ipm), TrajectorySolverMaker(list_ipm)}) {
    const Trajectory all = trajectory_of(problem, knots, make);
    ASSERT_EQ(all.status, Status::kOptimal) << all.reason.c_str();
    EXPECT_NEAR(all.value, least, 1e-6);
  }
  // Nothing lost, the arm carries 2.925898 kg (independent model).
  const Problem intact = nominal(problem);
  EXPECT_TRUE(intact.scenarios.empty());
  EXPECT_NEAR(trajectory_of(intact, knots, make_facets_or_ipm).value, 2.925898, 1e-6);
  EXPECT_LT(least, 2.925898);
}

/// The general solver of the assembled program agrees.
TEST(MotionList, SLOW_AssembledProgramAgrees) {
  for (const MotionListForm& form : kMotionListForms) {
    Problem problem = task_in_time(form.task, form.wrench, form.tables);
    problem.robot.u_rate_max *= form.rates;
    if (problem.motion->impulse) problem.motion->instants_per_interval = 4;
    const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
    TrajectoryEvaluator evaluator(problem, Wrench::kPure, list_ipm, false);
    const Trajectory by_ipm = evaluator.evaluate(knots);
    ASSERT_EQ(by_ipm.status, Status::kOptimal) << form.name << ": " << by_ipm.reason.c_str();
    EXPECT_TRUE(recheck(evaluator.program(), by_ipm.solution).within(1e-6)) << form.name;
    const auto simplex = make_assembled_trajectory(make_simplex(), true);
    TrajectorySolution solution;
    simplex->solve(evaluator.program(), solution);
    ASSERT_EQ(solution.status, Status::kOptimal) << form.name << ": " << solution.reason.c_str();
    EXPECT_NEAR(solution.value, by_ipm.value, 1e-6 * (1 + by_ipm.value)) << form.name;
  }
}

/// A wrench of another length has a factor in proportion, also where the start holds a static
/// wrench and slow thrusters keep the peak near it.
TEST(MotionList, FactorsAreInverseToTheLengthOfTheWrench) {
  const auto value_of = [](const std::string& wrench) {
    Problem problem = task_in_time("valve_impulse", wrench, "");
    problem.robot.u_rate_max *= 0.005;
    const Eigen::MatrixXd knots = constant_knots(problem, problem.theta_r_default);
    return trajectory_of(problem, knots, list_ipm).value;
  };
  const double alone = value_of("c = [0,0,0,0,0,1]");
  EXPECT_NEAR(0.2 * value_of("set = [[0,0,0,0,0,0.2]]"), alone, 1e-6 * alone);
  EXPECT_NEAR(5 * value_of("set = [[0,0,0,0,0,5]]"), alone, 1e-6 * alone);
}

}  // namespace
}  // namespace maxwrench
