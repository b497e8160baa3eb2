#include "solvers/solve/tank_scenarios.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/tank.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/scenario_task.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

std::string example(const std::string& name) {
  return MAXWRENCH_SOURCE_DIR "/examples/tasks/" + name + ".toml";
}

Answer answer_at_default(const Problem& problem) {
  return evaluate(problem, problem.theta_r_default);
}

/// Each scenario alone has the interval that the list gives it.
TEST(ScenarioAlone, HasTheEndsOfItsScenario) {
  for (const char* name : {"turn_both_ways", "lift_with_a_dead_thruster"}) {
    const Problem problem = load_problem(example(name));
    const Answer answer = answer_at_default(problem);
    const std::vector<ScenarioEnds> ends = scenario_ends(answer);
    ASSERT_EQ(static_cast<std::size_t>(scenario_count(problem)), ends.size());
    for (int i = 0; i < scenario_count(problem); ++i) {
      const ScenarioTask one = scenario_alone(problem, i);
      EXPECT_EQ(one.name, ends[static_cast<std::size_t>(i)].name);
      const Answer alone = answer_at_default(one.task);
      EXPECT_NEAR(alone.beta() / one.length, ends[static_cast<std::size_t>(i)].high, 1e-9)
          << one.name;
    }
  }
}

/// What is dead has no column and exerts nothing.
TEST(ScenarioAlone, LeavesOutWhatIsDead) {
  const Problem problem = load_problem(example("lift_with_a_dead_thruster"));
  const ScenarioTask intact = scenario_alone(problem, 0), lost = scenario_alone(problem, 1);
  EXPECT_EQ(intact.task.robot.actuation.B, problem.robot.actuation.B);
  int dead = 0;
  for (Eigen::Index i = 0; i < problem.robot.actuators(); ++i) {
    dead += lost.task.robot.actuation.B.col(i).isZero(0);
  }
  EXPECT_EQ(dead, 1);
  EXPECT_TRUE(intact.task.scenarios.empty());
}

TEST(TankScenarios, SLOW_TheValueOfAListIsHeldInEachScenario) {
  const Problem problem = load_problem(example("lift_with_a_dead_thruster"));
  TankOptions options;
  options.until_hold = true;
  options.hold = 2;
  const ScenarioExperiments experiments =
      simulate_scenarios(answer_at_default(problem), 0, "cvode", options);
  EXPECT_EQ(experiments.status, Status::kReached) << experiments.reason.c_str();
  EXPECT_NEAR(experiments.planned, 14.55665, 5e-5);  // an independent model
  ASSERT_EQ(experiments.all.size(), 9u);
  EXPECT_TRUE(experiments.held());
  for (const ScenarioExperiment& each : experiments.all) {
    EXPECT_NEAR(each.factor(), experiments.planned, 0.02 * experiments.planned)
        << each.scenario.name;
    EXPECT_LE(experiments.worst().factor(), each.factor());
  }
}

/// More than the value is held in some scenarios only, and the worst one is named.
TEST(TankScenarios, SLOW_MoreThanTheValueIsNotHeldByTheOneThatDecides) {
  const Problem problem = load_problem(example("lift_with_a_dead_thruster"));
  TankOptions options;
  options.until_hold = true;
  options.hold = 2;
  const Answer answer = answer_at_default(problem);
  const ScenarioExperiments experiments = simulate_scenarios(answer, 20, "cvode", options);
  EXPECT_FALSE(experiments.held());
  EXPECT_TRUE(experiments.all.front().experiment.run.summary.held);  // nothing is lost
  EXPECT_THAT(experiments.worst().scenario.name, HasSubstr("dead"));
  EXPECT_FALSE(experiments.worst().experiment.run.summary.held);
}

