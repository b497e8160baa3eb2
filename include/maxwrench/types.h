#pragma once

#include <Eigen/Dense>
#include <array>
#include <limits>
#include <string>

namespace maxwrench {

// Memory that one side allocates is freed by the other, so Eigen must allocate here as in the
// library. MAXWRENCH_AVX, 0 or 1, comes with maxwrench::maxwrench and pkg-config --cflags
// maxwrench.
#ifdef MAXWRENCH_AVX
inline constexpr bool kForAvx = MAXWRENCH_AVX;
#else
inline constexpr bool kForAvx = false;
#endif
static_assert(
    kForAvx ? EIGEN_MALLOC_ALREADY_ALIGNED == 0 && EIGEN_MAX_ALIGN_BYTES > 16 &&
                  EIGEN_MAX_STATIC_ALIGN_BYTES > 16
            : EIGEN_MALLOC_ALREADY_ALIGNED == 1 && EIGEN_MAX_ALIGN_BYTES == 16 &&
                  EIGEN_MAX_STATIC_ALIGN_BYTES == 16 && EIGEN_DEFAULT_ALIGN_BYTES == 16,
    "maxwrench: Eigen allocates memory here in another way than in the library. A program that is "
    "compiled for AVX (such as with -march=native) needs a maxwrench that was built with -D "
    "MAXWRENCH_AVX=ON; one without AVX needs one built without that option, and with "
    "AddressSanitizer also -D EIGEN_MALLOC_ALREADY_ALIGNED=1. See docs/install.md");

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

/// Which end effector wrenches are allowed: only multiples of c (eq:orthogonalConstraint, beta_2),
/// or any (beta_3).
enum class Wrench { kPure, kAny };
const char* to_string(Wrench wrench);
/// "pure" or "any"; throws std::invalid_argument otherwise.
Wrench parse_wrench(const std::string& name);

/// The axes of a twist or of the base, and of a wrench, as they are called in files.
inline constexpr std::array<const char*, 6> kTwistAxes = {"x", "y", "z", "roll", "pitch", "yaw"};
inline constexpr std::array<const char*, 6> kWrenchAxes = {"fx", "fy", "fz", "tx", "ty", "tz"};

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
