#include "solvers/certify/bound/loop_linear.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/loop_model.h"

namespace maxwrench {
namespace {

/// The largest sine of angles up to r.
double largest_sine(double r) { return r < std::numbers::pi / 2 ? std::sin(r) : 1; }

}  // namespace

LoopLinear::LoopLinear(const LoopModel& model) : model_(model), points_(model) {
  const auto d = static_cast<Eigen::Index>(model.coordinates.chain.count());
  f_0_ = rho_ = e_ = reduced_rho_ = Eigen::VectorXd::Zero(model.m);
  D_ = A_ = Eigen::MatrixXd::Zero(model.m, d);
  M_ = Eigen::MatrixXd::Identity(model.m, model.m);
  w_ = low_ = high_ = Eigen::VectorXd::Zero(d);
}

/// Computes the coefficients of a part in cosines and sines about the centre of the box, and the
/// magnitudes of the factors that they multiply.
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
    const int terms = along.terms(i);
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
    const int terms = along.terms(i);
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

/// Gauss-Jordan elimination with complete pivoting, of D in units of w.
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

void LoopLinear::limit(const Limit& by, double value) {
  double& old = by.upper ? high_[by.axis] : low_[by.axis];
  if (by.upper ? value >= old : value <= old) return;
  old = value;
  const auto known = std::find(limits_.begin(), limits_.end(), by);
  if (known != limits_.end()) limits_.erase(known);
  limits_.push_back(by);
}

/// Each row e + A u + rest = 0, |rest| <= rho, limits each u_j further, within [low, high]. Returns
/// false if no u satisfies a row.
bool LoopLinear::propagate(const Eigen::MatrixXd& A, const Eigen::VectorXd& e,
                           const Eigen::VectorXd& rho, int first_row) {
  constexpr double kLeast = 1e-6;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    refuted_ = first_row + static_cast<int>(i);
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
      // slope u_j is in [-(most - its part), -(least - its part)].
      const double from = std::max(at_low, at_high) - most, to = std::min(at_low, at_high) - least;
      limit({static_cast<int>(j), refuted_, false}, std::min(from / slope, to / slope) - 1e-12);
      limit({static_cast<int>(j), refuted_, true}, std::max(from / slope, to / slope) + 1e-12);
      if (low_[j] > high_[j]) return false;
      const double new_low = slope * low_[j], new_high = slope * high_[j];
      least += std::min(new_low, new_high) - std::min(at_low, at_high);
      most += std::max(new_low, new_high) - std::max(at_low, at_high);
    }
  }
  return true;
}

/// Propagates the equations, then combinations of them that have few u_j.
bool LoopLinear::propagate_all() {
  low_.setConstant(-1);
  high_.setConstant(1);
  limits_.clear();
  if (!propagate(D_, f_0_, rho_, 0)) return false;
  eliminate();
  e_.noalias() = M_ * f_0_;
  reduced_rho_.noalias() = M_.cwiseAbs() * rho_;
  return propagate(A_, e_, reduced_rho_, static_cast<int>(model_.m));
}

/// Uses the precision of a float, which is enough and compresses better.
void LoopLinear::set_multiplier(int row) {
  const auto m = static_cast<int>(model_.m);
  if (row < m) {
    cut_.multiplier = Eigen::VectorXd::Unit(m, row);
  } else {
    cut_.multiplier = M_.row(row - m).cast<float>().cast<double>();
  }
}

/// Whether the row proves that a box has no x with f(x) = 0; if so, adds it to `cuts`.
bool LoopLinear::excludes(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int row,
                          int axis, std::vector<BoxCut>* cuts) {
  set_multiplier(row);
  const int sign = points_.sign(lower, upper, cut_.multiplier);
  if (sign == 0) return false;
  cut_.multiplier *= sign;
  cut_.axis = axis;
  if (cuts != nullptr) cuts->push_back(cut_);
  return true;
}

/// Cuts off the part of the box beyond a limit, or the outer half of that part. Returns false if
/// this is the whole box.
bool LoopLinear::slice(const Limit& by, Eigen::VectorXd& lower, Eigen::VectorXd& upper,
                       std::vector<BoxCut>* cuts) {
  constexpr double kOutward = 1e-12;
  constexpr double kSteep = 0.999;    ///< sines near 1 determine their angles badly
  constexpr double kThinnest = 0.01;  ///< of the box
  constexpr int kTries = 3;
  const Coordinates& chain = model_.coordinates.chain;
  const bool turns = chain.turns[static_cast<std::size_t>(by.axis)] != 0;
  const int axis = chain.index[static_cast<std::size_t>(by.axis)];
  const double mid = centre_[axis], r = radius_[axis];
  const double sine = (by.upper ? high_ : low_)[by.axis] * w_[by.axis];
  if (turns && (std::abs(sine) > kSteep || r >= std::numbers::pi / 2)) return true;
  cut_.upper = by.upper;
  cut_.at = mid + (turns ? std::asin(sine) : sine) + (by.upper ? kOutward : -kOutward);
  if (by.upper ? cut_.at <= lower[axis] : cut_.at >= upper[axis]) {
    return !excludes(lower, upper, by.row, -1, cuts);
  }
  double& end = by.upper ? upper[axis] : lower[axis];
  for (int i = 0; i < kTries; ++i, cut_.at = (cut_.at + end) / 2) {
    const double thickness = by.upper ? end - cut_.at : cut_.at - end;
    if (!(thickness > kThinnest * 2 * r)) break;
    slice_lower_ = lower;
    slice_upper_ = upper;
    (by.upper ? slice_lower_ : slice_upper_)[axis] = cut_.at;
    cut_.end = end;
    if (!excludes(slice_lower_, slice_upper_, by.row, axis, cuts)) continue;
    gain_ = std::max(gain_, thickness / (2 * r));
    end = cut_.at;
    break;
  }
  return true;
}

bool LoopLinear::shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) {
  constexpr int kMostRounds = 8;
  constexpr double kWorthwhile = 0.1;
  for (int round = 0; round < kMostRounds; ++round) {
    expand(lower, upper);
    centre_ = (lower + upper) / 2;
    radius_ = (upper - lower) / 2;
    gain_ = 0;
    const bool possible = propagate_all();
    for (const Limit& limit : limits_) {
      if (!slice(limit, lower, upper, cuts)) return false;
    }
    if (!possible && excludes(lower, upper, refuted_, -1, cuts)) return false;
    if (gain_ < kWorthwhile) break;
  }
  return true;
}

}  // namespace maxwrench
