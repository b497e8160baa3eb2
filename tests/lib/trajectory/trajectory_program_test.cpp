#include "maxwrench/trajectory_program.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

TrajectorySolution solve_trajectory_by(const TrajectoryProgram& program,
                                       const char* name = "simplex") {
  TrajectorySolution solution;
  find_trajectory_solver(name).make()->solve(program, solution);
  return solution;
}

/// A bordered elastic program with rates, whose every multiplier counts.
TrajectoryProgram rich_trajectory(const Problem& problem, Random& random) {
  TrajectoryRecipe recipe;
  recipe.instants = 4;
  recipe.border = 5;
  recipe.rho = 100;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  program.first_elastic = 1;
  return program;
}

TEST(TrajectoryProgram, OneInstantIsAWrenchProgram) {
  const Problem problem = load_problem("uvms/valve");
  Random random(1);
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    for (const int peak : {-1, 0}) {
      TrajectoryRecipe recipe;
      recipe.instants = 1;
      recipe.wrench = wrench;
      recipe.peak = peak;
      const TrajectoryProgram program = random_trajectory(problem, recipe, random);
      Capability capability;
      find_wrench_solver("condensed").make()->solve(program.instants[0], true, capability);
      const TrajectorySolution solution = solve_trajectory_by(program);
      ASSERT_EQ(solution.status, Status::kOptimal) << solution.reason.c_str();
      EXPECT_NEAR(solution.value, capability.beta, 1e-9 * (1 + capability.beta));
      EXPECT_TRUE(solution.residual.within(1e-9 * (1 + capability.beta)));
    }
  }
}

TEST(TrajectoryProgram, UpdateWritesWhatAssembleBuilds) {
  const Problem problem = load_problem("uvms/valve");
  Random random(2);
  const TrajectoryProgram first = rich_trajectory(problem, random);
  TrajectoryProgram second = rich_trajectory(problem, random);
  second.R = first.R;
  LinearProgram updated = assemble(first);
  const long before = allocation_count();
  update(second, updated);
  EXPECT_EQ(allocation_count(), before);
  const LinearProgram fresh = assemble(second);
  EXPECT_EQ(Eigen::MatrixXd(updated.A), Eigen::MatrixXd(fresh.A));
  EXPECT_EQ(updated.b, fresh.b);
  EXPECT_EQ(updated.c, fresh.c);
  EXPECT_EQ(updated.l, fresh.l);
  EXPECT_EQ(updated.u, fresh.u);
}

TEST(TrajectoryProgram, TheAssembledProgramSaysWhatTheDocumentationSays) {
  // Any u, w, s and y within their limits make a balance and rates that the columns repeat.
  const Problem problem = load_problem("uvms/valve");
  Random random(3);
  const TrajectoryProgram program = rich_trajectory(problem, random);
  const TrajectorySolution solution = solve_trajectory_by(program);
  ASSERT_EQ(solution.status, Status::kOptimal);
  const Eigen::MatrixXd& B = problem.robot.actuation.B;
  for (int i = 0; i < program.size(); ++i) {
    const WrenchProgram& at = program.instants[i];
    const Eigen::VectorXd missed = B * solution.u.col(i) - at.JtW * solution.w[i] +
                                   solution.s.col(i) + program.G[i] * solution.y - at.tau_d;
    EXPECT_LT(missed.norm(), 1e-9);
    EXPECT_GE(at.c_w.dot(solution.w[i]), solution.value - 1e-9);
  }
  EXPECT_EQ(solution.s.col(0).norm(), 0);
  EXPECT_NEAR(solution.price, 100 * solution.s.lpNorm<1>(), 1e-9);
  const Eigen::VectorXd rows = program.R * solution.y;
  EXPECT_TRUE((rows.array() <= program.r_max.array() + 1e-9).all());
  EXPECT_TRUE((rows.array() >= program.r_min.array() - 1e-9).all());
}

/// Calls f(name, number) for a number of every part of the answer.
template <class F>
void for_every_part(TrajectorySolution& solution, F&& f) {
  f("value", solution.value);
  f("price", solution.price);
  f("u", solution.u(0, 1));
  f("w", solution.w[1][0]);
  f("s", solution.s(0, 1));
  f("y", solution.y[2]);
  f("lambda", solution.lambda(0, 1));
  f("mu", solution.mu(0, 1));
  f("pi", solution.pi[1]);
  f("nu", solution.nu[0]);
}

