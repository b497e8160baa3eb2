#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/timing/slow_trajectory.h"
#include "maxwrench/load.h"
#include "solvers/trajectory/even_efforts.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

TEST(EvenEfforts, TheMostLoadedActuatorIsLoadedLeast) {
  // No other efforts that exert the same tau are more even.
  const Problem problem = load_problem("uvms/valve");
  const Zonotope& set = problem.robot.actuation;
  EvenEfforts efforts;
  ASSERT_TRUE(efforts.prepare(set));
  Random random(1);
  const auto load = [&](const Eigen::VectorXd& u) {
    double most = 0;
    for (int j = 0; j < 8; ++j) {
      const double half = 0.5 * (set.u_max[j] - set.u_min[j]);
      most = std::max(most, std::abs(u[j] - set.u_min[j] - half) / half);
    }
    return most;
  };
  const Eigen::MatrixXd Z =
      Eigen::MatrixXd::Identity(12, 12) - set.B_pinv * set.B;  // onto the null space
  Eigen::VectorXd u(12), near(12);
  for (int sample = 0; sample < 1000; ++sample) {
    const Eigen::VectorXd any = Eigen::VectorXd::NullaryExpr(
        12, [&](Eigen::Index j) { return random.uniform(set.u_min[j], set.u_max[j]); });
    const Eigen::VectorXd tau = set.B * any;
    ASSERT_TRUE(efforts.solve(tau, u));
    EXPECT_LT((set.B * u - tau).norm(), 1e-9);
    // `any` is within the limits, so the even ones are.
    EXPECT_LE(load(u), load(any) + 1e-9);
    EXPECT_LE(load(u), 1 + 1e-9);
    for (int other = 0; other < 10; ++other) {
      const Eigen::VectorXd step =
          Z * Eigen::VectorXd::NullaryExpr(12, [&](Eigen::Index) { return random.normal() * 0.1; });
      EXPECT_LE(load(u), load(u + step) + 1e-9);
    }
    // And near for tau that is near.
    ASSERT_TRUE(efforts.solve(tau + set.B * Eigen::VectorXd::Constant(12, 1e-6), near));
    EXPECT_LT((near - u).norm(), 1e-3);
  }
}

TEST(FacetsOrIpm, IsTheInteriorPointMethodsAnswer) {
  const Problem problem = load_problem("uvms/valve");
  Random random(2);
  int attempts = 0, infeasible = 0;
  for (int sample = 0; sample < samples(200); ++sample) {
    TrajectoryRecipe recipe;
    recipe.instants = 1 + sample % 8;
    recipe.wrench = sample % 5 == 0 ? Wrench::kAny : Wrench::kPure;
    recipe.peak = sample % 7 == 0 ? 0 : -1;
    recipe.rho = sample % 9 == 0 ? 100 : kInfinity;
    recipe.border = sample % 6 == 0 ? 3 : 0;
    recipe.du = sample % 2 == 0 ? 0.05 : 2;
    recipe.load = sample % 4 < 2 ? 0.02 : 0.2;
    const TrajectoryProgram program = random_trajectory(problem, recipe, random);
    TrajectorySolution fast, plain;
    make_facets_or_ipm()->solve(program, fast);
    make_trajectory_ipm()->solve(program, plain);
    ASSERT_EQ(fast.status, plain.status) << sample;
    attempts += fast.iterations == 0;
    infeasible += fast.status == Status::kInfeasible;
    if (fast.status == Status::kInfeasible) {
      EXPECT_TRUE(proves_infeasible(program, fast));
      continue;
    }
    ASSERT_EQ(fast.status, Status::kOptimal);
    const double value = plain.value - plain.price;
    const double size = 1 + std::abs(plain.value) + plain.price;
    EXPECT_NEAR(fast.value - fast.price, value, 1e-8 * size) << sample;
    EXPECT_TRUE(recheck(program, fast).within(1e-9 * size)) << sample;
  }
  EXPECT_GT(attempts, samples(30));
  EXPECT_GT(infeasible, samples(10));
}

TEST(FacetsOrIpm, SlowMotionsNeedNoIteration) {
  const Problem problem = load_problem("uvms/valve");
  Random random(3);
  const auto solver = make_facets_or_ipm();
  TrajectorySolution solution;
  for (int sample = 0; sample < 10; ++sample) {
    const TrajectoryProgram program = slow_trajectory(problem, Wrench::kPure, 100, 5, random);
    const long before = allocation_count();
    solver->solve(program, solution);
    EXPECT_TRUE(sample == 0 || allocation_count() == before);
    ASSERT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(solution.iterations, 0);
  }
}

}  // namespace
}  // namespace maxwrench
