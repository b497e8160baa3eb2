#pragma once

#include <Eigen/Dense>
#include <array>
#include <limits>
#include <string>

/// @file
/// Basic types: vectors, poses, and the allowed wrenches.

/// The public interface of maxwrench.
///
/// The first functions to know are `load_problem`, `evaluate` and `solve`.
namespace maxwrench {

// Memory that the library allocates is freed by the program, and the reverse. So Eigen must
// allocate here as in the library. The CMake target maxwrench::maxwrench and pkg-config --cflags
// maxwrench define MAXWRENCH_AVX as 0 or 1.
#ifdef MAXWRENCH_AVX
/// Whether the library was built for AVX.
inline constexpr bool kForAvx = MAXWRENCH_AVX;
#else
/// Whether the library was built for AVX.
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

/// Infinity.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A vector of 3 scalars.
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
/// A 3×3 matrix.
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
/// A vector of 6 scalars, such as a twist [linear; angular] or a wrench [force; torque].
template <class T>
using Vector6 = Eigen::Matrix<T, 6, 1>;
/// A matrix of any size.
template <class T>
using MatrixX = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
/// A vector of any size.
template <class T>
using VectorX = Eigen::Matrix<T, Eigen::Dynamic, 1>;
/// A matrix with six rows: a Jacobian [linear; angular] or a wrench basis [force; torque].
template <class T>
using Matrix6X = Eigen::Matrix<T, 6, Eigen::Dynamic>;

using Vector6d = Vector6<double>;    ///< A vector of 6 numbers, see `Vector6`.
using Matrix6Xd = Matrix6X<double>;  ///< A matrix with six rows, see `Matrix6X`.

/// The end effector wrenches that are allowed.
enum class Wrench {
  kPure,  ///< only multiples of c (eq:orthogonalConstraint, beta_2)
  kAny    ///< also the other wrenches of `Problem::W_any` (beta_3)
};
/// Returns the name of the allowed wrenches: "pure" or "any".
const char* to_string(Wrench wrench);
/// Returns the allowed wrenches with this name.
///
/// @throws std::invalid_argument unless it is "pure" or "any".
Wrench parse_wrench(const std::string& name);

/// The names in files of the axes of a twist or of the base.
inline constexpr std::array<const char*, 6> kTwistAxes = {"x", "y", "z", "roll", "pitch", "yaw"};
/// The names in files of the axes of a wrench.
inline constexpr std::array<const char*, 6> kWrenchAxes = {"fx", "fy", "fz", "tx", "ty", "tz"};

/// Returns the matrix [a]x with [a]x b = a x b.
template <class T>
Matrix3<T> skew(const Vector3<T>& a) {
  const T zero(0.0);
  Matrix3<T> S;
  S << zero, -a.z(), a.y(), a.z(), zero, -a.x(), -a.y(), a.x(), zero;
  return S;
}

/// Returns the rotation vector [rad] of the rotation R. Its length is at most pi.
inline Eigen::Vector3d logarithm(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// A rigid transformation x -> R x + p.
template <class T>
struct Pose {
  Matrix3<T> R = Matrix3<T>::Identity();  ///< rotation
  Vector3<T> p = Vector3<T>::Zero();      ///< translation [m]

  /// Returns the composition of two poses: first `other`, then this one.
  ///
  /// The scalars may differ: a plain and a dual one give a dual one.
  template <class S>
  auto operator*(const Pose<S>& other) const {
    using Result = decltype(T() * S());
    return Pose<Result>{R * other.R, R * other.p + p};
  }
  /// Returns the inverse transformation.
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

}  // namespace maxwrench
