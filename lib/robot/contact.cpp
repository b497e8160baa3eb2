#include "maxwrench/contact.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/robot/chain.h"
#include "maxwrench/robot.h"

namespace maxwrench {
namespace {

/// The vector from the axis of a pipe to the contact point.
Eigen::Vector3d spoke(const Contact& contact, const Eigen::Matrix3d& R) {
  return -contact.radius * R.col(2);
}

template <int kRows>
using Square = Eigen::Matrix<double, kRows, kRows>;

/// The lower triangle of the Gram matrix JJ' of the stacked J, with lengths in units of
/// length_scale.
template <int kRows>
Square<kRows> gram_of(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                      const Matrix6Xd& J_2) {
  constexpr int kSecond = kRows - 6;
  const double length = contact.length_scale;
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  Square<kRows> gram = Square<kRows>::Zero();
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    const bool slides =
        i < axes ? robot.base_axes[static_cast<std::size_t>(i)] < 3
                 : robot.joints[static_cast<std::size_t>(i - axes)].type == JointType::kPrismatic;
    const double weight = slides ? 1 : 1 / (length * length);
    const auto a = J.col(i);
    const auto b = J_2.col(i).template head<kSecond>();
    for (int k = 0; k < 6; ++k) {
      gram.col(k).template head<6>() += weight * a[k] * a;
      if (i < axes) gram.col(k).template tail<kSecond>() += weight * a[k] * b;
    }
    for (int k = 0; k < kSecond; ++k) {
      gram.col(6 + k).template tail<kSecond>() += weight * b[k] * b;
    }
  }
  for (const int first : {3, 9}) {  // angular rows
    for (int k = first; k < first + 3 && k < kRows; ++k) {
      gram.row(k) *= length;
      gram.col(k) *= length;
    }
  }
  return gram;
}

using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 12, 12>;
using Gains = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 12, 1>;

/// In increasing order.
Gains squared_gains(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                    const Matrix6Xd& J_2) {
  const Gram gram = contact.holds_axes ? Gram(gram_of<12>(robot, contact, J, J_2))
                                       : Gram(gram_of<9>(robot, contact, J, J_2));
  return Eigen::SelfAdjointEigenSolver<Gram>(gram, Eigen::EigenvaluesOnly).eigenvalues();
}

/// The number of positive eigenvalues of the symmetric matrix A, which equals the number of
/// positive pivots (Sylvester's law of inertia). -1 if a pivot is so small that its sign may be due
/// to rounding. Overwrites A.
template <int kRows>
int count_positive(Square<kRows>& A) {
  const double smallest = 1e-6 * A.diagonal().cwiseAbs().sum();
  int count = 0;
  for (int k = 0; k < kRows; ++k) {
    const double pivot = A(k, k);
    if (!(std::abs(pivot) > smallest)) return -1;
    count += pivot > 0;
    const double inverse = 1 / pivot;
    for (int j = k + 1; j < kRows; ++j) {
      const double factor = A(j, k) * inverse;
      for (int i = j; i < kRows; ++i) A(i, j) -= factor * A(i, k);
    }
  }
  return count;
}

/// The number of gains that exceed sigma_min, or -1 if rounding leaves it open.
template <int kRows>
int count_large(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                const Matrix6Xd& J_2) {
  Square<kRows> shifted = gram_of<kRows>(robot, contact, J, J_2);
  shifted.diagonal().array() -= contact.sigma_min * contact.sigma_min;
  return count_positive<kRows>(shifted);
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

bool near_singular(const Robot& robot, const Contact& contact, const Matrix6Xd& J,
                   const Matrix6Xd& J_2) {
  const int large = contact.holds_axes ? count_large<12>(robot, contact, J, J_2)
                                       : count_large<9>(robot, contact, J, J_2);
  if (large >= 0 && contact.rank > 0) return large < contact.rank;
  return smallest_gain(robot, contact, J, J_2) < contact.sigma_min;
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

int dependent_rank(const Robot& robot, const Contact& contact) {
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
