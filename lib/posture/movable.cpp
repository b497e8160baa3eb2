#include "lib/posture/movable.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/math/rotated.h"
#include "lib/robot/chain.h"
#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

using Eigen::Matrix3d;

/// [-, squared distance] An axis this close to a subspace lies in it.
constexpr double kOnAxis = 1e-12;

/// The motions of an end effector whose dependent coordinates are the base alone, which moves it in
/// every possible way.
Matrix6Xd base_motions(const Problem& problem) {
  const Robot& robot = problem.robot;
  const Pose<double> pose = pose_at(problem, problem.theta_r_default);
  const Eigen::Vector3d lever = pose.p - robot.mount.p;
  Matrix6Xd twists = Matrix6Xd::Zero(6, static_cast<Eigen::Index>(robot.base_axes.size()));
  Eigen::Index column = 0;
  for (const int axis : robot.base_axes) {
    const Eigen::Vector3d a = robot.mount.R.col(axis % 3);
    twists.col(column).head<3>() = axis < 3 ? a : a.cross(lever);
    if (axis >= 3) twists.col(column).tail<3>() = a;
    ++column;
  }
  return twists;
}

/// The projector onto the sum of the ranges of `rows` of J over postures.
class Span {
 public:
  void add(const Eigen::MatrixXd& rows) { gram_ += rows * rows.transpose(); }
  Matrix3d projector() const {
    const Eigen::MatrixXd Q = tidy_range(gram_);
    return Q * Q.transpose();
  }

 private:
  Matrix3d gram_ = Matrix3d::Zero();
};

}  // namespace

Eigen::MatrixXd tidy_range(const Eigen::MatrixXd& A) {
  const Eigen::MatrixXd Q = split(A, kRankTolerance).range;
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(A.rows(), Q.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < A.rows() && count < Q.cols(); ++i) {
    if (1 - Q.row(i).squaredNorm() < kOnAxis) units(i, count++) = 1;
  }
  return count == Q.cols() ? units : Q;
}

Matrix6Xd motions_at_pose(const Problem& problem) {
  Matrix6Xd T = base_motions(problem);
  if (!problem.dependent.empty()) {
    PostureEvaluator model(problem, false);
    T = model.evaluate(problem.theta_r_default).J;
  }
  if (problem.free.wrench_turns) {
    const Pose<double> pose = pose_at(problem, problem.theta_r_default);
    T = rotated(problem.pose.R * pose.R.transpose(), T);
  }
  return tidy_range(T);
}

Eigen::Matrix<double, 6, 6> movable_at_contact(const Robot& robot, const Contact& contact) {
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(contact.end_effector)];
  const bool yaws =
      std::find(robot.base_axes.begin(), robot.base_axes.end(), 5) != robot.base_axes.end();
  Span linear, angular;
  Matrix6Xd J(6, robot.velocities());
  double yaw = 0;
  generic_rank(robot, [&](const Kinematics<double>& kinematics) {
    const Pose<double> base = base_pose(robot, {0, 0, 0, yaws ? yaw : 0});
    kinematics.jacobian(tip, base.R, J);
    linear.add(J.topRows<3>());
    angular.add(J.bottomRows<3>());
    yaw += 1;
    return 0;
  });
  const Matrix3d P_v = linear.projector(), P_w = angular.projector();
  Eigen::Matrix<double, 6, 6> P = Eigen::Matrix<double, 6, 6>::Zero();
  const std::array<double, 2> origin{}, elsewhere{1, 1};
  const Matrix3d R = contact_pose(contact, origin.data()).R;
  const Matrix3d turned = contact_pose(contact, elsewhere.data()).R;
  const auto seen = [](const Matrix3d& projector, const Matrix3d& axes) -> Matrix3d {
    const Eigen::MatrixXd Q = tidy_range(axes.transpose() * projector);
    return Q * Q.transpose();
  };
  P.topLeftCorner<3, 3>() = seen(P_v, R);
  P.bottomRightCorner<3, 3>() = seen(P_w, R);
  const bool constant = seen(P_v, turned).isApprox(P.topLeftCorner<3, 3>(), kRankTolerance) &&
                        seen(P_w, turned).isApprox(P.bottomRightCorner<3, 3>(), kRankTolerance);
  if (!constant) P.setIdentity();
  return P;
}

}  // namespace maxwrench
