#include <cmath>

#include "tests/support/coded_tasks.h"
#include "tests/support/wrench_sets.h"
#include "tests/support/zonotope_robot.h"

namespace maxwrench {
namespace {

TEST(ForceEllipsoid, OfDirectDrives) {
  // |((f + tau_d) / limit)| <= 1 with the smaller limits 1, 2 and 3: centre -tau_d, radii 3, 2, 1.
  ZonotopeRobot robot(Eigen::Matrix3d::Identity());
  robot.set_limits(Eigen::Matrix3d::Identity(), Eigen::Vector3d(-1, -2, -4),
                   Eigen::Vector3d(2, 2, 3));
  robot.posture.tau_d = Eigen::Vector3d(0.5, 0, -5);
  const WrenchEllipsoid set = force_ellipsoid(robot.problem, robot.posture);
  ASSERT_EQ(set.status, Status::kOptimal);
  EXPECT_NEAR((set.centre - Eigen::Vector3d(-0.5, 0, 5)).norm(), 0, 1e-12);
  EXPECT_NEAR((set.radii - Eigen::Vector3d(3, 2, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR(set.axes.determinant(), 1, 1e-12);
  EXPECT_NEAR((set.shape() - Eigen::Matrix3d(Eigen::Vector3d(1, 4, 9).asDiagonal())).norm(), 0,
              1e-12);
  EXPECT_NEAR(set.volume, 8 * M_PI, 1e-9);
}

TEST(ForceEllipsoid, AnyIsTheProjection) {
  // Of points of |K (tau_d + J'h)| = 1 in all six axes, the force is in the projection, and the
  // point that is farthest along a force e is on it: h = centre + S e / sqrt(e'S e) with S =
  // (J K'K J')^-1 in six dimensions, whose first block is the shape of the projection.
  Random random(4);
  ZonotopeRobot robot(random_matrix(random, 6, 9));
  robot.posture.J = random_matrix(random, 6, 6);
  robot.posture.tau_d = 0.1 * random_matrix(random, 6, 1);
  robot.problem.W_any = Matrix6Xd::Identity(6, 6);
  const WrenchEllipsoid set =
      force_ellipsoid(robot.problem, robot.posture, Matrix6Xd::Identity(6, 3), Wrench::kAny);
  ASSERT_EQ(set.status, Status::kOptimal) << set.reason.c_str();
  const Eigen::MatrixXd K = robot.problem.robot.actuation.B_pinv;  // all limits are 1
  const Eigen::MatrixXd G = K * robot.posture.J.transpose();
  const Eigen::VectorXd g = K * robot.posture.tau_d;
  const Eigen::MatrixXd inverse = (G.transpose() * G).inverse();
  const Eigen::VectorXd centre = -(inverse * (G.transpose() * g));
  const double rho2 = 1 - (g + G * centre).squaredNorm();
  EXPECT_NEAR((set.centre - centre.head<3>()).norm(), 0, 1e-9 * (1 + centre.norm()));
  EXPECT_NEAR((set.shape() - rho2 * inverse.topLeftCorner<3, 3>()).norm(), 0,
              1e-9 * set.shape().norm());
}

TEST(ForceEllipsoid, WithoutAnEnd) {
  ZonotopeRobot robot(Eigen::Matrix2d::Identity());  // fewer efforts than columns
  const WrenchEllipsoid set = force_ellipsoid(robot.problem, robot.posture);
  EXPECT_EQ(set.status, Status::kUnbounded);
  EXPECT_NEAR(std::abs(set.ray[2]), 1, 1e-12);
  EXPECT_EQ(set.radii.size(), 0);
}

TEST(ForceEllipsoid, Nothing) {
  ZonotopeRobot robot(Eigen::Matrix4d::Identity());
  robot.posture.tau_d[3] = 1.01;  // no force changes the fourth effort
  EXPECT_EQ(force_ellipsoid(robot.problem, robot.posture).status, Status::kInfeasible);
  robot.posture.tau_d[3] = 0.6;  // a slice of the unit ball of radius 0.8
  const WrenchEllipsoid slice = force_ellipsoid(robot.problem, robot.posture);
  EXPECT_NEAR((slice.radii - Eigen::Vector3d::Constant(0.8)).norm(), 0, 1e-12);
}

TEST(ForceEllipsoid, BadInput) {
  ZonotopeRobot robot(Eigen::Matrix3d::Identity());
  EXPECT_EQ(
      rejection_of([&] { force_ellipsoid(robot.problem, robot.posture, Matrix6Xd::Zero(6, 1)); }),
      "E: got 1 columns of rank 0, expected independent columns");
  robot.posture.J(0, 0) = kNan;
  EXPECT_EQ(force_ellipsoid(robot.problem, robot.posture).status, Status::kNumericalError);
  robot.posture.conclude(Status::kInvalidPosture, "out of reach");
  EXPECT_EQ(force_ellipsoid(robot.problem, robot.posture).status, Status::kInvalidPosture);
  const ZonotopeRobot flat(Eigen::MatrixXd::Ones(3, 2));
  EXPECT_EQ(rejection_of([&] { force_ellipsoid(flat.problem, flat.posture); }),
            "measure ellipsoid: B of zonotope has rank 1, expected 3");
  robot.set_limits(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  EXPECT_EQ(rejection_of([&] { force_ellipsoid(robot.problem, robot.posture); }),
            "measure ellipsoid: an actuator of zonotope cannot act in both directions, expected "
            "min < 0 < max");
}

}  // namespace
}  // namespace maxwrench
