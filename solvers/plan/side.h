#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

namespace maxwrench {

/// So many forms at a time are worked on: their numbers stay in the first cache.
inline constexpr Eigen::Index kChunk = 256;

/// Calls body(first, count) for the chunks of `size` forms.
template <class Body>
void for_chunks(Eigen::Index size, Body&& body) {
  for (Eigen::Index first = 0; first < size; first += kChunk) {
    body(first, std::min(kChunk, size - first));
  }
}

/// One side of all forms, sign (limit tau - phi) = s >= 0: slacks s, multipliers y >= 0, and their
/// steps. What has no limit has y = 0 and s = 1. Methods work on the n forms from a on.
struct Side {
  explicit Side(double which) : sign(which) {}

  double sign;
  const Eigen::VectorXd *limit = nullptr, *has = nullptr;
  Eigen::VectorXd s, y, ds, dy, residual, theta, inverse_s, inverse_y;
  Eigen::VectorXd centre;      ///< what s y should change by
  Eigen::VectorXd correction;  ///< of it, the last one

  void start(const Eigen::VectorXd& limits, const Eigen::VectorXd& which,
             const Eigen::VectorXd& scale, double mu) {
    limit = &limits;
    has = &which;
    for (Eigen::VectorXd* x : {&s, &y, &ds, &dy, &residual, &theta, &inverse_s, &inverse_y}) {
      x->resize(limits.size());
    }
    centre.resize(limits.size());
    correction.resize(limits.size());
    s = (has->array() > 0).select(scale, 1.0);
    y = mu * has->array() / s.array();
  }

  /// Residuals at phi and the predictor's centre.
  void measure(const Eigen::VectorXd& phi, double tau, Eigen::Index a, Eigen::Index n) {
    constexpr double kLeast = std::numeric_limits<double>::min();
    const auto h = has->segment(a, n);
    const auto s_a = s.segment(a, n), y_a = y.segment(a, n);
    residual.segment(a, n) =
        (sign * (tau * limit->segment(a, n) - phi.segment(a, n)) - s_a).cwiseProduct(h);
    inverse_s.segment(a, n) = s_a.cwiseInverse();
    inverse_y.segment(a, n) = y_a.cwiseMax(kLeast).cwiseInverse().cwiseProduct(h);
    theta.segment(a, n) = y_a.cwiseProduct(inverse_s.segment(a, n));
    centre.segment(a, n) = -s_a.cwiseProduct(y_a);
  }

  /// What the forms are pushed with: centre/s - share theta residual.
  auto push(double share, Eigen::Index a, Eigen::Index n) const {
    return centre.segment(a, n).cwiseProduct(inverse_s.segment(a, n)) -
           share * theta.segment(a, n).cwiseProduct(residual.segment(a, n));
  }

  /// What d tau does to s, given that it changes phi by q.
  template <class Q>
  auto drift(const Q& q, Eigen::Index a, Eigen::Index n) const {
    return sign * (limit->segment(a, n) - q.segment(a, n));
  }

  /// ds and dy for changes of phi by d and, with tau, by d_tau q; the corrector's centre and
  /// reach follow from them.
  template <class Q, class D>
  void finish(double share, double d_tau, const Q& q, const D& d, Eigen::Index a, Eigen::Index n) {
    auto step = ds.segment(a, n);
    step = share * residual.segment(a, n) - sign * d.segment(a, n) + d_tau * drift(q, a, n);
    dy.segment(a, n) = (centre.segment(a, n) - y.segment(a, n).cwiseProduct(step))
                           .cwiseProduct(inverse_s.segment(a, n));
    step = step.cwiseProduct(has->segment(a, n));
  }

  /// Centres that bring what the products s y would be after a step `trial` within kLow mu and
  /// kHigh mu.
  void pull(double trial, double mu, Eigen::Index a, Eigen::Index n) {
    constexpr double kLow = 0.1, kHigh = 10;
    const auto s_then = s.segment(a, n) + trial * ds.segment(a, n);
    const auto y_then = y.segment(a, n) + trial * dy.segment(a, n);
    auto by = correction.segment(a, n);
    by = s_then.cwiseProduct(y_then);
    by = (by.cwiseMax(kLow * mu).cwiseMin(kHigh * mu) - by).cwiseMax(-kHigh * mu);
    by = by.cwiseProduct(has->segment(a, n));
    centre.segment(a, n) += by;
  }

  /// The most that an s or a y loses of itself.
  double falls(Eigen::Index a, Eigen::Index n) const {
    return -std::min(ds.segment(a, n).cwiseProduct(inverse_s.segment(a, n)).minCoeff(),
                     dy.segment(a, n).cwiseProduct(inverse_y.segment(a, n)).minCoeff());
  }

  void advance(double step, Eigen::Index a, Eigen::Index n) {
    s.segment(a, n) += step * ds.segment(a, n);
    y.segment(a, n) += step * dy.segment(a, n);
  }
};

}  // namespace maxwrench
