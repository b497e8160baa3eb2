#include "solvers/certify/bound/thrust_points.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

class ThrustPointsOfTwoArms : public testing::Test {
 protected:
  ThrustPointsOfTwoArms()
      : problem_(load_problem("dual_arm/two_arms")),
        model_(problem_, ContactForces::kOfBase),
        count_(static_cast<Eigen::Index>(problem_.robot.thrusters.size())),
        points_(model_, problem_.robot.actuation, count_) {}

  /// -lambda'K u at x.
  double value(const Eigen::VectorXd& x, const Eigen::VectorXd& lambda,
               const Eigen::VectorXd& u) const {
    const Eigen::MatrixXd B = problem_.robot.actuation.B.leftCols(count_);
    const Eigen::MatrixXd A = model_.levers->evaluate(x).reshaped(model_.n, 3);
    return -lambda.dot(A * (B.topRows(3) * u) - B * u);
  }

  Eigen::VectorXd corner(unsigned pattern) const {
    const Zonotope& set = problem_.robot.actuation;
    Eigen::VectorXd u = set.u_min.head(count_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      if ((pattern >> k & 1U) != 0) u[k] = set.u_max[k];
    }
    return u;
  }

  const Problem problem_;
  const LoopModel model_;
  const Eigen::Index count_;
  ThrustPoints points_;
};

/// In a box without width all control points are its posture.
TEST_F(ThrustPointsOfTwoArms, AreTheBestOfAllCornersAtAPosture) {
  Random random(1);
  for (int sample = 0; sample < 20; ++sample) {
    Eigen::VectorXd x = model_.coordinates.lower;
    for (double& each : x) each = random.uniform(-2, 2);
    const Eigen::VectorXd lambda =
        Eigen::VectorXd::NullaryExpr(model_.n, [&] { return random.uniform(-1, 1); });
    points_.set(x, x);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(model_.size);
    points_.weigh(lambda, g);
    double best = -kInfinity;
    for (unsigned pattern = 0; pattern < 1U << count_; ++pattern) {
      best = std::max(best, value(x, lambda, corner(pattern)));
    }
    EXPECT_NEAR(-g.minCoeff(), best, 1e-9 * (1 + std::abs(best)));
    EXPECT_NEAR(-g.maxCoeff(), best, 1e-9 * (1 + std::abs(best)));
    const Eigen::Index v = model_.size / 2;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(model_.n);
    points_.add(v, points_.pattern(v), load);
    EXPECT_NEAR(-lambda.dot(load), best, 1e-9 * (1 + std::abs(best)));
  }
}

/// No thrusts at a posture of the box exceed the largest of the control points.
TEST_F(ThrustPointsOfTwoArms, BoundABox) {
  Random random(2);
  for (int sample = 0; sample < 200; ++sample) {
    Eigen::VectorXd lower = model_.coordinates.lower, upper = lower, x = lower;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      lower[i] = random.uniform(-2, 2);
      upper[i] = lower[i] + random.uniform(0, 1);
      x[i] = random.uniform(lower[i], upper[i]);
    }
    const Eigen::VectorXd lambda =
        Eigen::VectorXd::NullaryExpr(model_.n, [&] { return random.uniform(-1, 1); });
    points_.set(lower, upper);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(model_.size);
    points_.weigh(lambda, g);
    Eigen::VectorXd u = corner(0);
    const Zonotope& set = problem_.robot.actuation;
    for (Eigen::Index k = 0; k < count_; ++k) u[k] = random.uniform(set.u_min[k], set.u_max[k]);
    EXPECT_LE(value(x, lambda, u), -g.minCoeff() + 1e-9);
  }
}

}  // namespace
}  // namespace maxwrench
