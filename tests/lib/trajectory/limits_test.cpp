#include "lib/trajectory/limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TrajectoryEvaluator limits_evaluator(const Problem& problem) {
  return {problem, Wrench::kPure, trajectory_solvers().front().make};
}

/// The shoulder folds from knot to knot, so the elbow stretches (see
/// tests/problems/mobile_test.cpp) and turns at almost twice the rate.
Eigen::MatrixXd folding(const Problem& problem, double rise) {
  Eigen::MatrixXd knots = problem.theta_r_default.transpose().replicate(problem.motion->k, 1);
  for (Eigen::Index i = 0; i < knots.rows(); ++i) {
    knots(i, 1) -= rise * static_cast<double>(i) / static_cast<double>(knots.rows() - 1);
  }
  return knots;
}

Joint& joint_named(Problem& problem, const std::string& name) {
  for (Joint& joint : problem.robot.joints) {
    if (joint.name == name) return joint;
  }
  throw std::logic_error(name);
}

TEST(FollowingLimits, NameTheDependentJointThatIsTooFast) {
  for (const Scheme scheme : {Scheme::kSpline, Scheme::kForward, Scheme::kEnds}) {
    Problem problem = load_problem("mobile/trajectory");
    problem.motion->scheme = scheme;
    const Eigen::MatrixXd knots = folding(problem, 0.8);
    EXPECT_EQ(limits_evaluator(problem).evaluate(knots).status, Status::kOptimal);
    joint_named(problem, "elbow").velocity_max = 0.25;
    const std::string reason = limits_evaluator(problem).evaluate(knots).reason.str();
    EXPECT_TRUE(reason.starts_with("speed limit: knots ")) << reason;
    EXPECT_NE(reason.find(": elbow at "), std::string::npos) << reason;
    EXPECT_TRUE(reason.ends_with(" per s, limit 0.25")) << reason;
  }
}

/// Between knots the rates of a spline are higher than from knot to knot.
TEST(FollowingLimits, HoldAtInstantsBetweenKnots) {
  Problem problem = load_problem("mobile/trajectory");
  const Eigen::MatrixXd knots = folding(problem, 0.8);
  TrajectoryEvaluator evaluator = limits_evaluator(problem);
  const auto& instants = evaluator.evaluate(knots).instants;
  const int per_knot = problem.motion->instants_per_interval;
  const double dt = problem.motion->T / (problem.motion->k - 1);
  double rate = 0, mean = 0;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    rate = std::max(rate, std::abs(instants[i].v[3 + 2]));
    if (i % per_knot != 0 || i == 0) continue;
    mean = std::max(mean, std::abs(instants[i].q[2] - instants[i - per_knot].q[2]) / dt);
  }
  ASSERT_GT(rate, 1.001 * mean);
  joint_named(problem, "elbow").velocity_max = (rate + mean) / 2;
  const std::string reason = limits_evaluator(problem).evaluate(knots).reason.str();
  EXPECT_TRUE(reason.starts_with("speed limit: ")) << reason;
  EXPECT_EQ(reason.find("speed limit: knots "), std::string::npos) << reason;
  EXPECT_NE(reason.find(": elbow at "), std::string::npos) << reason;
}

TEST(FollowingLimits, NameTheDependentJointBeyondItsLimit) {
  Problem problem = load_problem("mobile/trajectory");
  joint_named(problem, "elbow").q_max = 1.2;
  const std::string reason = limits_evaluator(problem).evaluate(folding(problem, 0.8)).reason.str();
  EXPECT_TRUE(reason.starts_with("joint limit: ")) << reason;
  EXPECT_NE(reason.find(": elbow at 1.2"), std::string::npos) << reason;
  EXPECT_TRUE(reason.ends_with("limits -2.6 .. 1.2")) << reason;
}

/// Values and derivatives of what is limited of dependent joints, by central differences.
TEST(FollowingLimits, RowsAreDerivatives) {
  for (const Scheme scheme : {Scheme::kSpline, Scheme::kForward, Scheme::kEnds}) {
    Problem problem = load_problem("mobile/trajectory");
    problem.motion->scheme = scheme;
    TrajectoryEvaluator evaluator = limits_evaluator(problem);
    Random random(4);
    Eigen::VectorXd x = stacked(folding(problem, 0.5));
    for (double& q : x) q += random.uniform(-0.05, 0.05);
    const auto rows_at = [&](const Eigen::VectorXd& at) {
      EXPECT_GT(evaluator.evaluate_elastic(unstacked(at, knots_of(problem)), nullptr), -kInfinity);
      evaluator.linearize();
      return evaluator.dependent_rows();
    };
    const DependentRows rows = rows_at(x);
    ASSERT_GT(rows.at.size(), 0);
    EXPECT_TRUE((rows.at.array() >= rows.r_min.array()).all());
    EXPECT_TRUE((rows.at.array() <= rows.r_max.array()).all());
    const double h = 1e-5;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), j);
      const Eigen::VectorXd slope = (rows_at(x + step).at - rows_at(x - step).at) / (2 * h);
      EXPECT_LT((slope - Eigen::VectorXd(rows.R.col(j))).lpNorm<Eigen::Infinity>(), 1e-7)
          << to_string(scheme);
    }
  }
}

TEST(FollowingLimits, AreNoneWithoutDependentJoints) {
  const Problem problem = load_problem("planar/trajectory");
  TrajectoryEvaluator evaluator = limits_evaluator(problem);
  evaluator.evaluate_elastic(problem.theta_r_default.transpose().replicate(problem.motion->k, 1),
                             nullptr);
  evaluator.linearize();
  EXPECT_EQ(evaluator.dependent_rows().at.size(), 0);
}

}  // namespace
}  // namespace maxwrench
