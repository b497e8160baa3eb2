#include "solvers/trajectory/common_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "maxwrench/load.h"
#include "solvers/lp/makers.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

// Programs with one factor for all instants: the mass of a payload along a path.

namespace maxwrench {
namespace {

TrajectoryProgram any_common_program(const Problem& problem, Random& random) {
  TrajectoryRecipe recipe;
  recipe.common = true;
  recipe.instants = 1 + static_cast<int>(random.uniform(0, 6));
  recipe.rates = random.uniform() < 0.5;
  if (random.uniform() < 0.2) recipe.rho = 100;
  if (random.uniform() < 0.3) recipe.border = 1 + static_cast<int>(random.uniform(0, 6));
  recipe.load = random.uniform() < 0.5 ? 0.02 : 0.3;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  const double size = random.uniform(0.5, 2);
  const bool mass = random.uniform() < 0.5;
  for (WrenchProgram& at : program.instants) {
    at.JtW *= size * random.uniform(0.9, 1.1);  // c changes over time
    at.c_w.setOnes();
    if (mass) at.w_min.setZero();
  }
  return program;
}

struct CommonTally {
  int optimal = 0, infeasible = 0;
};

/// Compares with general simplex on the assembled program, which knows no common factor.
void compare_common(const TrajectoryProgram& program, TrajectorySolver& solver,
                    TrajectorySolver& peer, CommonTally& tally, int sample) {
  TrajectorySolution solution, reference;
  solver.solve(program, solution);
  peer.solve(program, reference);
  ASSERT_EQ(solution.status, reference.status)
      << sample << ": " << solution.reason.c_str() << reference.reason.c_str();
  if (solution.status == Status::kInfeasible) {
    ++tally.infeasible;
    EXPECT_TRUE(proves_infeasible(program, solution)) << sample;
    EXPECT_TRUE(proves_infeasible(program, reference)) << sample;
    // A proof is of the program as it stands: without the coupling it may hold no longer.
    EXPECT_EQ(solution.pi.size(), program.size());
    return;
  }
  ASSERT_EQ(solution.status, Status::kOptimal) << sample;
  ++tally.optimal;
  const double size = 1 + std::abs(reference.value) + reference.price;
  EXPECT_NEAR(solution.value - solution.price, reference.value - reference.price, 1e-7 * size);
  EXPECT_TRUE(recheck(program, solution).within(1e-7 * size)) << sample;
  for (const Eigen::VectorXd& w : solution.w) EXPECT_NEAR(w[0], solution.value, 1e-7 * size);
}

TEST(CommonFactor, AllSolversAgreeOnRandomPrograms) {
  const Problem problem = load_problem("uvms/lift");
  Random random(1);
  const auto peer = make_assembled_trajectory(make_simplex(), false);
  CommonTally ipm_tally, facets_tally;
  const auto ipm = make_trajectory_ipm(), facets = make_facets_or_ipm();
  for (int sample = 0; sample < samples(200); ++sample) {
    const TrajectoryProgram program = any_common_program(problem, random);
    compare_common(program, *ipm, *peer, ipm_tally, sample);
    compare_common(program, *facets, *peer, facets_tally, sample);
  }
  EXPECT_GT(ipm_tally.optimal, samples(40));
  EXPECT_GT(ipm_tally.infeasible, samples(20));
  EXPECT_EQ(ipm_tally.optimal, facets_tally.optimal);
}

/// One actuator |u| <= 1 and one row: -1 <= tau_i + a_i t <= 1.
TrajectoryProgram one_row(const Zonotope& set, const std::vector<std::pair<double, double>>& rows) {
  TrajectoryProgram program;
  program.common = true;
  for (const auto& [tau, a] : rows) {
    WrenchProgram at;
    at.actuation = &set;
    at.W = Matrix6Xd::Zero(6, 1);
    at.C_2 = Matrix6Xd(6, 0);
    at.c_w = Eigen::VectorXd::Ones(1);
    at.w_min = Eigen::VectorXd::Constant(1, -kInfinity);
    at.w_max = Eigen::VectorXd::Constant(1, kInfinity);
    at.tau_d = Eigen::VectorXd::Constant(1, tau);
    at.JtW = Eigen::MatrixXd::Constant(1, 1, a);
    program.instants.push_back(at);
  }
  program.first_min = set.u_min;
  program.first_max = set.u_max;
  program.du_max = Eigen::MatrixXd::Constant(1, program.size() - 1, kInfinity);
  return program;
}

class OneRowTest : public testing::TestWithParam<bool> {
 protected:
  void solve(const TrajectoryProgram& program) {
    const auto solver = GetParam() ? make_facets_or_ipm() : make_trajectory_ipm();
    solver->solve(program, solution_);
  }
  const Zonotope set_ = make_zonotope(Eigen::MatrixXd::Ones(1, 1), -Eigen::VectorXd::Ones(1),
                                      Eigen::VectorXd::Ones(1));
  TrajectorySolution solution_;
};

/// t <= 3 of the first instant, t <= 0.5 of the second, and t >= -0.25 of the third.
TEST_P(OneRowTest, TheUpperEndIsTheValue) {
  const TrajectoryProgram program = one_row(set_, {{-2, 1}, {0.5, 1}, {0, -4}});
  solve(program);
  ASSERT_EQ(solution_.status, Status::kInfeasible);  // t >= 1 of the first: -1 <= -2 + t
  EXPECT_TRUE(proves_infeasible(program, solution_));
  const TrajectoryProgram other = one_row(set_, {{-1, 1}, {0.5, 1}, {0, -4}});
  solve(other);
  ASSERT_EQ(solution_.status, Status::kOptimal);
  EXPECT_NEAR(solution_.value, 0.25, 1e-8);         // 4 t <= 1 of the third; t >= 0 of the first
  EXPECT_NEAR(solution_.lambda(0, 2), 0.25, 1e-6);  // d t/d tau: -1 <= tau - 4 t
}

/// Each instant alone has a factor, but not the same one.
TEST_P(OneRowTest, TwoInstantsProveThatThereIsNoFactor) {
  TrajectoryProgram program = one_row(set_, {{-2, 1}, {2, 1}});  // [1, 3] and [-3, -1]
  solve(program);
  ASSERT_EQ(solution_.status, Status::kInfeasible);
  EXPECT_TRUE(proves_infeasible(program, solution_));
  // The same multipliers prove nothing of the program in which each instant has its own factor.
  program.common = false;
  EXPECT_FALSE(proves_infeasible(program, solution_));
}

/// [-3, -1] of the only instant, and no negative mass.
TEST_P(OneRowTest, AMassIsNotNegative) {
  TrajectoryProgram program = one_row(set_, {{2, 1}});
  solve(program);
  EXPECT_NEAR(solution_.value, -1, 1e-8);
  program.instants[0].w_min.setZero();
  solve(program);
  ASSERT_EQ(solution_.status, Status::kInfeasible);
  EXPECT_TRUE(proves_infeasible(program, solution_));
}

TEST_P(OneRowTest, MultipliersThatAreNoProofProveNothing) {
  const TrajectoryProgram program = one_row(set_, {{-1, 1}, {0.5, 1}});  // [0, 2] and [-1.5, 0.5]
  TrajectorySolution claim;
  claim.lambda.setOnes(1, 2);
  claim.mu.setZero(1, 1);
  claim.pi.setOnes(2);
  EXPECT_FALSE(proves_infeasible(program, claim));
  claim.lambda << -1, 1;
  claim.pi << -1, 1;
  EXPECT_FALSE(proves_infeasible(program, claim));
  claim.pi.resize(0);
  EXPECT_FALSE(proves_infeasible(program, claim));
}

TEST_P(OneRowTest, APeakOrSeveralColumnsAreMalformed) {
  TrajectoryProgram program = one_row(set_, {{0, 1}});
  EXPECT_TRUE(well_formed(program));
  program.peak = 0;
  EXPECT_FALSE(well_formed(program));
  program.peak = -1;
  program.instants[0].c_w[0] = 0;
  EXPECT_FALSE(well_formed(program));
}

INSTANTIATE_TEST_SUITE_P(CommonFactor, OneRowTest, testing::Bool(), [](const auto& test) {
  return std::string(test.param ? "facets_or_ipm" : "ipm");
});

}  // namespace
}  // namespace maxwrench
