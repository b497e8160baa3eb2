#pragma once

#include <Eigen/Core>
#include <span>

namespace maxwrench {

/// The second derivatives, d×N, at the knots of the cubic spline through the columns of `values`,
/// d×N, at N >= 2 times that rise, whose slope is zero at both ends. They are linear in the values:
/// those of the identity are the matrix by which any values are multiplied from the right.
Eigen::MatrixXd clamped_spline_bends(std::span<const double> times, const Eigen::MatrixXd& values);

/// A cubic spline at an instant between knots i and i + 1: of values y and second derivatives y''
/// there, [y_i y_i+1 y''_i y''_i+1] weights = [value, first, second derivative].
struct SplineInstant {
  int interval = 0;  ///< i
  Eigen::Matrix<double, 4, 3> weights;
};

/// A knot belongs to the interval after it, but for the last. Before and after the knots the first
/// and the last interval go on.
SplineInstant spline_at(std::span<const double> times, double t);

}  // namespace maxwrench
