#pragma once

#include "lib/math/simd_pack.h"

namespace maxwrench {

/// One side of all forms, sign (limit tau - phi) = s >= 0: slacks s, multipliers y >= 0, and their
/// steps. A form without a limit has y = 0, and its s and its step are not used. Methods with a
/// parameter L work on the L forms from i on.
struct Side {
  explicit Side(double which) : sign(which) {}

  double sign;
  const Eigen::VectorXd* limit = nullptr;
  Eigen::VectorXd s, y, ds, dy;
  Eigen::VectorXd inverse;     ///< 1/(s y)
  Eigen::VectorXd centre;      ///< the required change of s y
  Eigen::VectorXd correction;  ///< the last correction of the centre

  void start(const Eigen::VectorXd& limits, const Eigen::VectorXd& has,
             const Eigen::VectorXd& scale, double mu) {
    limit = &limits;
    for (Eigen::VectorXd* x : {&s, &y, &ds, &dy, &inverse, &centre, &correction}) {
      x->resize(limits.size());
    }
    s = (has.array() > 0).select(scale, 1.0);
    y = mu * has.array() / s.array();
  }

  /// The same quantities for one form.
  double theta(Eigen::Index f) const { return y[f] * y[f] * inverse[f]; }
  double residual(double phi, double tau, Eigen::Index f) const {
    return sign * (tau * (*limit)[f] - phi) - s[f];
  }
  double newton_rhs(double reduction, double phi, double tau, Eigen::Index f) const {
    return centre[f] * inverse[f] * y[f] - reduction * theta(f) * residual(phi, tau, f);
  }

  template <int L>
  void advance(double step, Eigen::Index i) {
    pack<L>(&s[i]) += step * pack<L>(&ds[i]);
    pack<L>(&y[i]) += step * pack<L>(&dy[i]);
  }

  /// Computes the inverse and the predictor's centre; returns s y.
  template <int L>
  SimdPack<L> measure(Eigen::Index i) {
    constexpr double kLeast = 1e-150;  // where there is no limit; its uses are multiplied by y = 0
    const SimdPack<L> product = pack<L>(&s[i]) * pack<L>(&y[i]);
    pack<L>(&inverse[i]) = product.max(kLeast).inverse();
    pack<L>(&centre[i]) = -product;
    return product;
  }

  template <int L>
  SimdPack<L> theta_of(Eigen::Index i) const {
    return pack<L>(&y[i]) * pack<L>(&y[i]) * pack<L>(&inverse[i]);
  }
  template <int L>
  SimdPack<L> residual_of(const SimdPack<L>& phi, double tau, Eigen::Index i) const {
    return sign * (tau * pack<L>(&(*limit)[i]) - phi) - pack<L>(&s[i]);
  }
  /// The right-hand side of the forms: centre/s - reduction theta residual.
  template <int L>
  SimdPack<L> newton_rhs_of(double reduction, const SimdPack<L>& phi, double tau,
                            Eigen::Index i) const {
    const SimdPack<L> inverse_s = pack<L>(&inverse[i]) * pack<L>(&y[i]);
    return inverse_s *
           (pack<L>(&centre[i]) - reduction * pack<L>(&y[i]) * residual_of<L>(phi, tau, i));
  }
  /// The derivative of s by tau, given that phi changes by q per unit of tau.
  template <int L>
  SimdPack<L> tau_slope_of(const SimdPack<L>& q, Eigen::Index i) const {
    return sign * (pack<L>(&(*limit)[i]) - q);
  }

  /// The change of s for changes of phi by d and, with tau, by d_tau q.
  template <int L, class Phi, class Q, class D>
  SimdPack<L> change(double reduction, double d_tau, double tau, const Phi& phi, const Q& q,
                     const D& d, Eigen::Index i) const {
    const auto limit_i = pack<L>(&(*limit)[i]);
    return reduction * (sign * (tau * limit_i - phi) - pack<L>(&s[i])) +
           sign * (d_tau * (limit_i - q) - d);
  }

  /// Sets the corrector's centre from the predictor's change of s, with which y changes by -y - y
  /// ds/s. Returns the largest share of itself that an s or a y loses.
  template <int L>
  SimdPack<L> predict(const SimdPack<L>& step, Eigen::Index i) {
    const SimdPack<L> product = pack<L>(&s[i]) * pack<L>(&y[i]);
    const SimdPack<L> reduction = step * pack<L>(&inverse[i]) * pack<L>(&y[i]);
    pack<L>(&centre[i]) = product * (reduction + reduction.square() - 1);
    return (-reduction).max(1 + reduction);
  }

  /// Sets ds and dy; returns the largest share of itself that an s or a y loses.
  template <int L>
  SimdPack<L> finish(const SimdPack<L>& step, Eigen::Index i) {
    const SimdPack<L> inverse_s = pack<L>(&inverse[i]) * pack<L>(&y[i]);
    const SimdPack<L> change = (pack<L>(&centre[i]) - pack<L>(&y[i]) * step) * inverse_s;
    pack<L>(&ds[i]) = step;
    pack<L>(&dy[i]) = change;
    return falls<L>(i);
  }
  /// The same after phi's step changes by d.
  template <int L, class D>
  SimdPack<L> add(const D& d, Eigen::Index i) {
    pack<L>(&ds[i]) -= sign * d;
    pack<L>(&dy[i]) += sign * theta_of<L>(i) * d;
    return falls<L>(i);
  }
  template <int L>
  SimdPack<L> falls(Eigen::Index i) const {
    const SimdPack<L> in = pack<L>(&inverse[i]);
    return -(pack<L>(&ds[i]) * pack<L>(&y[i]) * in).min(pack<L>(&dy[i]) * pack<L>(&s[i]) * in);
  }

  /// Corrects the centres so that the products s y after a step `trial` are between kLow mu and
  /// kHigh mu.
  template <int L>
  void center_products(double trial, double mu, Eigen::Index i) {
    constexpr double kLow = 0.1, kHigh = 10;
    const SimdPack<L> then =
        (pack<L>(&s[i]) + trial * pack<L>(&ds[i])) * (pack<L>(&y[i]) + trial * pack<L>(&dy[i]));
    const SimdPack<L> by = (then.max(kLow * mu).min(kHigh * mu) - then).max(-kHigh * mu);
    pack<L>(&correction[i]) = by;
    pack<L>(&centre[i]) += by;
  }
};

}  // namespace maxwrench
