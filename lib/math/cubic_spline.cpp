#include "lib/math/cubic_spline.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace maxwrench {
namespace {

/// The derivative at knot 0 of the polynomial through the knots of `indices`, of which the first is
/// knot 0, by Newton's divided differences: sum_k f[0..k] prod_{0<j<k} (t_0 - t_j).
Eigen::VectorXd end_slope(std::span<const double> times, const Eigen::MatrixXd& values,
                          const std::vector<Eigen::Index>& indices) {
  const std::size_t count = indices.size();
  const auto t = [&](std::size_t k) { return times[static_cast<std::size_t>(indices[k])]; };
  Eigen::MatrixXd divided(values.rows(), static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    divided.col(static_cast<Eigen::Index>(k)) = values.col(indices[k]);
  }
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(values.rows());
  double factor = 1;
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t k = count - 1; k >= order; --k) {
      const auto at = static_cast<Eigen::Index>(k);
      divided.col(at) = (divided.col(at) - divided.col(at - 1)).eval() / (t(k) - t(k - order));
    }
    slope += factor * divided.col(static_cast<Eigen::Index>(order));
    factor *= t(0) - t(order);
  }
  return slope;
}

}  // namespace

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

/// A quadratic with the slopes at the ends is taken off, which leaves a clamped spline.
Eigen::MatrixXd free_spline_bends(std::span<const double> times, const Eigen::MatrixXd& values) {
  const Eigen::Index N = values.cols();
  assert(N >= 2 && static_cast<Eigen::Index>(times.size()) == N);
  std::vector<Eigen::Index> first, last;
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(4, N); ++k) {
    first.push_back(k);
    last.push_back(N - 1 - k);
  }
  const Eigen::VectorXd start = end_slope(times, values, first);
  const Eigen::VectorXd bend =
      (end_slope(times, values, last) - start) / (times.back() - times.front());
  Eigen::MatrixXd rest = values;
  for (Eigen::Index i = 0; i < N; ++i) {
    const double t = times[static_cast<std::size_t>(i)] - times.front();
    rest.col(i) -= t * start + t * t / 2 * bend;
  }
  return clamped_spline_bends(times, rest).colwise() + bend;
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
