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

/// One side of all forms: slacks s of the limits, multipliers y >= 0, and their steps. What has no
/// limit has y = 0 and s = 1.
struct Slacks {
  Eigen::VectorXd s, y, ds, dy, residual, theta, v, centre;
  Eigen::VectorXd drift;                 ///< what d tau does to s: b less A q
  Eigen::VectorXd inverse_s, inverse_y;  ///< the latter zero where there is no limit

  void resize(int size) {
    for (Eigen::VectorXd* x :
         {&s, &y, &ds, &dy, &residual, &theta, &v, &centre, &drift, &inverse_s, &inverse_y})
      x->resize(size);
  }

  void start(const Eigen::VectorXd& has, const Eigen::VectorXd& scale, double mu) {
    s = (has.array() > 0).select(scale, 1.0);
    y = mu * has.array() / s.array();
  }

  void invert(const Eigen::VectorXd& has, Eigen::Index a, Eigen::Index n) {
    constexpr double kLeast = std::numeric_limits<double>::min();
    inverse_s.segment(a, n) = s.segment(a, n).cwiseInverse();
    inverse_y.segment(a, n) =
        y.segment(a, n).cwiseMax(kLeast).cwiseInverse().cwiseProduct(has.segment(a, n));
    theta.segment(a, n) = y.segment(a, n).cwiseProduct(inverse_s.segment(a, n));
  }

  /// v = centre/s - share theta residual.
  void push(double share, Eigen::Index a, Eigen::Index n) {
    v.segment(a, n) = centre.segment(a, n).cwiseProduct(inverse_s.segment(a, n)) -
                      share * theta.segment(a, n).cwiseProduct(residual.segment(a, n));
  }

  /// drift'(v - theta ds)
  double pull(Eigen::Index a, Eigen::Index n) const {
    return drift.segment(a, n).dot(v.segment(a, n) -
                                   theta.segment(a, n).cwiseProduct(ds.segment(a, n)));
  }

  /// ds and dy from what X alone does to s. What has no limit keeps s.
  void finish(double share, double d_tau, const Eigen::VectorXd& has, Eigen::Index a,
              Eigen::Index n) {
    auto step = ds.segment(a, n);
    step += share * residual.segment(a, n) + d_tau * drift.segment(a, n);
    dy.segment(a, n) = (centre.segment(a, n) - y.segment(a, n).cwiseProduct(step))
                           .cwiseProduct(inverse_s.segment(a, n));
    step = step.cwiseProduct(has.segment(a, n));
  }

  /// The longest step up to `most` that keeps s and y positive where there is a limit.
  double reach(double most) const {
    double falls = 1 / most;
    for_chunks(s.size(), [&](Eigen::Index a, Eigen::Index n) {
      const double s_falls = -ds.segment(a, n).cwiseProduct(inverse_s.segment(a, n)).minCoeff();
      const double y_falls = -dy.segment(a, n).cwiseProduct(inverse_y.segment(a, n)).minCoeff();
      falls = std::max(falls, std::max(s_falls, y_falls));
    });
    return 1 / falls;
  }
};

}  // namespace maxwrench
