#pragma once

#include "solvers/trajectory/simd_pack.h"

namespace maxwrench {

/// One side of all forms, sign (limit tau - phi) = s >= 0: slacks s, multipliers y >= 0, and their
/// steps. What has no limit has y = 0, and s and its step mean nothing. Methods work on the L forms
/// from i on.
struct Side {
  explicit Side(double which) : sign(which) {}

  double sign;
  const Eigen::VectorXd* limit = nullptr;
  Eigen::VectorXd s, y, ds, dy;
  Eigen::VectorXd inverse;     ///< 1/(s y)
  Eigen::VectorXd centre;      ///< what s y should change by
  Eigen::VectorXd correction;  ///< of it, the last one

  void start(const Eigen::VectorXd& limits, const Eigen::VectorXd& has,
             const Eigen::VectorXd& scale, double mu) {
    limit = &limits;
    for (Eigen::VectorXd* x : {&s, &y, &ds, &dy, &inverse, &centre, &correction}) {
      x->resize(limits.size());
    }
    s = (has.array() > 0).select(scale, 1.0);
    y = mu * has.array() / s.array();
  }

  /// The same for single forms.
  double theta(Eigen::Index f) const { return y[f] * y[f] * inverse[f]; }
  double residual(double phi, double tau, Eigen::Index f) const {
    return sign * (tau * (*limit)[f] - phi) - s[f];
  }
  double push(double share, double phi, double tau, Eigen::Index f) const {
    return centre[f] * inverse[f] * y[f] - share * theta(f) * residual(phi, tau, f);
  }

  template <int L>
  void advance(double step, Eigen::Index i) {
    lanes<L>(&s[i]) += step * lanes<L>(&ds[i]);
    lanes<L>(&y[i]) += step * lanes<L>(&dy[i]);
  }

  /// Inverse and the predictor's centre; returns s y.
  template <int L>
  Lanes<L> measure(Eigen::Index i) {
    constexpr double kLeast = 1e-150;  // where there is no limit: all that uses it is times y = 0
    const Lanes<L> product = lanes<L>(&s[i]) * lanes<L>(&y[i]);
    lanes<L>(&inverse[i]) = product.max(kLeast).inverse();
    lanes<L>(&centre[i]) = -product;
    return product;
  }

  template <int L>
  Lanes<L> theta_of(Eigen::Index i) const {
    return lanes<L>(&y[i]) * lanes<L>(&y[i]) * lanes<L>(&inverse[i]);
  }
  template <int L>
  Lanes<L> residual_of(const Lanes<L>& phi, double tau, Eigen::Index i) const {
    return sign * (tau * lanes<L>(&(*limit)[i]) - phi) - lanes<L>(&s[i]);
  }
  /// What the forms are pushed with: centre/s - share theta residual.
  template <int L>
  Lanes<L> push_of(double share, const Lanes<L>& phi, double tau, Eigen::Index i) const {
    const Lanes<L> inverse_s = lanes<L>(&inverse[i]) * lanes<L>(&y[i]);
    return inverse_s *
           (lanes<L>(&centre[i]) - share * lanes<L>(&y[i]) * residual_of<L>(phi, tau, i));
  }
  /// What d tau does to s, given that it changes phi by q.
  template <int L>
  Lanes<L> drift_of(const Lanes<L>& q, Eigen::Index i) const {
    return sign * (lanes<L>(&(*limit)[i]) - q);
  }

  /// The change of s for changes of phi by d and, with tau, by d_tau q.
  template <int L, class Phi, class Q, class D>
  Lanes<L> change(double share, double d_tau, double tau, const Phi& phi, const Q& q, const D& d,
                  Eigen::Index i) const {
    const auto limit_i = lanes<L>(&(*limit)[i]);
    return share * (sign * (tau * limit_i - phi) - lanes<L>(&s[i])) +
           sign * (d_tau * (limit_i - q) - d);
  }

  /// The corrector's centre by the predictor's change of s, with which y changes by -y - y ds/s.
  /// Returns the most that an s or a y loses of itself.
  template <int L>
  Lanes<L> predict(const Lanes<L>& step, Eigen::Index i) {
    const Lanes<L> product = lanes<L>(&s[i]) * lanes<L>(&y[i]);
    const Lanes<L> share = step * lanes<L>(&inverse[i]) * lanes<L>(&y[i]);
    lanes<L>(&centre[i]) = product * (share + share.square() - 1);
    return (-share).max(1 + share);
  }

  /// ds and dy; returns the most that an s or a y loses of itself.
  template <int L>
  Lanes<L> finish(const Lanes<L>& step, Eigen::Index i) {
    const Lanes<L> inverse_s = lanes<L>(&inverse[i]) * lanes<L>(&y[i]);
    const Lanes<L> change = (lanes<L>(&centre[i]) - lanes<L>(&y[i]) * step) * inverse_s;
    lanes<L>(&ds[i]) = step;
    lanes<L>(&dy[i]) = change;
    return falls<L>(i);
  }
  /// The same after phi's step changes by d.
  template <int L, class D>
  Lanes<L> add(const D& d, Eigen::Index i) {
    lanes<L>(&ds[i]) -= sign * d;
    lanes<L>(&dy[i]) += sign * theta_of<L>(i) * d;
    return falls<L>(i);
  }
  template <int L>
  Lanes<L> falls(Eigen::Index i) const {
    const Lanes<L> in = lanes<L>(&inverse[i]);
    return -(lanes<L>(&ds[i]) * lanes<L>(&y[i]) * in).min(lanes<L>(&dy[i]) * lanes<L>(&s[i]) * in);
  }

  /// Centres that bring what the products s y would be after a step `trial` within kLow mu and
  /// kHigh mu.
  template <int L>
  void pull(double trial, double mu, Eigen::Index i) {
    constexpr double kLow = 0.1, kHigh = 10;
    const Lanes<L> then =
        (lanes<L>(&s[i]) + trial * lanes<L>(&ds[i])) * (lanes<L>(&y[i]) + trial * lanes<L>(&dy[i]));
    const Lanes<L> by = (then.max(kLow * mu).min(kHigh * mu) - then).max(-kHigh * mu);
    lanes<L>(&correction[i]) = by;
    lanes<L>(&centre[i]) += by;
  }
};

}  // namespace maxwrench
