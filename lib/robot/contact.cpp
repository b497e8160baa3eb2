#include "maxwrench/contact.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/robot/chain.h"
#include "maxwrench/robot.h"

namespace maxwrench {
namespace {

/// From the axis of a pipe to the contact point.
Eigen::Vector3d spoke(const Contact& contact, const Eigen::Matrix3d& R) {
  return -contact.radius * R.col(2);
}

using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 12, 12>;
using Gains = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 12, 1>;
using Column = Eigen::Matrix<double, 12, 1>;

/// In increasing order.
Gains squared_gains(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                    const Matrix6Xd& J_2) {
  const int rows = contact.rows();
  const double length = contact.length_scale;
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  Gram gram = Gram::Zero(6 + rows, 6 + rows);
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    const bool slides =
        i < axes ? robot.base_axes[static_cast<std::size_t>(i)] < 3
                 : robot.joints[static_cast<std::size_t>(i - axes)].type == JointType::kPrismatic;
    Column column;
    column << J.col(i), J_2.col(i);
    column.segment<3>(3) *= length;
    column.tail<3>() *= length;
    if (!slides) column /= length;
    gram.noalias() += column.head(6 + rows) * column.head(6 + rows).transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Gram>(gram, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

Pose<double> contact_pose(const Contact& contact, const double* s) {
  Pose<double> pose = contact.frame;
  switch (contact.surface) {
    case Surface::kPoint:
      break;
    case Surface::kPlane:
      pose.p += s[1] * pose.R.col(1);
      [[fallthrough]];
    case Surface::kLine:
      pose.p += s[0] * pose.R.col(0);
      break;
    case Surface::kCircle:
      pose.R = pose.R * Eigen::AngleAxisd(s[0], Eigen::Vector3d::UnitY());
      pose.p += spoke(contact, pose.R);
      break;
  }
  return pose;
}

Vector6d contact_twist(const Contact& contact, const double* s, int i) {
  Vector6d twist = Vector6d::Zero();
  if (contact.surface == Surface::kCircle) {
    const Eigen::Vector3d axis = contact.frame.R.col(1);
    twist << axis.cross(spoke(contact, contact_pose(contact, s).R)), axis;
  } else {
    twist.head<3>() = contact.frame.R.col(i);
  }
  return twist;
}

double smallest_gain(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                     const Matrix6Xd& J_2) {
  const auto squares = squared_gains(robot, contact, J, J_2);
  if (contact.rank == 0) return 0;
  return std::sqrt(std::max(squares[squares.size() - contact.rank], 0.0));
}

int stacked_rank(const Robot& robot, int end_effector, const Contact& contact) {
  constexpr double kZero = 1e-12;
  Matrix6Xd J(6, robot.velocities());
  Matrix6Xd J_2 = J;
  return generic_rank(robot, [&](const Kinematics<double>& kinematics) {
    const auto at = [&](int i) { return robot.end_effectors[static_cast<std::size_t>(i)]; };
    kinematics.jacobian(at(end_effector), Eigen::Matrix3d::Identity(), J);
    kinematics.jacobian(at(contact.end_effector), Eigen::Matrix3d::Identity(), J_2);
    const auto squares = squared_gains(robot, contact, J, J_2);
    return (squares.array() > kZero * squares.maxCoeff()).count();
  });
}

int following_rank(const Robot& robot, const Contact& contact) {
  Matrix6Xd J_2(6, robot.velocities());
  Eigen::MatrixXd J_f(contact.rows(), contact.follow.size());
  return generic_rank(robot, [&](const Kinematics<double>& kinematics) {
    kinematics.jacobian(robot.end_effectors[static_cast<std::size_t>(contact.end_effector)],
                        Eigen::Matrix3d::Identity(), J_2);
    const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
    for (Eigen::Index i = 0; i < J_f.cols(); ++i) {
      J_f.col(i) = J_2.col(axes + contact.follow[static_cast<std::size_t>(i)]).head(J_f.rows());
    }
    return split(J_f, kRankTolerance).range.cols();
  });
}

}  // namespace maxwrench
