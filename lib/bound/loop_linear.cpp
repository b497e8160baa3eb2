#include "lib/bound/loop_linear.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/bound/bounds.h"

namespace maxwrench {
namespace {

/// Of angles up to r.
double largest_sine(double r) { return r < std::numbers::pi / 2 ? std::sin(r) : 1; }

}  // namespace

LoopLinear::LoopLinear(const LoopModel& model) : model_(model) {
  const auto d = static_cast<Eigen::Index>(model.coordinates.chain.count());
  f_0_ = rho_ = e_ = reduced_rho_ = Eigen::VectorXd::Zero(model.m);
  D_ = A_ = Eigen::MatrixXd::Zero(model.m, d);
  M_ = Eigen::MatrixXd::Identity(model.m, model.m);
  w_ = low_ = high_ = Eigen::VectorXd::Zero(d);
}

/// The coefficients of a part in cosines and sines about the centre of the box, and the sizes of
/// what they multiply.
void LoopLinear::turn(const MultiAffine& f, const Eigen::VectorXd& lower,
                      const Eigen::VectorXd& upper) {
  coefficients_ = f.coefficients();
  weights_.setOnes(coefficients_.cols());
  const Coordinates& along = f.coordinates();
  Eigen::Index step = coefficients_.cols();
  for (int i = 0; i < along.count(); ++i) {
    const int at = along.index[static_cast<std::size_t>(i)];
    const bool turns = along.turns[static_cast<std::size_t>(i)] != 0;
    const double mid = (lower[at] + upper[at]) / 2, r = (upper[at] - lower[at]) / 2;
    const double c = std::cos(mid), s = std::sin(mid), half = (1 - std::cos(r)) / 2;
    const int terms = turns ? 3 : 2;
    step /= terms;
    for (Eigen::Index first = 0; first < coefficients_.cols(); ++first) {
      if (first / step % terms != 0) continue;
      auto F_0 = coefficients_.col(first), F_1 = coefficients_.col(first + step);
      weights_[first + step] *= turns ? half : r;
      if (!turns) {
        F_0 += mid * F_1;
        continue;
      }
      auto F_2 = coefficients_.col(first + 2 * step);
      weights_[first + 2 * step] *= largest_sine(r);
      turned_ = c * F_1 + s * F_2;
      F_2 = c * F_2 - s * F_1;
      F_1 = turned_;
      F_0 += (1 - half) * turned_;
    }
  }
}

/// Adds a part to f_0, D and rho.
void LoopLinear::gather(const LoopPart& part) {
  const Coordinates& along = part.f.coordinates();
  f_0_(part.rows) += coefficients_.col(0);
  weights_[0] = 0;
  Eigen::Index step = coefficients_.cols();
  for (int i = 0; i < along.count(); ++i) {
    const int terms = along.turns[static_cast<std::size_t>(i)] != 0 ? 3 : 2;
    step /= terms;
    const Eigen::Index linear = (terms - 1) * step;
    D_.col(part.from + i)(part.rows) += coefficients_.col(linear);
    weights_[linear] = 0;
  }
  rho_(part.rows) += coefficients_.cwiseAbs() * weights_;
}

void LoopLinear::expand(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  f_0_.setZero();
  D_.setZero();
  rho_ = kBoundRounding * kMostSpread * model_.f;
  for (const LoopPart& part : model_.parts) {
    if (part.kind != LoopPart::Kind::kEquations) continue;
    turn(part.f, lower, upper);
    gather(part);
  }
  const Coordinates& chain = model_.coordinates.chain;
  for (int i = 0; i < chain.count(); ++i) {
    const int at = chain.index[static_cast<std::size_t>(i)];
    const double r = (upper[at] - lower[at]) / 2;
    const bool turns = chain.turns[static_cast<std::size_t>(i)] != 0;
    w_[i] = turns ? largest_sine(r) : r;
    D_.col(i) *= w_[i];
  }
}

/// Gauss and Jordan with complete pivoting, of D in units of w.
void LoopLinear::eliminate() {
  constexpr double kLeastPivot = 1e-7;
  A_ = D_;
  M_.setIdentity();
  rank_ = 0;
  const Eigen::Index most = std::min(A_.rows(), A_.cols());
  double first = 0;
  while (rank_ < most) {
    Eigen::Index row = 0, column = 0;
    const double pivot = A_.bottomRows(A_.rows() - rank_).cwiseAbs().maxCoeff(&row, &column);
    if (rank_ == 0) first = pivot;
    if (!(pivot > kLeastPivot * first)) break;
    row += rank_;
    if (row != rank_) {
      A_.row(row).swap(A_.row(rank_));
      M_.row(row).swap(M_.row(rank_));
    }
    const double scale = 1 / A_(rank_, column);
    A_.row(rank_) *= scale;
    M_.row(rank_) *= scale;
    for (Eigen::Index i = 0; i < A_.rows(); ++i) {
      const double factor = A_(i, column);
      if (i == rank_ || factor == 0) continue;
      A_.row(i) -= factor * A_.row(rank_);
      M_.row(i) -= factor * M_.row(rank_);
    }
    ++rank_;
  }
  A_.noalias() = M_ * D_;
}

void LoopLinear::precondition(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  expand(lower, upper);
  eliminate();
}

/// Each row e + A u + rest = 0, |rest| <= rho, limits each u_j, within [low, high]; false: it
/// cannot be.
bool LoopLinear::propagate(const Eigen::MatrixXd& A, const Eigen::VectorXd& e,
                           const Eigen::VectorXd& rho) {
  constexpr double kLeast = 1e-6;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    double least = e[i] - rho[i], most = e[i] + rho[i];
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const double at_low = A(i, j) * low_[j], at_high = A(i, j) * high_[j];
      least += std::min(at_low, at_high);
      most += std::max(at_low, at_high);
    }
    if (least > 0 || most < 0) return false;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const double slope = A(i, j);
      if (std::abs(slope) < kLeast) continue;
      const double at_low = slope * low_[j], at_high = slope * high_[j];
      // slope u_j in [-(most - its part), -(least - its part)]
      const double from = std::max(at_low, at_high) - most, to = std::min(at_low, at_high) - least;
      const double old_low = low_[j], old_high = high_[j];
      low_[j] = std::max(old_low, std::min(from / slope, to / slope) - 1e-12);
      high_[j] = std::min(old_high, std::max(from / slope, to / slope) + 1e-12);
      if (low_[j] > high_[j]) return false;
      const double new_low = slope * low_[j], new_high = slope * high_[j];
      least += std::min(new_low, new_high) - std::min(at_low, at_high);
      most += std::max(new_low, new_high) - std::max(at_low, at_high);
    }
  }
  return true;
}

