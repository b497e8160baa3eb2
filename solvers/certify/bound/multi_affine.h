#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lib/math/extended.h"
#include "maxwrench/types.h"

namespace maxwrench {

using ExtendedVector = VectorX<Extended>;

/// More control points than this take too much time and memory for a box.
inline constexpr Eigen::Index kMostControlPoints = 40'000;

/// How coordinates of theta_r enter a `MultiAffine`.
struct Coordinates {
  std::vector<int> index;   ///< in theta_r
  std::vector<char> turns;  ///< enters by cosine and sine; otherwise as itself
  int count() const { return static_cast<int>(index.size()); }
  int terms(int axis) const { return turns[static_cast<std::size_t>(axis)] != 0 ? 3 : 2; }
  /// The product of the terms of all axes from this one on.
  Eigen::Index points(int from = 0) const;
};

/// Throws std::invalid_argument, with one line that names the task, if a `MultiAffine` of all these
/// coordinates has more coefficients than `kMostControlPoints`.
void require_few_control_points(const std::string& task, const Coordinates& coordinates);

/// Rows that are affine in (cos q_i, sin q_i) of each turning coordinate, and in q_i of each
/// sliding one, while the other coordinates are fixed:
///
///     f(q) = sum over a of F_a prod_i e(q_i)_{a_i},   e = (1, cos q, sin q) or (1, q).
///
/// There are N coefficients F_a, N the product of 3 for each turning coordinate and 2 for each
/// sliding one.
class MultiAffine {
 public:
  /// Returns the rows at theta_r, all coordinates included.
  using Sample = std::function<ExtendedVector(const ExtendedVector& theta_r)>;

  /// Computes the coefficients from N samples, at which cosines and sines are 0, 1 or -1. `theta_r`
  /// holds the values of the fixed coordinates.
  MultiAffine(Coordinates coordinates, const Eigen::VectorXd& theta_r, const Sample& sample);

  const Coordinates& coordinates() const { return coordinates_; }
  int rows() const { return static_cast<int>(F_.rows()); }
  int size() const { return static_cast<int>(F_.cols()); }  ///< N
  /// rows×N; the first coordinate changes slowest. Rounded to double.
  const Eigen::MatrixXd& coefficients() const { return F_; }
  /// For each row, the sum over a of |F_a| prod_i max |e(q_i)_{a_i}|, with sliding coordinates
  /// within these limits. No sum of the row's terms is larger.
  Eigen::VectorXd magnitudes(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) const;
  Eigen::VectorXd evaluate(const Eigen::VectorXd& theta_r) const;

 private:
  Coordinates coordinates_;
  Eigen::MatrixXd F_;
};

/// The factor by which control points may exceed values: prod_i 1/cos r_i over the turning
/// coordinates, with r_i half their widths; infinity if an r_i is pi/2 or more.
double spread(const Coordinates& coordinates, const Eigen::VectorXd& lower,
              const Eigen::VectorXd& upper);

/// The control points of a `MultiAffine` over boxes. On [m - r, m + r], r < pi/2, the arc (cos,
/// sin) lies in the triangle of its two ends and (cos m, sin m)/cos r, where the tangents at the
/// ends meet. So all rows over a box lie in the convex hull of f at the N corners of the product of
/// these triangles (and of the intervals of sliding coordinates). At corners of the box this is
/// exact; elsewhere its error falls with r^2.
///
/// Reuses its storage, and the intermediate results of the first coordinates that a box shares with
/// the box before.
class ControlPoints {
 public:
  /// Keeps a reference to f.
  explicit ControlPoints(const MultiAffine& f);
  explicit ControlPoints(const MultiAffine&&) = delete;

  /// rows×N, for a box whose `spread` is finite.
  const Eigen::MatrixXd& over(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

 private:
  void advance(int axis, double lower, double upper);

  const MultiAffine& f_;
  std::vector<Eigen::MatrixXd> levels_;  ///< element i: control points along i axes
  Eigen::VectorXd lower_, upper_;        ///< of the last box
};

}  // namespace maxwrench
