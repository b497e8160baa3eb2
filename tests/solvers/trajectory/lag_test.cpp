#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

/// One thruster of 1 N that pushes on the end effector, from rest, in an impulse of `steps` steps.
struct OneThruster {
  explicit OneThruster(int steps, double lag) {
    set = make_zonotope(Eigen::MatrixXd::Ones(1, 1), -Eigen::VectorXd::Ones(1),
                        Eigen::VectorXd::Ones(1));
    WrenchProgram at;
    at.actuation = &set;
    at.W = Matrix6Xd::Zero(6, 1);
    at.W(0, 0) = 1;
    at.C_2.resize(6, 0);
    at.c_w = Eigen::VectorXd::Ones(1);
    at.w_min = Eigen::VectorXd::Constant(1, -kInfinity);
    at.w_max = Eigen::VectorXd::Constant(1, kInfinity);
    at.JtW = Eigen::MatrixXd::Ones(1, 1);
    at.tau_d = Eigen::VectorXd::Zero(1);
    program.instants.assign(static_cast<std::size_t>(steps) + 1, at);
    program.first_min = program.first_max = Eigen::VectorXd::Zero(1);
    program.du_max = Eigen::MatrixXd::Constant(1, steps, kInfinity);
    program.lag = Eigen::MatrixXd::Constant(1, steps, lag);
    program.peak = steps;
  }
  Zonotope set;
  TrajectoryProgram program;
};

std::vector<std::unique_ptr<TrajectorySolver>> solvers_of_lags() {
  std::vector<std::unique_ptr<TrajectorySolver>> solvers;
  for (const char* name : {"facets_or_ipm", "ipm", "simplex"}) {
    solvers.push_back(find_trajectory_solver(name).make());
  }
  return solvers;
}

/// Each step reaches u_i+1 = (1 + a u_i)/(1 + a) with the command at its limit of 1. From u_0 = 0
/// this is u_k = 1 - (a/(1 + a))^k, the implicit Euler steps of a first-order lag.
TEST(LagOfEfforts, AStepFromRestRisesLikeAFirstOrderLag) {
  for (const double a : {0.25, 1.0, 10.0}) {
    for (const int steps : {1, 3, 8}) {
      const OneThruster made(steps, a);
      for (const auto& solver : solvers_of_lags()) {
        TrajectorySolution solution;
        solver->solve(made.program, solution);
        ASSERT_EQ(solution.status, Status::kOptimal) << solution.reason.c_str();
        EXPECT_NEAR(solution.value, 1 - std::pow(a / (1 + a), steps), 1e-8);
        EXPECT_TRUE(recheck(made.program, solution).within(1e-8));
      }
    }
  }
}

TEST(LagOfEfforts, MoreThanTheLagAllowsIsProvenInfeasible) {
  OneThruster made(3, 1);
  WrenchProgram& end = made.program.instants.back();
  end.w_min[0] = 1 - std::pow(0.5, 3) + 1e-3;
  for (const auto& solver : solvers_of_lags()) {
    TrajectorySolution solution;
    solver->solve(made.program, solution);
    EXPECT_EQ(solution.status, Status::kInfeasible);
    EXPECT_TRUE(proves_infeasible(made.program, solution));
    // The proof is one of the lag: without it there is an answer.
    TrajectoryProgram free = made.program;
    free.lag.resize(0, 0);
    EXPECT_FALSE(proves_infeasible(free, solution));
  }
}

TEST(LagOfEfforts, RecheckSeesACommandBeyondItsLimits) {
  const OneThruster made(2, 1);
  TrajectorySolution solution;
  make_trajectory_ipm()->solve(made.program, solution);
  ASSERT_EQ(solution.status, Status::kOptimal);
  solution.u(0, 1) += 1e-3;
  solution.w[1][0] += 1e-3;  // still in balance, and within the limits of the effort
  // The command of the first step is 2 u_1 = 1 + 2e-3.
  EXPECT_NEAR(recheck(made.program, solution).bounds, 2e-3, 1e-8);
  EXPECT_LT(recheck(made.program, solution).balance, 1e-12);
}

