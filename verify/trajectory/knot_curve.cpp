#include "verify/trajectory/knot_curve.h"

namespace maxwrench {
namespace {

/// Parts of a curve are not cut further than this.
constexpr int kMostCurveCuts = 40;

/// The slopes y' of the clamped spline at unit distance of the knots, times that distance: zero at
/// both ends, m_(i-1) + 4 m_i + m_(i+1) = 3 (y_(i+1) - y_(i-1)) in between.
std::vector<Wide> clamped_slopes(const Eigen::VectorXd& y) {
  const auto K = static_cast<std::size_t>(y.size());
  std::vector<Wide> slope(K), pivot(K);
  for (std::size_t i = 1; i + 1 < K; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    slope[i] = Wide(3.0L) * (Wide(y[at + 1]) - Wide(y[at - 1]));
    pivot[i] = Wide(4.0L);
    if (i == 1) continue;
    const Wide factor = Wide(1.0L) / pivot[i - 1];
    pivot[i] -= factor;
    slope[i] -= factor * slope[i - 1];
  }
  for (std::size_t i = K - 2; i >= 1; --i) slope[i] = (slope[i] - slope[i + 1]) / pivot[i];
  return slope;
}

/// A polynomial by its control points: it lies between the least and the largest one.
using ControlPoints = std::vector<Narrow>;

/// The control points of both halves, by de Casteljau's scheme.
std::array<ControlPoints, 2> halves_of(ControlPoints points) {
  ControlPoints low, high;
  while (!points.empty()) {
    low.push_back(points.front());
    high.insert(high.begin(), points.back());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      points[i] = 0.5 * (points[i] + points[i + 1]);
    }
    points.pop_back();
  }
  return {low, high};
}

struct CurveLimits {
  double lower, upper, tolerance;
  bool holds(const ControlPoints& points) const {
    return std::all_of(points.begin(), points.end(), [this](const Narrow& b) {
      return b.low >= lower - tolerance && b.high <= upper + tolerance;
    });
  }
};

/// The first part of a curve that is not within its limits: where it leaves them for certain, or
/// where no further cut decides.
bool leaves_limits(const ControlPoints& points, const CurveLimits& limits, double x_0, double x_1,
                   int cuts, KnotCurve::Outside& where) {
  if (limits.holds(points)) return false;
  for (const bool last : {false, true}) {
    const Narrow& end = last ? points.back() : points.front();
    const bool outside =
        end.high < limits.lower - limits.tolerance || end.low > limits.upper + limits.tolerance;
    if (!outside && cuts > 0) continue;
    where.found = true;
    where.x = last ? x_1 : x_0;
    where.value = (end.low + end.high) / 2;
    return true;
  }
  const auto [low, high] = halves_of(points);
  const double middle = (x_0 + x_1) / 2;
  return leaves_limits(low, limits, x_0, middle, cuts - 1, where) ||
         leaves_limits(high, limits, middle, x_1, cuts - 1, where);
}

}  // namespace

KnotCurve::KnotCurve(const Eigen::MatrixXd& table, double duration)
    : intervals_(static_cast<int>(table.rows()) - 1), coordinates_(static_cast<int>(table.cols())) {
  rate_ = narrow(Wide(static_cast<long double>(intervals_)) / Wide(duration));
  for (Eigen::Index j = 0; j < table.cols(); ++j) {
    const std::vector<Wide> m = clamped_slopes(table.col(j));
    for (Eigen::Index i = 0; i < intervals_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Wide step = Wide(table(i + 1, j)) - Wide(table(i, j));
      cubics_.push_back({Narrow(table(i, j)), narrow(m[at]),
                         narrow(Wide(3.0L) * step - Wide(2.0L) * m[at] - m[at + 1]),
                         narrow(m[at] + m[at + 1] - Wide(2.0L) * step)});
    }
  }
}

template <int N>
Jet<N> KnotCurve::at(int coordinate, int interval, const Narrow& x) const {
  static_assert(N >= 3);
  const Cubic& a = cubic(coordinate, interval);
  if (a[1].is_zero() && a[2].is_zero() && a[3].is_zero()) return Jet<N>(a[0]);
  Jet<N> y;
  y.c[0] = a[0] + x * (a[1] + x * (a[2] + x * a[3]));
  y.c[1] = rate_ * (a[1] + x * (2.0 * a[2] + x * (3.0 * a[3])));
  y.c[2] = rate_ * (rate_ * (a[2] + x * (3.0 * a[3])));
  y.c[3] = rate_ * (rate_ * (rate_ * a[3]));
  return y;
}

template Jet<3> KnotCurve::at(int, int, const Narrow&) const;
template Jet<4> KnotCurve::at(int, int, const Narrow&) const;

double KnotCurve::fastest(int coordinate, int interval, double x_0, double x_1) const {
  const Jet<3> y = at<3>(coordinate, interval, Narrow(x_0, x_1));
  return y.c[1].magnitude();
}

KnotCurve::Outside KnotCurve::leaves(int coordinate, bool rate, double lower, double upper,
                                     double tolerance) const {
  const Narrow third(Narrow::below(1.0 / 3), Narrow::above(1.0 / 3));
  for (int i = 0; i < intervals_; ++i) {
    const Cubic& a = cubic(coordinate, i);
    ControlPoints points;
    if (rate) {
      points = {rate_ * a[1], rate_ * (a[1] + a[2]), rate_ * (a[1] + 2.0 * a[2] + 3.0 * a[3])};
    } else {
      points = {a[0], a[0] + third * a[1], a[0] + third * (2.0 * a[1] + a[2]),
                a[0] + a[1] + a[2] + a[3]};
    }
    Outside where;
    where.interval = i;
    if (leaves_limits(points, {lower, upper, tolerance}, 0, 1, kMostCurveCuts, where)) return where;
  }
  return {};
}

}  // namespace maxwrench
