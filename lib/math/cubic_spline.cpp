#include "lib/math/cubic_spline.h"

#include <algorithm>
#include <cassert>

namespace maxwrench {

/// At every knot the slopes from both sides agree. With h the length and g the mean slope of an
/// interval, this is h_- y''_-/6 + (h_- + h) y''/3 + h y''_+/6 = g - g_-. At the ends, the terms of
/// the missing interval are left out. The result is a tridiagonal system, which is diagonally
/// dominant.
Eigen::MatrixXd clamped_spline_bends(std::span<const double> times, const Eigen::MatrixXd& values) {
  const Eigen::Index N = values.cols();
  assert(N >= 2 && static_cast<Eigen::Index>(times.size()) == N);
  Eigen::MatrixXd bends = Eigen::MatrixXd::Zero(values.rows(), N);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(N), beside(N - 1);
  for (Eigen::Index i = 0; i + 1 < N; ++i) {
    const double h = times[static_cast<std::size_t>(i + 1)] - times[static_cast<std::size_t>(i)];
    const Eigen::VectorXd g = (values.col(i + 1) - values.col(i)) / h;
    diagonal[i] += h / 3;
    diagonal[i + 1] += h / 3;
    beside[i] = h / 6;
    bends.col(i) += g;
    bends.col(i + 1) -= g;
  }
  for (Eigen::Index i = 1; i < N; ++i) {
    const double factor = beside[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * beside[i - 1];
    bends.col(i) -= factor * bends.col(i - 1);
  }
  bends.col(N - 1) /= diagonal[N - 1];
  for (Eigen::Index i = N - 2; i >= 0; --i) {
    bends.col(i) = (bends.col(i) - beside[i] * bends.col(i + 1)) / diagonal[i];
  }
  return bends;
}

SplineInstant spline_at(std::span<const double> times, double t) {
  assert(times.size() >= 2);
  const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, t);
  SplineInstant at;
  at.interval = static_cast<int>(after - times.begin()) - 1;
  const double end = *after, h = end - *(after - 1);
  const double a = (end - t) / h, b = 1 - a;
  at.weights.col(0) << a, b, (a * a - 1) * a * h * h / 6, (b * b - 1) * b * h * h / 6;
  at.weights.col(1) << -1 / h, 1 / h, (1 - 3 * a * a) * h / 6, (3 * b * b - 1) * h / 6;
  at.weights.col(2) << 0, 0, a, b;
  return at;
}

}  // namespace maxwrench