TEST(TrajectoryProgram, WhatIsNotANumberPassesNoRecheck) {
  const Problem problem = load_problem("uvms/valve");
  Random random(4);
  const TrajectoryProgram program = rich_trajectory(problem, random);
  TrajectorySolution solution = solve_trajectory_by(program);
  ASSERT_TRUE(recheck(program, solution).within(1e-8));
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    for_every_part(solution, [&](const char* name, double& number) {
      const double kept = std::exchange(number, bad);
      EXPECT_FALSE(recheck(program, solution).within(1e6)) << name;
      number = kept;
    });
  }
  TrajectoryProgram broken = program;
  broken.instants[2].tau_d[0] = std::nan("");
  EXPECT_FALSE(recheck(broken, solution).within(1e6));
}

TEST(TrajectoryProgram, RecheckSeesWhateverIsMoved) {
  const Problem problem = load_problem("uvms/valve");
  Random random(5);
  const TrajectoryProgram program = rich_trajectory(problem, random);
  TrajectorySolution solution = solve_trajectory_by(program);
  ASSERT_TRUE(recheck(program, solution).within(1e-8));
  for_every_part(solution, [&](const char* name, double& number) {
    const double kept = number;
    bool seen = false;
    for (const double by : {1e-3, -1e-3}) {
      number = kept + by;
      seen = seen || !recheck(program, solution).within(1e-6);
    }
    EXPECT_TRUE(seen) << name;
    number = kept;
  });
  solution.pi.conservativeResize(2);
  EXPECT_FALSE(recheck(program, solution).within(1e6));
  solution = {};
  EXPECT_FALSE(recheck(program, solution).within(1e6));
}

TEST(TrajectoryProgram, AProofIsAProofAndNothingElseIs) {
  const Problem problem = load_problem("uvms/valve");
  Random random(6);
  TrajectoryRecipe recipe;
  recipe.instants = 4;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  const TrajectorySolution optimum = solve_trajectory_by(program);
  EXPECT_FALSE(proves_infeasible(program, optimum));
  program.instants[2].tau_d *= 100;
  for (const char* name : {"simplex", "ipm"}) {
    TrajectorySolution proof = solve_trajectory_by(program, name);
    ASSERT_EQ(proof.status, Status::kInfeasible) << name;
    EXPECT_TRUE(proves_infeasible(program, proof));
    proof.lambda = -proof.lambda;
    EXPECT_FALSE(proves_infeasible(program, proof));
    proof.lambda.setZero();
    EXPECT_FALSE(proves_infeasible(program, proof));
    proof.lambda.setConstant(std::nan(""));
    EXPECT_FALSE(proves_infeasible(program, proof));
  }
  // Limits that exclude each other need no multipliers.
  program.first_min[0] = program.first_max[0] + 1;
  EXPECT_TRUE(proves_infeasible(program, {}));
}

TEST(TrajectoryProgram, ProofsMayRestOnTheRates) {
  // Opposite loads in two instants, each balanced alone, with efforts that may not change.
  const Problem problem = load_problem("uvms/valve");
  Random random(7);
  TrajectoryRecipe recipe;
  recipe.instants = 2;
  recipe.load = 0;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  const Zonotope& set = problem.robot.actuation;
  const Eigen::VectorXd push = 0.5 * set.B.leftCols(8) * set.u_max.head(8);
  program.instants[0].tau_d = push;
  program.instants[1].tau_d = -push;
  ASSERT_EQ(solve_trajectory_by(program).status, Status::kInfeasible);
  for (const char* name : {"simplex", "ipm"}) {
    TrajectorySolution proof = solve_trajectory_by(program, name);
    ASSERT_TRUE(proves_infeasible(program, proof)) << name;
    proof.mu.setZero();
    EXPECT_FALSE(proves_infeasible(program, proof)) << name;
  }
  program.du_max.setConstant(kInfinity);
  EXPECT_EQ(solve_trajectory_by(program).status, Status::kOptimal);
}

}  // namespace
}  // namespace maxwrench