/// The box of what is left of u; remembers the largest gain.
bool LoopLinear::narrow(Eigen::VectorXd& lower, Eigen::VectorXd& upper) {
  constexpr double kOutward = 1e-12;
  constexpr double kSteep = 0.999;  ///< sines near 1 tell little of their angles
  gain_ = 0;
  const Coordinates& chain = model_.coordinates.chain;
  for (int i = 0; i < chain.count(); ++i) {
    const int at = chain.index[static_cast<std::size_t>(i)];
    const double mid = (lower[at] + upper[at]) / 2, r = (upper[at] - lower[at]) / 2;
    const bool turns = chain.turns[static_cast<std::size_t>(i)] != 0;
    if (turns && r >= std::numbers::pi / 2) continue;
    const auto offset = [&](double u) {
      const double s = u * w_[i];
      if (std::abs(u) >= 1 || (turns && std::abs(s) > kSteep)) return u > 0 ? r : -r;
      return turns ? std::asin(s) : s;
    };
    const double from = mid + offset(low_[i]) - kOutward, to = mid + offset(high_[i]) + kOutward;
    if (from > upper[at] || to < lower[at]) return false;
    const double kept = std::min(to, upper[at]) - std::max(from, lower[at]);
    if (r > 1e-7) gain_ = std::max(gain_, 1 - kept / (2 * r));
    lower[at] = std::max(from, lower[at]);
    upper[at] = std::min(to, upper[at]);
  }
  return true;
}

bool LoopLinear::shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper) {
  constexpr int kMostRounds = 8;
  constexpr double kWorthwhile = 0.1;
  for (int round = 0; round < kMostRounds; ++round) {
    expand(lower, upper);
    low_.setConstant(-1);
    high_.setConstant(1);
    if (!propagate(D_, f_0_, rho_)) return false;
    eliminate();
    e_.noalias() = M_ * f_0_;
    reduced_rho_.noalias() = M_.cwiseAbs() * rho_;
    // What is computed of M D is off by rounding, which rho_ holds many times.
    if (!propagate(A_, e_, reduced_rho_)) return false;
    if (!narrow(lower, upper)) return false;
    if (gain_ < kWorthwhile) break;
  }
  return true;
}

}  // namespace maxwrench
