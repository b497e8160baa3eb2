#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

TrajectorySolution solve_by_ipm(const TrajectoryProgram& program) {
  TrajectorySolution solution;
  make_trajectory_ipm()->solve(program, solution);
  return solution;
}

TEST(TrajectoryIpm, WithoutRatesTheWorstInstantDecides) {
  const Problem problem = load_problem("uvms/valve");
  Random random(1);
  const auto box = find_wrench_solver("condensed").make();
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    for (int sample = 0; sample < 20; ++sample) {
      TrajectoryRecipe recipe;
      recipe.instants = 5;
      recipe.wrench = wrench;
      recipe.rates = false;
      recipe.load = 0.03;
      const TrajectoryProgram program = random_trajectory(problem, recipe, random);
      double worst = kInfinity;
      bool feasible = true;
      for (const WrenchProgram& at : program.instants) {
        Capability capability;
        box->solve(at, false, capability);
        feasible = feasible && capability.status == Status::kOptimal;
        worst = std::min(worst, capability.beta);
      }
      const TrajectorySolution solution = solve_by_ipm(program);
      ASSERT_EQ(solution.status, feasible ? Status::kOptimal : Status::kInfeasible);
      if (!feasible) continue;
      EXPECT_NEAR(solution.value, worst, 1e-8 * (1 + std::abs(worst)));
    }
  }
}

TEST(TrajectoryIpm, EffortsThatMayHardlyChangeAreOne) {
  // With du = 0 for all actuators there is one u: the value is that of the program of one instant
  // with all balances stacked. Here the instants are equal, so it is that of one of them.
  const Problem problem = load_problem("uvms/valve");
  Random random(2);
  TrajectoryRecipe recipe;
  recipe.instants = 1;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  const double alone = solve_by_ipm(program).value;
  program.instants.resize(4, program.instants[0]);
  for (const double du : {0.0, 1e-13, 1e-9, 1e-6}) {
    program.du_max = Eigen::MatrixXd::Constant(problem.robot.actuators(), 3, du);
    TrajectorySolution solution = solve_by_ipm(program);
    ASSERT_EQ(solution.status, Status::kOptimal) << du << solution.reason.c_str();
    EXPECT_NEAR(solution.value, alone, 1e-8 * (1 + alone));
    // Different loads: efforts follow within du, as the simplex says.
    TrajectoryProgram other = program;
    for (int i = 0; i < 4; ++i) other.instants[i].tau_d += Eigen::VectorXd::Constant(10, 1e-7 * i);
    solution = solve_by_ipm(other);
    TrajectorySolution reference;
    find_trajectory_solver("simplex").make()->solve(other, reference);
    if (reference.status != Status::kOptimal) continue;
    ASSERT_EQ(solution.status, Status::kOptimal) << du << solution.reason.c_str();
    EXPECT_NEAR(solution.value, reference.value, 1e-8 * (1 + alone));
    EXPECT_LE((solution.u.col(3) - solution.u.col(0)).lpNorm<Eigen::Infinity>(), 3 * du + 1e-8);
  }
}

TEST(TrajectoryIpm, OneInstantWithoutBalanceIsEnough) {
  const Problem problem = load_problem("uvms/valve");
  Random random(3);
  for (int at = 0; at < 6; ++at) {
    TrajectoryRecipe recipe;
    recipe.instants = 6;
    recipe.load = 0.02;
    recipe.rates = at % 2 == 0;
    TrajectoryProgram program = random_trajectory(problem, recipe, random);
    program.instants[at].tau_d *= 50;
    const TrajectorySolution solution = solve_by_ipm(program);
    ASSERT_EQ(solution.status, Status::kInfeasible) << solution.reason.c_str();
    EXPECT_TRUE(proves_infeasible(program, solution));
    // Elastic it has a value, and slack in that instant.
    program.rho = 100;
    const TrajectorySolution elastic = solve_by_ipm(program);
    ASSERT_EQ(elastic.status, Status::kOptimal) << elastic.reason.c_str();
    EXPECT_GT(elastic.s.col(at).lpNorm<1>(), 1);
  }
}

