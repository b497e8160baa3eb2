#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/wrench_program.h"
#include "tests/support/changed_limits.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

Eigen::VectorXd weights_of(const Zonotope& set) {
  return set.u_min.cwiseAbs().cwiseMin(set.u_max.cwiseAbs()).cwiseInverse();
}

/// The least |W u| with B u = tau within the limits, by all 3^m ways to put efforts at their
/// limits: with the others free, W u is the shortest vector that satisfies the rest of the balance.
std::optional<double> least_by_enumeration(const Zonotope& set, const Eigen::VectorXd& tau) {
  const Eigen::VectorXd weights = weights_of(set);
  const Eigen::Index m = set.actuators();
  std::optional<double> least;
  const long ways = std::lround(std::pow(3, m));
  for (long way = 0; way < ways; ++way) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(m);
    std::vector<Eigen::Index> free;
    long rest = way;
    for (Eigen::Index i = 0; i < m; ++i, rest /= 3) {
      if (rest % 3 == 0) free.push_back(i);
      if (rest % 3 == 1) u[i] = set.u_min[i];
      if (rest % 3 == 2) u[i] = set.u_max[i];
    }
    if (!free.empty()) {
      const Eigen::VectorXd scale = weights(free).cwiseInverse();
      const Eigen::MatrixXd A = Eigen::MatrixXd(set.B(Eigen::all, free)) * scale.asDiagonal();
      const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(tau - set.B * u);
      u(free) = scale.cwiseProduct(x);
    }
    const bool holds = (set.B * u - tau).lpNorm<Eigen::Infinity>() < 1e-8 &&
                       ((u - set.u_min).array() > -1e-8).all() &&
                       ((set.u_max - u).array() > -1e-8).all();
    const double norm = weights.cwiseProduct(u).norm();
    if (holds && (!least || norm < *least)) least = norm;
  }
  return least;
}

TEST(LeastEfforts, AreTheLeastOfAllWaysToBeAtLimits) {
  const Problem task = load_problem("planar/force");  // six actuators
  Random random(3);
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    Options options;
    options.wrench = wrench;
    for (int draw = 0; draw < 3; ++draw) {
      const Answer answer = evaluate(task, random_theta_r(task, random).transpose(), options);
      if (!answer.has_value()) continue;
      for (const double share : {1.0, 0.9, 0.5, 0.0}) {
        const LeastEfforts efforts = explain(answer, {share}).efforts;
        ASSERT_EQ(efforts.missing, "");
        const Eigen::VectorXd tau =
            answer.posture.tau_d + share * answer.posture.J.transpose() * answer.capability.h;
        const auto least = least_by_enumeration(task.robot.actuation, tau);
        ASSERT_TRUE(least);
        EXPECT_NEAR(efforts.norm, *least, 1e-6);
        EXPECT_LT((task.robot.actuation.B * efforts.u - tau).lpNorm<Eigen::Infinity>(), 1e-7);
        EXPECT_LT(efforts.gap, 1e-6);
        if (share < 1) continue;
        EXPECT_LE(efforts.norm, efforts.vertex_norm + 1e-7);
      }
    }
  }
}

/// At beta itself, an actuator whose limit binds stays there.
TEST(LeastEfforts, KeepWhatBindsAtItsLimit) {
  for (const char* name : {"uvms/lift", "uvms/valve", "mobile/push", "dual_arm/bar_wall"}) {
    const Problem task = load_problem(name);
    const Explanation explanation = explain(evaluate(task, task.theta_r_default.transpose()));
    ASSERT_EQ(explanation.efforts.missing, "") << name;
    for (const BindingLimit& limit : explanation.limits) {
      const Eigen::Index i = actuator_named(task.robot, limit.name);
      if (i < 0 || explanation.kink) continue;
      EXPECT_NEAR(explanation.efforts.u[i], limit.limit, 1e-6) << name << ' ' << limit.name;
    }
  }
}

/// A winch of 2 N along y: at the whole wrench u_y = 2, at none u_y = 0, which its limits 1 .. 2
/// exclude.
TEST(LeastEfforts, OfAShareThatNoEffortsHoldSaySo) {
  Problem task = make_problem(cartesian_push(Vector6d::Unit(1)));
  task = with_limit(with_limit(task, 1, LimitSide::kUpper, 2), 1, LimitSide::kLower, 1);
  const Answer answer = evaluate_posture(task, Eigen::Vector2d::Zero());
  EXPECT_NEAR(answer.beta(), 2, 1e-12);
  EXPECT_NEAR(explain(answer, {0.75}).efforts.u[1], 1.5, 1e-8);
  EXPECT_NE(explain(answer, {0.25}).efforts.missing.find("no efforts"), std::string::npos);
  EXPECT_EQ(explain(answer, {0.25}).missing, "");  // what binds is known nevertheless
}

/// Weights exist for a motor that only pushes, and for one without limits.
TEST(LeastEfforts, SupportMotorsOfOneDirectionAndWithoutLimits) {
  Problem task = make_problem(cartesian_push(Vector6d::Unit(1)));
  task = with_limit(with_limit(task, 0, LimitSide::kUpper, kInfinity), 0, LimitSide::kLower,
                    -kInfinity);
  task = with_limit(task, 1, LimitSide::kLower, 0);
  const LeastEfforts efforts = explain(evaluate_posture(task, Eigen::Vector2d::Zero())).efforts;
  ASSERT_EQ(efforts.missing, "");
  EXPECT_NEAR(efforts.u[0], 0, 1e-9);
  EXPECT_NEAR(efforts.u[1], 1, 1e-9);
  EXPECT_NEAR(efforts.norm, 1, 1e-9);  // 1 N of at most 1 N
}

}  // namespace
}  // namespace maxwrench