/// Readings are those of each wrench: both senses, of lengths 1 and 2, and none.
TEST(TankScenarios, SLOW_EachScenarioExertsItsOwnWrench) {
  Problem problem = load_problem(example("turn_both_ways"));
  problem.scenarios.wrenches[1].c *= 2;
  problem.scenarios.wrenches.push_back({.name = "hold", .hold = true});
  TankOptions options;
  options.until_hold = true;
  options.hold = 2;
  const ScenarioExperiments experiments =
      simulate_scenarios(answer_at_default(problem), 2, "cvode", options);
  ASSERT_EQ(experiments.all.size(), 3u);
  EXPECT_TRUE(experiments.held());
  EXPECT_NEAR(experiments.all[0].experiment.run.summary.mean, 2, 0.04);
  EXPECT_NEAR(experiments.all[0].experiment.run.samples.back().h_e[5], 2, 0.04);
  EXPECT_NEAR(experiments.all[1].experiment.run.samples.back().h_e[5], -4, 0.08);
  EXPECT_NEAR(experiments.all[1].factor(), 2, 0.04);
  EXPECT_NEAR(experiments.all[2].experiment.run.samples.back().h_e[5], 0, 0.08);
  EXPECT_TRUE(std::isnan(experiments.all[2].factor()));
}

/// A loss that the list has is survived when it comes, whatever wrench it is.
TEST(TankScenarios, SLOW_DeathsAreAddedToTheWrenchesOfTheIntactRobot) {
  const Problem problem = load_problem(example("lift_with_a_dead_thruster"));
  TankOptions options;
  options.until_hold = true;
  options.hold = 10;
  options.deaths = {death_of(problem.robot, "dies", "rear_left_vertical", 7)};
  const ScenarioExperiments experiments =
      simulate_scenarios(answer_at_default(problem), 0, "cvode", options);
  ASSERT_EQ(experiments.all.size(), 1u);
  EXPECT_EQ(experiments.all[0].scenario.name, "nominal");
  EXPECT_TRUE(experiments.held()) << experiments.all[0].experiment.run.summary.missed;
}

TEST(TankScenarios, SLOW_PlansInTimeAreCarriedOutInEachScenario) {
  const Problem problem = load_problem(example("turn_along_with_a_dead_thruster"));
  const TrajectorySolverEntry& lp = trajectory_solvers().front();
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, lp.make);
  evaluator.evaluate(default_knots(problem));
  evaluator.evaluate_between_knots();
  const ScenarioExperiments experiments = simulate_scenarios(
      problem, evaluator.trajectory(), Wrench::kPure, lp, {}, "cvode", TankOptions());
  ASSERT_EQ(experiments.all.size(), 3u);
  EXPECT_NEAR(experiments.planned, 12.072, 0.01);
  EXPECT_TRUE(experiments.held());
}

TEST(TankScenarios, RejectsWhatTheTankCannotBe) {
  for (const char* name : {"push_anywhere", "carry_steel", "turn_guaranteed", "turn_in_current",
                           "carry_steel_along"}) {
    const Problem problem = load_problem(example(name));
    if (problem.scenarios.empty()) continue;  // a payload in time has no list
    EXPECT_THAT(rejection_of([&] { require_tank_scenarios(problem); }),
                HasSubstr("for the virtual tank"))
        << name;
  }
}

/// A brake or friction is rejected, weaker or stronger than the motor or exactly as strong.
TEST(TankScenarios, RejectsBrakesAndFriction) {
  const double motor = load_problem("uvms/lift").robot.actuation.u_max.tail<1>()[0];
  for (const double left : {0.5 * motor, motor, 2 * motor}) {
    for (const bool locks : {false, true}) {
      const std::string loss =
          fmt::format("[loss]\nactuators = [\"q4_wrist_roll\"]\nany = 1\n{} = {}\n",
                      locks ? "joints = \"locked\"\nbrake" : "friction", left);
      const Problem problem = scenario_task(kLift, loss);
      EXPECT_THAT(rejection_of([&] { require_tank_scenarios(problem); }),
                  HasSubstr("locked or has friction"))
          << loss;
      EXPECT_TRUE(supported_integrators(problem, Case().measure).empty());
    }
  }
  require_tank_scenarios(
      scenario_task(kLift, "[loss]\nactuators = [\"q4_wrist_roll\"]\nany = 1\n"));
  EXPECT_FALSE(supported_integrators(load_problem("uvms/lift"), Case().measure).empty());
}

}  // namespace
}  // namespace maxwrench
