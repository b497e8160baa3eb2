#include "lib/effort_tracking.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lib/random.h"
#include "problems/loader.h"
#include "solvers/strategies.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Requests on the underwater vehicle's B with its own limits and random weights.
struct Vehicle {
  Robot robot = load_problem("uvms/valve").robot;
  VectorXd Q;
  EffortRequest request;
  EffortAnswer answer;

  explicit Vehicle(Random& random) {
    Q = VectorXd::NullaryExpr(robot.actuators(), [&] { return random.uniform(0.1, 2); });
    request.lower = robot.actuation.u_min;
    request.upper = robot.actuation.u_max;
    request.P = MatrixXd::Identity(robot.velocities(), robot.velocities());
  }
  VectorXd inside(Random& random, double share) const {
    const VectorXd middle = (request.lower + request.upper) / 2;
    VectorXd u = middle;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      u[i] += share * random.uniform(-1, 1) * (request.upper[i] - middle[i]);
    }
    return u;
  }
  void solve() { EffortTracker(robot.actuation.B, Q).solve(request, answer); }
  double cost(const VectorXd& u) const { return (u - request.u_star).cwiseAbs2().dot(Q); }
};

TEST(EffortTracking, InsideTheLimitsItIsTheWeightedPseudoInverse) {
  Random random(1);
  for (int sample = 0; sample < 50; ++sample) {
    Vehicle v(random);
    v.request.u_star = v.inside(random, 0.1);
    v.request.tau_c = v.robot.actuation.B * v.inside(random, 0.1);
    v.solve();
    const MatrixXd& B = v.robot.actuation.B;
    const MatrixXd QB = v.Q.cwiseInverse().asDiagonal() * B.transpose();
    const VectorXd expected =
        v.request.u_star + QB * (B * QB).inverse() * (v.request.tau_c - B * v.request.u_star);
    EXPECT_LT((v.answer.u - expected).norm(), 1e-9);
    EXPECT_EQ(v.answer.iterations, 0);
    EXPECT_FALSE(v.answer.relaxed);
  }
}

/// At the limits: the optimality conditions, from the data alone. With N spanning the null space of
/// B, no way along it that the bounds allow lowers the cost: for a convex program it is enough that
/// the cost's slope in every feasible direction to a random feasible point is not negative.
TEST(EffortTracking, AtTheLimitsNoFeasiblePointIsBetter) {
  Random random(2);
  int at_limits = 0;
  for (int sample = 0; sample < 200; ++sample) {
    Vehicle v(random);
    v.request.u_star = v.inside(random, 3);
    const VectorXd feasible = v.inside(random, 1);
    v.request.tau_c = v.robot.actuation.B * feasible;
    v.solve();
    ASSERT_FALSE(v.answer.relaxed);
    EXPECT_LT(v.answer.shortfall, 1e-5);
    EXPECT_TRUE((v.answer.u.array() >= v.request.lower.array()).all());
    EXPECT_TRUE((v.answer.u.array() <= v.request.upper.array()).all());
    const VectorXd slope = 2 * v.Q.cwiseProduct(v.answer.u - v.request.u_star);
    EXPECT_GE(slope.dot(feasible - v.answer.u), -1e-5);
    at_limits += v.answer.saturated;
  }
  EXPECT_GT(at_limits, 20);
}

/// A point is optimal exactly if no feasible point has a lower slope'u, slope the cost's gradient
/// at it. Clp looks for one.
TEST(EffortTracking, ClpFindsNoDescent) {
  Random random(3);
  const auto clp = find_lp_solver("clp").make();
  for (int sample = 0; sample < 100; ++sample) {
    Vehicle v(random);
    v.request.u_star = v.inside(random, 3);
    v.request.tau_c = v.robot.actuation.B * v.inside(random, 1);
    v.solve();
    LinearProgram program;
    program.c = -2 * v.Q.cwiseProduct(v.answer.u - v.request.u_star);
    program.A = v.robot.actuation.B.sparseView();
    program.b = v.request.tau_c;
    program.l = v.request.lower;
    program.u = v.request.upper;
    LpSolution solution;
    clp->solve(program, solution);
    ASSERT_EQ(solution.status, Status::kOptimal);
    EXPECT_NEAR(program.c.dot(v.answer.u), program.c.dot(solution.x),
                1e-5 * (1 + std::abs(program.c.dot(solution.x))));
  }
}

/// Beyond the limits: a bounded least-squares problem, whose optimum has residual slopes that point
/// outwards at bounds and vanish elsewhere.
TEST(EffortTracking, WhatCannotBeHadIsApproached) {
  Random random(4);
  for (int sample = 0; sample < 50; ++sample) {
    Vehicle v(random);
    v.request.u_star = v.inside(random, 0.5);
    v.request.tau_c = v.robot.actuation.B * v.inside(random, 1);
    v.request.tau_c[v.request.tau_c.size() - 1] = 5;  // the last joint has 2 N m
    v.solve();
    EXPECT_TRUE(v.answer.relaxed);
    EXPECT_TRUE(v.answer.saturated);
    EXPECT_NEAR(v.answer.shortfall, 3, 1e-3);
    EXPECT_NEAR(v.answer.u.tail<1>()[0], 2, 1e-9);
    const VectorXd lack = v.robot.actuation.B * v.answer.u - v.request.tau_c;
    EXPECT_LT(lack.head(lack.size() - 1).norm(), 5e-3);  // u* pulls a little
  }
}

}  // namespace
}  // namespace maxwrench
