#include "lib/trajectory/scheme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/support.h"

namespace maxwrench {
namespace {

MotionTask turn(Scheme scheme, int k) {
  MotionTask task;
  task.T = 5;
  task.k = k;
  task.scheme = scheme;
  task.path = Path::screw({}, {0, 0, 1}, {0, 0, 0}, M_PI, {0, 0, 0}, Timing::kCubic, task.T);
  return task;
}

MotionTask impulse(Scheme scheme, int k) {
  MotionTask task;
  task.impulse = true;
  task.T = 2;
  task.k = k;
  task.scheme = scheme;
  task.instants_per_interval = 16;
  return task;
}

/// K numbers, a knot each.
Eigen::VectorXd random_knots(int count) {
  Random random(7);
  Eigen::VectorXd knots(count);
  for (double& knot : knots) knot = random.uniform(-1, 1);
  return knots;
}

/// phi of the cubic timing.
double phi(double s) { return 3 * s * s - 2 * s * s * s; }

TEST(Scheme, SplinePassesItsKnotsAndRestsAtItsEnds) {
  for (const MotionTask& task : {turn(Scheme::kSpline, 7), impulse(Scheme::kSpline, 4)}) {
    const SchemeMaps maps = make_scheme(task);
    const Eigen::VectorXd Q = random_knots(maps.knots());
    const Eigen::VectorXd q = maps.P * Q, rate = maps.V * Q;
    EXPECT_EQ(maps.instants(), (maps.knots() - 1) * task.instants_per_interval + 1);
    for (int knot = 0; knot < maps.knots(); ++knot) {
      EXPECT_NEAR(q[maps.knot_at[static_cast<std::size_t>(knot)]], Q[knot], 1e-14);
    }
    EXPECT_NEAR(rate[0], 0, 1e-13);
    EXPECT_NEAR(rate[maps.instants() - 1], 0, 1e-13);
    EXPECT_EQ(maps.t.back(), task.T);
  }
}

TEST(Scheme, SplineIsDifferentiableTwice) {
  // With many instants an interval, differences of the values are the rates, and of the rates the
  // accelerations, across the knots too: central differences miss a cubic by h^2/6 times its third
  // derivative.
  MotionTask task = turn(Scheme::kSpline, 6);
  const SchemeMaps maps = make_dense_spline(task, 2000);
  const Eigen::VectorXd Q = random_knots(6);
  const Eigen::VectorXd q = maps.P * Q, rate = maps.V * Q, bend = maps.A * Q;
  const double h = maps.t[1];
  for (Eigen::Index i = 1; i + 1 < q.size(); ++i) {
    EXPECT_NEAR((q[i + 1] - q[i - 1]) / (2 * h), rate[i], 1e-5);
    EXPECT_NEAR((rate[i + 1] - rate[i - 1]) / (2 * h), bend[i], 2e-2);
  }
}

TEST(Scheme, ForwardTakesItsTimesAndPosesFromDifferentGrids) {
  const SchemeMaps maps = make_scheme(turn(Scheme::kForward, 6));
  for (int i = 0; i < 6; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_NEAR(maps.t[at], i * 5.0 / 6, 1e-15);
    // The angle of the pose, and the difference of two by dt = T/k.
    const double angle = M_PI * phi(i / 5.0);
    EXPECT_NEAR(maps.x[at].pose.R(1, 0), std::sin(angle), 1e-14);
    const double rate = i == 5 ? 0 : (M_PI * phi((i + 1) / 5.0) - angle) / (5.0 / 6);
    EXPECT_TRUE(maps.x[at].twist.isApprox(rate * Vector6d::Unit(5), 1e-12) || rate == 0);
  }
  EXPECT_EQ(maps.moves, (Eigen::VectorXd(6) << 1, 1, 1, 1, 1, 0).finished());
}

TEST(Scheme, EndsRestAtBothEnds) {
  const SchemeMaps maps = make_scheme(turn(Scheme::kEnds, 5));
  EXPECT_EQ(maps.moves, (Eigen::VectorXd(5) << 0, 1, 1, 1, 0).finished());
  EXPECT_EQ(maps.t.back(), 5);
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(5, 0, 4);
  EXPECT_TRUE((maps.D * v).head(4).isApprox(Eigen::VectorXd::Constant(4, 0.8), 1e-14));
  EXPECT_EQ((maps.D * v)[4], 0);
}

TEST(Scheme, TwistOfDifferencesLeadsFromPoseToPose) {
  // In a screw about an axis that does not pass the tool, exp(dt log) must hit the next pose: with
  // the twist (v, w) at the origin of the first, turning w dt, its origin moves by V v dt.
  MotionTask task = turn(Scheme::kEnds, 4);
  task.path = Path::screw({}, {0, 1, 0}, {0.4, 0, 0.1}, 1.7, {0, 0.2, 0}, Timing::kCubic, task.T);
  const SchemeMaps maps = make_scheme(task);
  for (std::size_t i = 0; i + 1 < 4; ++i) {
    const Vector6d step = maps.x[i].twist * maps.dt;
    const Eigen::Vector3d w = step.tail<3>();
    const double a = w.norm();
    const Eigen::Matrix3d S = skew(w);
    const Eigen::Matrix3d V = Eigen::Matrix3d::Identity() + (1 - std::cos(a)) / (a * a) * S +
                              (a - std::sin(a)) / (a * a * a) * S * S;
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(a, w / a).toRotationMatrix();
    EXPECT_TRUE((turned * maps.x[i].pose.R).isApprox(maps.x[i + 1].pose.R, 1e-12));
    EXPECT_TRUE((maps.x[i].pose.p + V * step.head<3>()).isApprox(maps.x[i + 1].pose.p, 1e-12));
  }
}

TEST(Scheme, ImpulsesBeginAtRest) {
  const Eigen::VectorXd Q = Eigen::Vector4d(1, 2, 4, 8);
  const double dt = 2.0 / 3;
  const SchemeMaps backward = make_scheme(impulse(Scheme::kBackward, 3));
  // v = (0, 1, 2, 4)/dt, a_i = (v_i - v_i-1)/dt.
  Eigen::VectorXd v = backward.V * Q;
  EXPECT_TRUE((v * dt).isApprox(Eigen::Vector4d(0, 1, 2, 4), 1e-14));
  EXPECT_TRUE((backward.D * v * dt * dt).isApprox(Eigen::Vector4d(0, 1, 1, 2), 1e-14));
  const SchemeMaps forward = make_scheme(impulse(Scheme::kForward, 3));
  // v = (0, 2, 4, 0)/dt, a_i = (v_i+1 - v_i)/dt for i >= 1, the last zero.
  v = forward.V * Q;
  EXPECT_TRUE((v * dt).isApprox(Eigen::Vector4d(0, 2, 4, 0), 1e-14));
  EXPECT_TRUE((forward.D * v * dt * dt).isApprox(Eigen::Vector4d(0, 2, -4, 0), 1e-14));
  EXPECT_EQ(make_scheme(impulse(Scheme::kBackwardStop, 3)).zero * Q,
            Eigen::VectorXd::Constant(1, 4));
}

TEST(Scheme, RowsLimitEveryPairOfKnotsAndEveryInstant) {
  const SchemeMaps maps = make_scheme(turn(Scheme::kSpline, 4));
  EXPECT_EQ(maps.speed.rows(), 3 + maps.instants());
  EXPECT_EQ(maps.place.rows(), maps.instants());
  const Eigen::VectorXd rates = maps.speed * Eigen::Vector4d(0, 5, 5, 0);
  EXPECT_NEAR(rates[0], 3, 1e-14);  // 5 in T/3
  EXPECT_NEAR(rates[1], 0, 1e-14);
  const SchemeMaps heaving = make_scheme(impulse(Scheme::kSpline, 3));
  ASSERT_EQ(heaving.zero.rows(), 1);
  EXPECT_NEAR(heaving.zero.row(0).dot(Eigen::Vector4d::Ones()), 0, 1e-12);
}

TEST(Scheme, OneKnotRests) {
  for (const Scheme scheme : {Scheme::kForward, Scheme::kEnds}) {
    const SchemeMaps maps = make_scheme(turn(scheme, 1));
    EXPECT_EQ(maps.instants(), 1);
    EXPECT_EQ(maps.moves[0], 0);
    EXPECT_EQ(maps.speed.rows(), 0);
    EXPECT_TRUE(maps.x[0].pose.R.isIdentity());
  }
  EXPECT_THROW(make_scheme(turn(Scheme::kSpline, 1)), std::invalid_argument);
}

TEST(Scheme, SupportsOneKindOfTask) {
  EXPECT_THROW(make_scheme(turn(Scheme::kBackward, 4)), std::invalid_argument);
  EXPECT_THROW(make_scheme(impulse(Scheme::kEnds, 4)), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
