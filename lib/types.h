#pragma once

#include <Eigen/Dense>
#include <limits>

namespace maxwrench {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Vector6 = Eigen::Matrix<T, 6, 1>;
template <class T>
using MatrixX = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using VectorX = Eigen::Matrix<T, Eigen::Dynamic, 1>;
/// Jacobians and wrench bases: six rows [linear; angular] or [force; torque].
template <class T>
using Matrix6X = Eigen::Matrix<T, 6, Eigen::Dynamic>;

using Vector6d = Vector6<double>;
using Matrix6Xd = Matrix6X<double>;

/// [a]x with [a]x b = a x b.
template <class T>
Matrix3<T> skew(const Vector3<T>& a) {
  const T zero(0.0);
  Matrix3<T> S;
  S << zero, -a.z(), a.y(), a.z(), zero, -a.x(), -a.y(), a.x(), zero;
  return S;
}

/// The rotation vector [rad], of length at most pi, whose rotation is R.
inline Eigen::Vector3d logarithm(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// A rigid transformation x -> R x + p.
template <class T>
struct Pose {
  Matrix3<T> R = Matrix3<T>::Identity();
  Vector3<T> p = Vector3<T>::Zero();

  /// Also for poses of another scalar: a plain and a dual one give a dual one.
  template <class S>
  auto operator*(const Pose<S>& other) const {
    using Result = decltype(T() * S());
    return Pose<Result>{R * other.R, R * other.p + p};
  }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

}  // namespace maxwrench
