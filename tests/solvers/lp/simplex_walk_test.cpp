#include <gtest/gtest.h>

#include <cmath>

#include "solvers/lp/makers.h"
#include "tests/support/programs.h"
#include "tests/support/support.h"

// The simplex method on wrench programs that move along a line.

namespace maxwrench {
namespace {

/// `B u - J'W w = tau_d`: six base rows driven by eight thrusters, `joints` rows driven directly,
/// `wrenches` free columns; J and tau_d move along a line.
struct Walk {
  Walk(Random& random, int joints, int wrenches)
      : rows(6 + joints), actuators(8 + joints), free(wrenches) {
    const auto matrix = [&](int m, int n, double scale) {
      return Eigen::MatrixXd(
          Eigen::MatrixXd::NullaryExpr(m, n, [&] { return scale * random.uniform(-1, 1); }));
    };
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(rows, actuators);
    B.topLeftCorner(6, 8) = matrix(6, 8, 1);
    B.bottomRightCorner(joints, joints).setIdentity();
    J = matrix(rows, free, 1);
    J_step = matrix(rows, free, 0.02);
    tau_d = matrix(rows, 1, 5);
    tau_d_step = matrix(rows, 1, 0.1);
    Eigen::MatrixXd A(rows, actuators + free);
    A << B, -J;
    program.A = A.sparseView();
    program.b = tau_d;
    program.c.setZero(actuators + free);
    program.c[actuators] = 1;
    program.l.setConstant(actuators + free, -kInfinity);
    program.u.setConstant(actuators + free, kInfinity);
    for (int i = 0; i < actuators; ++i) {
      program.l[i] = random.uniform(-40, -20);
      program.u[i] = random.uniform(30, 50);
    }
  }
  void step() {
    J += J_step;
    tau_d += tau_d_step;
    program.b = tau_d;
    for (int j = 0; j < free; ++j) {
      for (int i = 0; i < rows; ++i) program.A.coeffRef(i, actuators + j) = -J(i, j);
    }
  }

  int rows, actuators, free;
  Eigen::MatrixXd J, J_step;
  Eigen::VectorXd tau_d, tau_d_step;
  LinearProgram program;
};

TEST(Simplex, WarmWalksEqualColdSolvesWithoutAllocation) {
  Random random(3);
  const auto simplex = make_simplex(), other = make_simplex();
  int optima = 0;
  for (int k = 0; k < samples(200); ++k) {
    Walk walk(random, 4, 1 + k % 6);
    LpSolution warm;
    simplex->solve(walk.program, warm);
    for (int i = 0; i < 20; ++i) {
      walk.step();
      const long before = allocation_count();
      simplex->solve(walk.program, warm);
      EXPECT_EQ(allocation_count(), before);
      LpSolution cold;
      other->solve(walk.program, cold);
      expect_verified(walk.program, warm);
      ASSERT_EQ(warm.status, cold.status);
      if (warm.status != Status::kOptimal) continue;
      ++optima;
      EXPECT_NEAR(warm.objective, cold.objective, 1e-9 * (1 + std::abs(cold.objective)));
      EXPECT_LE(residuals(walk.program, warm).balance, 1e-14);
    }
  }
  EXPECT_GT(optima, 100);
}

/// With W = c the multiplier obeys lambda'(J'c) = -1 at an optimum, since w is basic and costs 1;
/// and it is the derivative of the value: a finite difference in every component of tau_d.
TEST(Simplex, MultipliersAreDerivativesOfTheValue) {
  Random random(4);
  for (int k = 0; k < 20; ++k) {
    Walk walk(random, 3, 1);
    const LpSolution solution = solve_with_simplex(walk.program);
    if (solution.status != Status::kOptimal) continue;
    EXPECT_NEAR(solution.lambda.dot(walk.J.col(0)), -1, 1e-12);
    for (int i = 0; i < walk.rows; ++i) {
      LinearProgram moved = walk.program;
      const double h = 1e-6;
      moved.b[i] += h;
      const double up = solve_with_simplex(moved).objective;
      moved.b[i] -= 2 * h;
      const double down = solve_with_simplex(moved).objective;
      EXPECT_NEAR((up - down) / (2 * h), solution.lambda[i], 1e-6);
    }
  }
}

/// Equal limits, duplicated thrusters, a dead thruster, and a wrench along one thruster, so that
/// facets and vertices coincide.
TEST(Simplex, DegenerateWrenchProgramsAgreeWithGlpk) {
  Random random(5);
  const auto simplex = make_simplex();
  for (int k = 0; k < samples(400); ++k) {
    Walk walk(random, 4, 1 + k % 3);
    LinearProgram& p = walk.program;
    Eigen::MatrixXd A = p.A;
    p.l.head(walk.actuators).setConstant(-1);
    p.u.head(walk.actuators).setConstant(1);
    A.leftCols(walk.actuators) = A.leftCols(walk.actuators).array().round();
    if (k % 2) A.col(1) = A.col(0);
    if (k % 3 == 0) p.l[2] = p.u[2] = 0;
    if (k % 5 == 0) A.col(walk.actuators) = -A.col(3);
    p.b.setZero();
    p.A = A.sparseView();
    LpSolution solution;
    simplex->solve(p, solution);
    expect_verified(p, solution);
    const LpSolution peer = solve_with_glpk(p);
    ASSERT_STREQ(to_string(solution.status), to_string(peer.status)) << k;
    if (peer.status != Status::kOptimal) continue;
    EXPECT_NEAR(solution.objective, peer.objective, 1e-9 * (1 + std::abs(peer.objective)));
  }
}

TEST(Simplex, IterationLimitEnds) {
  Random random(10);
  SimplexOptions options;
  options.max_iterations = 2;
  Walk walk(random, 4, 3);
  LpSolution solution;
  make_simplex(options)->solve(walk.program, solution);
  EXPECT_EQ(solution.status, Status::kBudgetExhausted);
  EXPECT_EQ(solution.iterations, 2);
}

}  // namespace
}  // namespace maxwrench
