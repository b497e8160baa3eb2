#include <algorithm>

#include "solvers/trajectory/embedding.h"

// The operations of the embedding on all forms, one pass each.

namespace maxwrench {
namespace {

/// The weight of an equation in the normal equations. The remaining violation vanishes with the
/// steps.
constexpr double kEquation = 1e8;

}  // namespace

/// Takes the step; computes residuals of the embedding and right-hand sides at its end.
void Embedding::measure(double step) {
  if (step > 0) advance(step);
  PackSum<> dual, products;
  const Eigen::VectorXd& phi_l = phi_low();
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    const auto hi = pack<L>(&forms_.hi[i]), lo = pack<L>(&forms_.lo[i]);
    const auto y_h = pack<L>(&high_.y[i]), y_l = pack<L>(&low_.y[i]);
    products.add(high_.measure<L>(i) + low_.measure<L>(i));
    dual.add(hi * y_h - lo * y_l);
    const SimdPack<L> theta_h = high_.theta_of<L>(i), theta_l = low_.theta_of<L>(i);
    pack<L>(&weight_[i]) = theta_h + theta_l;
    pack<L>(&G_(i, kTau)) = theta_h * hi + theta_l * lo;
    pack<L>(&G_(i, kDual)) = y_l - y_h;
    pack<L>(&G_(i, kStep)) = low_.newton_rhs_of<L>(1, pack<L>(&phi_l[i]), tau_, i) -
                             high_.newton_rhs_of<L>(1, pack<L>(&phi_[i]), tau_, i);
  });
  dual_value_ = dual.value();
  measure_equations();
  measure_slacks();
  primal_value_ = forms_.cost.dot(X_) - rho_ * sigma_.sum();
  gap_residual_ = kappa_ + dual_value_ - primal_value_;
  mu_ = (products.value() + tau_ * kappa_) / (count_ + 1);
}

void Embedding::advance(double step) {
  X_ += step * (D_X_.col(kStep) + d_tau_ * D_X_.col(kTau));
  sigma_ += step * (D_sigma_.col(kStep) + d_tau_ * D_sigma_.col(kTau));
  equation_y_ += step * equation_dy_;
  tau_ += step * d_tau_;
  kappa_ += step * d_kappa_;
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    high_.advance<L>(step, i);
    low_.advance<L>(step, i);
    pack<L>(&phi_[i]) += step * (pack<L>(&G_(i, kStep)) + d_tau_ * pack<L>(&G_(i, kTau)));
    if (!split()) return;
    pack<L>(&phi_low_[i]) +=
        step * (pack<L>(&G_low_(i, kStep)) + d_tau_ * pack<L>(&G_low_(i, kTau)));
  });
}

/// An equation has a weight and a multiplier of any sign.
void Embedding::measure_equations() {
  for (std::size_t e = 0; e < forms_.equations.size(); ++e) {
    const int f = forms_.equations[e];
    const double y = equation_y_[static_cast<Eigen::Index>(e)];
    dual_value_ += forms_.hi[f] * y;
    weight_[f] = kEquation;
    G_(f, kTau) = kEquation * forms_.hi[f];
    G_(f, kDual) = -y;
    G_(f, kStep) = kEquation * (forms_.hi[f] * tau_ - phi_[f]);
  }
}

/// Eliminates the columns of sigma; computes the remaining weight of a slack.
void Embedding::measure_slacks() {
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    const double h = high_.theta(f), l = low_.theta(f);
    s_diagonal_[i] = h + l;
    s_phi_[i] = l - h;
    weight_[f] = 4 * h * l / (h + l);
    D_sigma_(i, kTau) = -rho_;
  }
}

/// Returns the part of the predictor's right-hand sides in the equation of tau. Also sets the pivot
/// of tau, from the changes of the limits along its direction: a sum of squares, without
/// cancellation.
double Embedding::affine_rhs() {
  PackSum<> squares, rhs;
  const Eigen::VectorXd& phi_l = phi_low();
  const Eigen::MatrixXd& G_l = G_low();
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    const SimdPack<L> h = high_.tau_slope_of<L>(pack<L>(&G_(i, kTau)), i);
    const SimdPack<L> l = low_.tau_slope_of<L>(pack<L>(&G_l(i, kTau)), i);
    squares.add(high_.theta_of<L>(i) * h.square() + low_.theta_of<L>(i) * l.square());
    rhs.add(h * high_.newton_rhs_of<L>(1, pack<L>(&phi_[i]), tau_, i) +
            l * low_.newton_rhs_of<L>(1, pack<L>(&phi_l[i]), tau_, i));
  });
  tau_pivot_ = kappa_ / tau_ + squares.value();
  double sum = rhs.value();
  for (const int f : forms_.equations) {
    const double tau_slope = forms_.hi[f] - G_(f, kTau);
    tau_pivot_ += kEquation * tau_slope * tau_slope;
    sum -= tau_slope * kEquation * (forms_.hi[f] * tau_ - phi_[f]);
  }
  return sum;
}

