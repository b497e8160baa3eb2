#pragma once

#include <Eigen/Core>
#include <span>

namespace maxwrench {

/// The second derivatives (d×N) at the knots of a cubic spline through the columns of `values`
/// (d×N). `times` holds N >= 2 increasing times. The slope is zero at both ends. The second
/// derivatives are linear in the values: for the identity as `values`, the result is the matrix
/// that multiplies any values from the right.
Eigen::MatrixXd clamped_spline_bends(std::span<const double> times, const Eigen::MatrixXd& values);

/// The same for a spline whose slopes at the ends are those of the cubics through the first and the
/// last four knots, or of lower polynomials through fewer knots. It reproduces a cubic.
Eigen::MatrixXd free_spline_bends(std::span<const double> times, const Eigen::MatrixXd& values);

/// A cubic spline at an instant between knots i and i + 1. With values y and second derivatives y''
/// at the knots, [y_i y_i+1 y''_i y''_i+1] weights = [value, first, second derivative].
struct SplineInstant {
  int interval = 0;  ///< i
  Eigen::Matrix<double, 4, 3> weights;
};

/// At a knot, the interval after it applies; at the last knot, the interval before it. Before the
/// first and after the last knot, the first and the last interval are extended.
SplineInstant spline_at(std::span<const double> times, double t);

}  // namespace maxwrench