TEST(TrajectoryIpm, LambdaIsTheDerivativeByTheLoad) {
  // The value is piecewise linear in tau_d: both one-sided differences agree but at a kink.
  const Problem problem = load_problem("uvms/valve");
  Random random(4);
  int compared = 0;
  for (int sample = 0; sample < 12; ++sample) {
    TrajectoryRecipe recipe;
    recipe.instants = 3;
    recipe.wrench = sample % 2 == 0 ? Wrench::kPure : Wrench::kAny;
    recipe.peak = sample % 3 == 0 ? 1 : -1;
    recipe.rho = sample % 4 == 0 ? 100 : kInfinity;
    recipe.border = sample % 5 == 0 ? 4 : 0;
    recipe.load = 0.03;
    TrajectoryProgram program = random_trajectory(problem, recipe, random);
    const TrajectorySolution solution = solve_by_ipm(program);
    if (solution.status != Status::kOptimal) continue;
    const double at = solution.value - solution.price;
    for (int row = 0; row < 10; ++row) {
      double differences[2];
      for (const int side : {0, 1}) {
        TrajectoryProgram moved = program;
        const double by = side == 0 ? 1e-4 : -1e-4;
        moved.instants[1].tau_d[row] += by;
        const TrajectorySolution there = solve_by_ipm(moved);
        ASSERT_EQ(there.status, Status::kOptimal);
        differences[side] = (there.value - there.price - at) / by;
      }
      if (std::abs(differences[0] - differences[1]) > 1e-4) continue;
      EXPECT_NEAR(solution.lambda(row, 1), differences[0], 1e-3) << sample << " " << row;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(TrajectoryIpm, MultipliersOfRatesAndRowsAreDerivativesByTheirLimits) {
  const Problem problem = load_problem("uvms/valve");
  Random random(5);
  int rates = 0, rows = 0;
  for (int sample = 0; sample < 20; ++sample) {
    TrajectoryRecipe recipe;
    recipe.instants = 3;
    recipe.du = 0.1;
    recipe.border = 4;
    recipe.rho = 100;
    TrajectoryProgram program = random_trajectory(problem, recipe, random);
    const TrajectorySolution solution = solve_by_ipm(program);
    ASSERT_EQ(solution.status, Status::kOptimal);
    const auto difference = [&](double& limit, double by) {
      const double kept = limit;
      double values[2];
      for (const int side : {0, 1}) {
        limit = kept + (side == 0 ? by : -by);
        const TrajectorySolution there = solve_by_ipm(program);
        EXPECT_EQ(there.status, Status::kOptimal);
        values[side] = there.value - there.price;
      }
      limit = kept;
      const double at = solution.value - solution.price;
      const bool kink = std::abs(values[0] + values[1] - 2 * at) > 1e-3 * by;
      return kink ? NAN : (values[0] - values[1]) / (2 * by);
    };
    Eigen::Index r = 0, j = 0;
    if (solution.nu.cwiseAbs().maxCoeff(&r) > 1e-3) {
      double& limit = solution.nu[r] > 0 ? program.r_max[r] : program.r_min[r];
      const double slope = difference(limit, 1e-6);
      if (!std::isnan(slope)) {
        EXPECT_NEAR(solution.nu[r], slope, 1e-3 * (1 + std::abs(slope)));
        ++rows;
      }
    }
    if (solution.mu.col(1).cwiseAbs().maxCoeff(&j) > 1e-3) {
      const double slope = difference(program.du_max(j, 1), 1e-5);
      if (!std::isnan(slope)) {
        EXPECT_NEAR(std::abs(solution.mu(j, 1)), slope, 1e-3 * (1 + slope));
        const double change = solution.u(j, 2) - solution.u(j, 1);
        EXPECT_GT(change * solution.mu(j, 1), 0);
        ++rates;
      }
    }
  }
  EXPECT_GT(rates, 5);
  EXPECT_GT(rows, 5);
}

TEST(TrajectoryIpm, RowsThatNoActuatorReaches) {
  // Robots without full row rank: what B does not reach is an equation on the wrench.
  int deficient = 0;
  for (const std::string& name : shipped_problems()) {
    const Problem problem = load_problem(name);
    const Zonotope& full = problem.robot.actuation;
    // A vehicle that lost its first two actuators, if nothing else is without rank.
    Eigen::VectorXd low = full.u_min, high = full.u_max;
    Eigen::MatrixXd B = full.B;
    B.col(0).setZero();
    B.col(B.cols() - 1).setZero();
    const Zonotope lame = make_zonotope(B, low, high);
    for (const Zonotope* set : {&full, &lame}) {
      if (set->full_row_rank()) continue;
      ++deficient;
      Random random(6);
      for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
        for (const double rho : {kInfinity, 100.0}) {
          TrajectoryRecipe recipe;
          recipe.wrench = wrench;
          recipe.rho = rho;
          recipe.load = 0.01;
          TrajectoryProgram program = random_trajectory(problem, recipe, random);
          for (WrenchProgram& at : program.instants) at.actuation = set;
          const TrajectorySolution solution = solve_by_ipm(program);
          TrajectorySolution reference;
          find_trajectory_solver("simplex").make()->solve(program, reference);
          ASSERT_NE(solution.status, Status::kNumericalError) << name;
          if (reference.status == Status::kNumericalError) continue;
          ASSERT_EQ(solution.status, reference.status)
              << name << " " << to_string(wrench) << " " << rho << " " << solution.reason.c_str();
          if (solution.status != Status::kOptimal) continue;
          const double value = reference.value - reference.price;
          EXPECT_NEAR(solution.value - solution.price, value, 1e-7 * (1 + std::abs(value)));
        }
      }
    }
  }
  EXPECT_GT(deficient, 2);
}

// The first of its kind: the storage for slacks and rates comes with the first program that needs
// them.
TEST(TrajectoryIpm, NothingIsAllocatedAfterTheFirstCall) {
  const Problem problem = load_problem("uvms/valve");
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    for (const bool elastic : {false, true}) {
      for (const int border : {0, 6}) {
        Random random(7);
        TrajectoryRecipe recipe;
        recipe.wrench = wrench;
        recipe.load = 0.02;
        recipe.rho = elastic ? 100 : kInfinity;
        recipe.border = border;
        std::vector<TrajectoryProgram> programs;
        for (int i = 0; i < 5; ++i) programs.push_back(random_trajectory(problem, recipe, random));
        const auto solver = make_trajectory_ipm();
        TrajectorySolution solution;
        for (const TrajectoryProgram& program : programs) solver->solve(program, solution);
        const long before = allocation_count();
        for (const TrajectoryProgram& program : programs) solver->solve(program, solution);
        EXPECT_EQ(allocation_count(), before) << elastic << " " << border;
      }
    }
  }
}

TEST(TrajectoryIpm, AnswersDependOnNothingButTheProgram) {
  const Problem problem = load_problem("uvms/valve");
  Random random(8);
  TrajectoryRecipe recipe;
  const TrajectoryProgram program = random_trajectory(problem, recipe, random);
  recipe.instants = 7;
  recipe.wrench = Wrench::kAny;
  const TrajectoryProgram other = random_trajectory(problem, recipe, random);
  const auto solver = make_trajectory_ipm();
  TrajectorySolution first, again;
  solver->solve(program, first);
  solver->solve(other, again);
  solver->solve(program, again);
  EXPECT_EQ(first.u, again.u);
  EXPECT_EQ(first.lambda, again.lambda);
  EXPECT_EQ(first.value, again.value);
}

TEST(TrajectoryIpm, ALooserToleranceEndsEarlierAndKeepsToIt) {
  const Problem problem = load_problem("uvms/valve");
  Random random(10);
  const double tolerance = 1e-5;
  const auto exact = make_trajectory_ipm(), loose = make_trajectory_ipm(tolerance);
  long saved = 0;
  for (int sample = 0; sample < 10; ++sample) {
    TrajectoryRecipe recipe;
    recipe.rho = 100;
    recipe.border = 5;
    const TrajectoryProgram program = random_trajectory(problem, recipe, random);
    TrajectorySolution reference, solution;
    exact->solve(program, reference);
    loose->solve(program, solution);
    ASSERT_EQ(reference.status, Status::kOptimal);
    ASSERT_EQ(solution.status, Status::kOptimal) << solution.reason.c_str();
    const double size = 1 + std::abs(solution.value) + solution.price;
    EXPECT_TRUE(solution.residual.within(tolerance * size));
    // The gap bounds how far the objective is off, once for each program, and what the slacks,
    // bounds and rates may be violated by is priced by multipliers of about rho.
    EXPECT_NEAR(solution.value - solution.price, reference.value - reference.price,
                2 * recipe.rho * tolerance * size);
    saved += reference.iterations - solution.iterations;
  }
  EXPECT_GE(saved, 10);
}

TEST(TrajectoryIpm, LoadsABitBeyondWhatCanBeBalancedAreProvedSo) {
  // A load of which an instant holds at most the share alpha without rates: at a bit more there is
  // no answer.
  const Problem problem = load_problem("uvms/valve");
  Random random(11);
  int proved = 0;
  for (int sample = 0; sample < 10; ++sample) {
    TrajectoryRecipe recipe;
    TrajectoryProgram program = random_trajectory(problem, recipe, random);
    // The largest share of its own load that can be held: tau_d alpha as a column of the wrench.
    TrajectoryProgram held = program;
    held.peak = 0;
    for (WrenchProgram& at : held.instants) {
      at.JtW.conservativeResize(Eigen::NoChange, 2);
      at.JtW.col(1) = at.tau_d;
      at.W.conservativeResize(Eigen::NoChange, 2);
      at.W.col(1).setZero();
      at.tau_d.setZero();
      at.c_w = Eigen::Vector2d(0, 1);
      at.w_min = Eigen::Vector2d(-kInfinity, 0);
      at.w_max = Eigen::Vector2d(kInfinity, &at == &held.instants[0] ? 1e6 : 0);
    }
    program.du_max.setConstant(kInfinity);
    held.du_max.setConstant(kInfinity);
    const TrajectorySolution most = solve_by_ipm(held);
    ASSERT_EQ(most.status, Status::kOptimal);
    for (const double beyond : {1e-3, 1e-5, 1e-6}) {
      program.instants[0].tau_d = held.instants[0].JtW.col(1) * (most.value * (1 + beyond));
      const TrajectorySolution solution = solve_by_ipm(program);
      EXPECT_EQ(solution.status, Status::kInfeasible) << beyond << solution.reason.c_str();
      EXPECT_TRUE(proves_infeasible(program, solution));
      ++proved;
    }
  }
  EXPECT_EQ(proved, 30);
}

TEST(TrajectoryIpm, AWrenchThatLoadsNothingHasNoVerdict) {
  const Problem problem = load_problem("uvms/valve");
  Random random(9);
  TrajectoryProgram program = random_trajectory(problem, {}, random);
  // The load is zero too, so there are answers, of any value.
  for (WrenchProgram& at : program.instants) {
    at.JtW.setZero();
    at.tau_d.setZero();
  }
  const TrajectorySolution solution = solve_by_ipm(program);
  EXPECT_EQ(solution.status, Status::kNumericalError);
  EXPECT_STRNE(solution.reason.c_str(), "");
}

}  // namespace
}  // namespace maxwrench