/// The predictor's steps, which set the corrector's centres.
void Embedding::predict_affine() {
  PackMax most;
  const Eigen::VectorXd& phi_l = phi_low();
  const Eigen::MatrixXd& G_l = G_low();
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    const auto tau_h = pack<L>(&G_(i, kTau)), step_h = pack<L>(&G_(i, kStep));
    const auto tau_l = pack<L>(&G_l(i, kTau)), step_l = pack<L>(&G_l(i, kStep));
    const SimdPack<L> h = high_.change<L>(1, d_tau_, tau_, pack<L>(&phi_[i]), tau_h, step_h, i);
    const SimdPack<L> l = low_.change<L>(1, d_tau_, tau_, pack<L>(&phi_l[i]), tau_l, step_l, i);
    most.add(high_.predict<L>(h, i).max(low_.predict<L>(l, i)));
  });
  falls_ = most.value();
}

/// Raises the centres, computes the right-hand sides of the forms, and returns their part in the
/// equation of tau.
double Embedding::newton_rhs(double reduction, double raise) {
  PackSum<> rhs;
  const Eigen::VectorXd& phi_l = phi_low();
  const Eigen::MatrixXd& G_l = G_low();
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    pack<L>(&high_.centre[i]) += raise;
    pack<L>(&low_.centre[i]) += raise;
    const SimdPack<L> h = high_.newton_rhs_of<L>(reduction, pack<L>(&phi_[i]), tau_, i);
    const SimdPack<L> l = low_.newton_rhs_of<L>(reduction, pack<L>(&phi_l[i]), tau_, i);
    rhs.add(high_.tau_slope_of<L>(pack<L>(&G_(i, kTau)), i) * h +
            low_.tau_slope_of<L>(pack<L>(&G_l(i, kTau)), i) * l);
    pack<L>(&G_(i, kStep)) = l - h;
  });
  double sum = rhs.value();
  for (const int f : forms_.equations) {
    G_(f, kStep) = reduction * kEquation * (forms_.hi[f] * tau_ - phi_[f]);
    sum -= (forms_.hi[f] - G_(f, kTau)) * G_(f, kStep);
  }
  for (std::size_t i = 0; i < forms_.slacks.size(); ++i) {
    const int f = forms_.slacks[i];
    D_sigma_(i, kStep) = reduction * (high_.y[f] + low_.y[f] - rho_ * tau_) +
                         high_.newton_rhs(reduction, phi_[f], tau_, f) +
                         low_.newton_rhs(reduction, phi_low_[f], tau_, f);
  }
  return sum;
}

/// The change of the limits by the step along the direction of tau.
double Embedding::sum_moves() const {
  PackSum<> moves;
  const Eigen::MatrixXd& G_l = G_low();
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    const SimdPack<L> h = high_.tau_slope_of<L>(pack<L>(&G_(i, kTau)), i) * high_.theta_of<L>(i);
    const SimdPack<L> l = low_.tau_slope_of<L>(pack<L>(&G_l(i, kTau)), i) * low_.theta_of<L>(i);
    moves.add(h * pack<L>(&G_(i, kStep)) - l * pack<L>(&G_l(i, kStep)));
  });
  double sum = moves.value();
  for (const int f : forms_.equations) {
    sum += (forms_.hi[f] - G_(f, kTau)) * kEquation * G_(f, kStep);
  }
  return sum;
}

/// The steps of all slacks and multipliers.
void Embedding::finish(double reduction) {
  PackMax most;
  const Eigen::VectorXd& phi_l = phi_low();
  const Eigen::MatrixXd& G_l = G_low();
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    const auto tau_h = pack<L>(&G_(i, kTau)), step_h = pack<L>(&G_(i, kStep));
    const auto tau_l = pack<L>(&G_l(i, kTau)), step_l = pack<L>(&G_l(i, kStep));
    const SimdPack<L> h =
        high_.change<L>(reduction, d_tau_, tau_, pack<L>(&phi_[i]), tau_h, step_h, i);
    const SimdPack<L> l =
        low_.change<L>(reduction, d_tau_, tau_, pack<L>(&phi_l[i]), tau_l, step_l, i);
    most.add(high_.finish<L>(h, i).max(low_.finish<L>(l, i)));
  });
  falls_ = most.value();
  for (std::size_t e = 0; e < forms_.equations.size(); ++e) {
    const int f = forms_.equations[e];
    equation_dy_[static_cast<Eigen::Index>(e)] =
        kEquation * (G_(f, kStep) + d_tau_ * (G_(f, kTau) - forms_.hi[f]) -
                     reduction * (forms_.hi[f] * tau_ - phi_[f]));
  }
}

/// Adds a change of all forms, without tau, to the present steps.
void Embedding::add_change() {
  PackMax most;
  const Eigen::MatrixXd& G_l = G_low();
  for_packs(forms_.size, [&]<int L>(Eigen::Index i) {
    most.add(high_.add<L>(pack<L>(&G_(i, kStep)), i).max(low_.add<L>(pack<L>(&G_l(i, kStep)), i)));
  });
  falls_ = most.value();
  for (std::size_t e = 0; e < forms_.equations.size(); ++e) {
    equation_dy_[static_cast<Eigen::Index>(e)] += kEquation * G_(forms_.equations[e], kStep);
  }
}

}  // namespace maxwrench
