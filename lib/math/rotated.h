#pragma once

#include "maxwrench/types.h"

namespace maxwrench {

/// The rotation about a vector by its length [rad]. `logarithm` is its inverse.
inline Eigen::Matrix3d rotation_by(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

/// blkdiag(R, R) x, where the columns of x are wrenches [force; torque] or twists.
template <class Columns>
auto rotated(const Matrix3<typename Columns::Scalar>& R, const Eigen::MatrixBase<Columns>& x) {
  Eigen::Matrix<typename Columns::Scalar, 6, Columns::ColsAtCompileTime> result(6, x.cols());
  result << R * x.template topRows<3>(), R * x.template bottomRows<3>();
  return result;
}

/// The same into `result`, which is not reallocated if it has the right size.
inline void rotate_into(const Eigen::Matrix3d& R, const Matrix6Xd& x, Matrix6Xd& result) {
  result.resize(6, x.cols());
  result.topRows<3>().noalias() = R.lazyProduct(x.topRows<3>());
  result.bottomRows<3>().noalias() = R.lazyProduct(x.bottomRows<3>());
}

}  // namespace maxwrench
