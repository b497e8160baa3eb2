#include "verify/free_wrench_limits.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <utility>

namespace maxwrench {
namespace {

/// Limits are widened by this share, so that they are strict.
constexpr double kWider = 1e-3;
constexpr double kLeastReach = 1e-9;
constexpr int kTightenings = 4;

// Of the efforts that h may depend on.
constexpr double kSmallShare = 1e-3;  ///< of the largest term of the support
constexpr double kLeastWidth = 1e-5;
constexpr double kRidge = 1e-13;

/// a_i b, minus `less`.
Narrow product(const Eigen::MatrixXd& a, Eigen::Index i, const Eigen::VectorXd& b,
               double less = 0) {
  Narrow sum(-less);
  for (Eigen::Index j = 0; j < b.size(); ++j) sum += Narrow(a(i, j)) * Narrow(b[j]);
  return sum;
}

/// |a_i| b
Narrow most(const Eigen::MatrixXd& a, Eigen::Index i, const Eigen::VectorXd& b) {
  Narrow sum;
  for (Eigen::Index j = 0; j < b.size(); ++j) sum += Narrow(std::abs(a(i, j))) * Narrow(b[j]);
  return sum;
}

}  // namespace

FreeWrenchLimits::FreeWrenchLimits(const Zonotope& set, Eigen::VectorXd tau, Eigen::MatrixXd A,
                                   Eigen::MatrixXd off)
    : set_(set),
      tau_(std::move(tau)),
      farthest_(set.u_min.cwiseAbs().cwiseMax(set.u_max.cwiseAbs())),
      A_(std::move(A)),
      off_(std::move(off)) {}

/// The pseudo-inverse of A, with each row divided by what the actuators can exert in it.
Eigen::MatrixXd FreeWrenchLimits::left_inverse() const {
  const Eigen::VectorXd scales = (set_.B.cwiseAbs() * farthest_).cwiseMax(kLeastReach);
  const Eigen::MatrixXd scaled = scales.cwiseInverse().asDiagonal() * A_;
  const Eigen::MatrixXd P = (scaled.transpose() * scaled).llt().solve(scaled.transpose());
  return P * scales.cwiseInverse().asDiagonal();
}

/// That with the least squares of P B u over the efforts with small lambda'B.
Eigen::MatrixXd FreeWrenchLimits::left_inverse(const Eigen::VectorXd& lambda) const {
  const Eigen::ArrayXd half = (set_.u_max - set_.u_min).array() / 2;
  const Eigen::ArrayXd terms = (set_.B.transpose() * lambda).array().abs() * half;
  const Eigen::ArrayXd shares = kSmallShare * terms.maxCoeff() / terms.max(1e-300);
  const Eigen::ArrayXd widths = shares.min(1).max(kLeastWidth) * half;
  Eigen::MatrixXd S = set_.B * widths.square().matrix().asDiagonal() * set_.B.transpose();
  S.diagonal().array() += kRidge * S.diagonal().maxCoeff();
  const Eigen::MatrixXd weighted = S.llt().solve(A_);
  return (A_.transpose() * weighted).llt().solve(weighted.transpose());
}

Eigen::VectorXd FreeWrenchLimits::find(double most_t) const {
  const Eigen::MatrixXd P = left_inverse();
  const Eigen::Index columns = A_.cols();
  if (!P.allFinite()) return {};
  Eigen::VectorXd b(columns);
  Eigen::MatrixXd E(columns, columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    Narrow sum = most(P, i, off_.col(0)) + Narrow(product(P, i, tau_).magnitude());
    for (Eigen::Index k = 0; k < set_.actuators(); ++k) {
      sum += Narrow(product(P, i, set_.B.col(k)).magnitude()) * Narrow(farthest_[k]);
    }
    b[i] = sum.high;
    for (Eigen::Index j = 0; j < columns; ++j) {
      E(i, j) = (most(P, i, off_.col(1 + j)) +
                 Narrow(product(P, i, A_.col(j), i == j ? 1 : 0).magnitude()))
                    .high;
    }
  }
  const auto next = [&](const Eigen::VectorXd& Z, Eigen::Index i) {
    return (Narrow(b[i]) + product(E, i, Z)).high;
  };
  // The first `from` numbers of Z are known.
  const auto solve = [&](Eigen::Index from, Eigen::VectorXd& Z) {
    const Eigen::Index count = columns - from;
    const Eigen::MatrixXd I_E =
        Eigen::MatrixXd::Identity(count, count) - E.bottomRightCorner(count, count);
    const Eigen::VectorXd own =
        (b + E.leftCols(from) * Z.head(from)).tail(count).cwiseMax(kLeastReach);
    Z.tail(count) = I_E.partialPivLu().solve(own) * (1 + kWider);
    for (Eigen::Index i = from; i < columns; ++i) {
      if (!(Z[i] > 0 && next(Z, i) < Z[i])) return false;
    }
    return Z.allFinite();
  };
  Eigen::VectorXd Z = Eigen::VectorXd::Constant(columns, most_t);
  if (!solve(0, Z)) {
    Z[0] = most_t;
    if (!(most_t < kInfinity) || !solve(1, Z)) return {};
  }
  for (int i = 0; i < kTightenings; ++i) {
    Z[0] = std::min(Z[0], most_t);
    Eigen::VectorXd less(columns);
    for (Eigen::Index j = 0; j < columns; ++j) less[j] = std::min(Z[j], next(Z, j));
    Z = less;
  }
  return Z;
}

FreeWrenchLimits::Law FreeWrenchLimits::law(const Eigen::VectorXd& lambda,
                                            const Eigen::VectorXd& Z) const {
  const Eigen::Index k = A_.cols() - 1;
  Eigen::MatrixXd P = left_inverse(lambda).bottomRows(k);
  if (!P.allFinite()) P = left_inverse().bottomRows(k);
  Law law{P * set_.B, P * tau_, Eigen::VectorXd(k)};
  for (Eigen::Index i = 0; i < k; ++i) {
    Narrow sum = most(P, i, off_.col(0)) + Narrow(product(P, i, tau_, law.p[i]).magnitude());
    for (Eigen::Index a = 0; a < set_.actuators(); ++a) {
      const Narrow rounded = product(P, i, set_.B.col(a), law.M(i, a));
      sum += Narrow(rounded.magnitude()) * Narrow(farthest_[a]);
    }
    for (Eigen::Index j = 0; j <= k; ++j) {
      const Narrow rest = product(P, i, A_.col(j), j == i + 1 ? 1 : 0);
      sum += (Narrow(rest.magnitude()) + most(P, i, off_.col(1 + j))) * Narrow(Z[j]);
    }
    law.R[i] = sum.high;
  }
  return law;
}

}  // namespace maxwrench