TEST(LagOfEfforts, RejectsMatricesThatAreNoLags) {
  for (const double wrong : {-1.0, std::nan(""), kInfinity}) {
    const OneThruster made(2, wrong);
    EXPECT_FALSE(well_formed(made.program)) << wrong;
  }
  OneThruster made(2, 1);
  made.program.lag.resize(1, 3);
  EXPECT_FALSE(well_formed(made.program));
}

/// The interior point method and the assembled program agree, with rates, borders, slacks, peaks
/// and efforts without lag.
TEST(LagOfEfforts, TheInteriorPointMethodAgreesWithTheAssembledProgram) {
  const Problem problem = load_problem("uvms/valve");
  Random random(5);
  int optimal = 0, infeasible = 0, binding = 0;
  const auto ipm = make_trajectory_ipm(), peer = find_trajectory_solver("simplex").make();
  for (int sample = 0; sample < samples(120); ++sample) {
    TrajectoryRecipe recipe;
    recipe.instants = 2 + static_cast<int>(random.uniform(0, 5));
    recipe.wrench = random.uniform() < 0.5 ? Wrench::kPure : Wrench::kAny;
    recipe.rates = random.uniform() < 0.5;
    if (random.uniform() < 0.3) recipe.peak = static_cast<int>(random.uniform(0, recipe.instants));
    if (random.uniform() < 0.3) recipe.rho = 100;
    if (random.uniform() < 0.3) recipe.border = 1 + static_cast<int>(random.uniform(0, 4));
    recipe.load = random.uniform() < 0.3 ? 0.05 : 0.4;
    TrajectoryProgram program = random_trajectory(problem, recipe, random);
    program.lag.setZero(program.du_max.rows(), program.du_max.cols());
    const double lag = random.uniform(0.1, 8);
    program.lag.topRows(static_cast<Eigen::Index>(problem.robot.thrusters.size())).setConstant(lag);
    program.lag.row(2).setZero();
    TrajectorySolution reference, solution;
    ipm->solve(program, reference);
    ASSERT_NE(reference.status, Status::kNumericalError) << sample << reference.reason.c_str();
    peer->solve(program, solution);
    if (solution.status == Status::kNumericalError) continue;
    ASSERT_EQ(solution.status, reference.status) << sample;
    if (reference.status == Status::kInfeasible) {
      ++infeasible;
      EXPECT_TRUE(proves_infeasible(program, reference)) << sample;
      EXPECT_TRUE(proves_infeasible(program, solution)) << sample;
      continue;
    }
    ++optimal;
    const double size = 1 + std::abs(reference.value) + reference.price;
    EXPECT_NEAR(solution.value - solution.price, reference.value - reference.price, 1e-8 * size);
    EXPECT_TRUE(recheck(program, reference).within(1e-7 * size)) << sample;
    EXPECT_TRUE(recheck(program, solution).within(1e-7 * size)) << sample;
    binding += (solution.kappa.array().abs() > 1e-6).any();
  }
  if (kSanitized) return;  // too few samples to count kinds
  EXPECT_GT(optimal, samples(20));
  EXPECT_GT(infeasible, samples(10));
  EXPECT_GT(binding, samples(10));
}

/// Where the lag does not bind, the answer is that of the program without it.
TEST(LagOfEfforts, ALagOfZeroIsNone) {
  const Problem problem = load_problem("uvms/valve");
  Random random(6);
  TrajectoryRecipe recipe;
  recipe.instants = 4;
  recipe.load = 0.05;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  TrajectorySolution without, with;
  make_trajectory_ipm()->solve(program, without);
  program.lag.setZero(program.du_max.rows(), program.du_max.cols());
  make_trajectory_ipm()->solve(program, with);
  EXPECT_EQ(with.value, without.value);
  EXPECT_EQ(with.u, without.u);
}

}  // namespace
}  // namespace maxwrench
