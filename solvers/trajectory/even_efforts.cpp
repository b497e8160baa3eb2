#include "solvers/trajectory/even_efforts.h"

#include <Eigen/LU>
#include <cmath>

#include "lib/math/decompositions.h"

namespace maxwrench {
namespace {

constexpr int kMostExchanges = 50;
/// The excess over g from which a row counts as violated.
constexpr double kExcess = 1e-12;
/// Singular values below this share of the largest count as zero.
constexpr double kRank = 1e-9;

}  // namespace

bool EvenEfforts::prepare(const Zonotope& set) {
  if (set_ == &set) return !basis_.empty() || Z_.cols() == 0;
  set_ = &set;
  basis_.clear();
  Z_.resize(set.actuators(), 1);
  if (!set.full_row_rank() || !split(set)) return false;
  const Eigen::Index q = Z_.cols();
  if (q == 0) return true;
  if (q > kMostMoves) return false;
  moved_.clear();
  for (int j = 0; j < set.actuators(); ++j) {
    if (Z_.row(j).norm() > 1e-9) {
      moved_.push_back(j);
    } else {
      Z_.row(j).setZero();
    }
  }
  const auto count = static_cast<Eigen::Index>(moved_.size());
  zeta_.resize(count, q);
  alpha_.resize(count);
  for (Eigen::Index r = 0; r < count; ++r) {
    const int j = moved_[r];
    const double half = 0.5 * (set.u_max[j] - set.u_min[j]);
    if (!(half > 0) || !std::isfinite(half)) return false;
    zeta_.row(r) = Z_.row(j) / half;
  }
  for (SmallVector* v : {&point_, &right_, &weight_, &change_, &sign_}) v->resize(q + 1);
  return first_basis();
}

/// Sets Z, B^+ and the efforts of actuators without range.
bool EvenEfforts::split(const Zonotope& set) {
  std::vector<Eigen::Index> free;
  fixed_.setZero(set.actuators());
  for (Eigen::Index j = 0; j < set.actuators(); ++j) {
    if (set.u_min[j] < set.u_max[j]) {
      free.push_back(j);
    } else {
      fixed_[j] = set.u_min[j];
    }
  }
  tau_0_.noalias() = set.B * fixed_;
  rest_ = tau_0_;
  if (static_cast<int>(free.size()) == set.actuators()) {
    Z_ = svd(set.B).V.rightCols(set.actuators() - set.rank);
    B_pinv_ = set.B_pinv;
    return true;
  }
  const Eigen::MatrixXd B = set.B(Eigen::all, free);
  const Svd parts = svd(B);
  if (parts.rank(kRank) < set.dimension()) return false;
  Z_.setZero(set.actuators(), B.cols() - B.rows());
  Z_(free, Eigen::all) = parts.V.rightCols(Z_.cols());
  B_pinv_.setZero(set.actuators(), set.dimension());
  B_pinv_(free, Eigen::all) = pseudo_inverse(B);
  return true;
}

/// Any q + 1 rows are linearly dependent; their signs are chosen so that the dependence becomes a
/// convex one.
bool EvenEfforts::first_basis() {
  const Eigen::Index q = Z_.cols();
  Eigen::FullPivLU<Eigen::MatrixXd> lu(zeta_.transpose());
  if (lu.rank() < q || zeta_.rows() <= q) return false;
  // q independent rows and one more.
  for (Eigen::Index c = 0; c <= q; ++c) {
    basis_.push_back(static_cast<int>(lu.permutationQ().indices()[c]));
  }
  Eigen::MatrixXd chosen(q, q);
  for (Eigen::Index c = 0; c < q; ++c) chosen.col(c) = zeta_.row(basis_[c]).transpose();
  weight_.head(q) = -chosen.lu().solve(zeta_.row(basis_[q]).transpose());
  weight_[q] = 1;
  for (Eigen::Index c = 0; c <= q; ++c) sign_[c] = weight_[c] < 0 ? -1 : 1;
  if (factor()) return true;
  basis_.clear();
  return false;
}

/// The rows (sign zeta', -1) of the basis, inverted; y with rows'y = (0, -1).
bool EvenEfforts::factor() {
  const Eigen::Index q = Z_.cols();
  rows_.resize(q + 1, q + 1);
  for (Eigen::Index c = 0; c <= q; ++c) {
    rows_.row(c).head(q) = sign_[c] * zeta_.row(basis_[c]);
    rows_(c, q) = -1;
  }
  inverse_ = rows_.inverse();
  if (!inverse_.allFinite()) return false;
  weight_ = -inverse_.row(q).transpose();
  return true;
}

/// The row enters, and the leaving row is chosen so that y >= 0.
bool EvenEfforts::exchange(int entering, double sign) {
  const Eigen::Index q = Z_.cols();
  change_.setZero();
  for (Eigen::Index c = 0; c < q; ++c) {
    change_ += inverse_.row(c).transpose() * (sign * zeta_(entering, c));
  }
  change_ -= inverse_.row(q).transpose();
  Eigen::Index leaving = -1;
  double least = 0;
  for (Eigen::Index c = 0; c <= q; ++c) {
    if (change_[c] <= 1e-12) continue;
    const double ratio = weight_[c] / change_[c];
    if (leaving >= 0 && ratio >= least) continue;
    leaving = c;
    least = ratio;
  }
  if (leaving < 0) return false;
  basis_[leaving] = entering;
  sign_[leaving] = sign;
  return factor();
}

bool EvenEfforts::solve(const Eigen::VectorXd& tau, Eigen::Ref<Eigen::VectorXd> u) {
  const Zonotope& set = *set_;
  const Eigen::Index q = Z_.cols();
  rest_ = tau - tau_0_;
  u.noalias() = B_pinv_.lazyProduct(rest_);
  u += fixed_;
  if (q == 0) return true;
  for (std::size_t r = 0; r < moved_.size(); ++r) {
    const int j = moved_[r];
    const double half = 0.5 * (set.u_max[j] - set.u_min[j]);
    alpha_[r] = (u[j] - 0.5 * (set.u_max[j] + set.u_min[j])) / half;
  }
  for (int count = 0; count < kMostExchanges; ++count) {
    for (Eigen::Index c = 0; c <= q; ++c) right_[c] = -sign_[c] * alpha_[basis_[c]];
    point_.noalias() = inverse_.lazyProduct(right_);
    int entering = -1;
    double sign = 1;
    double most = point_[q] + kExcess;
    for (Eigen::Index r = 0; r < alpha_.size(); ++r) {
      const double load = alpha_[r] + zeta_.row(r).dot(point_.head(q));
      if (std::abs(load) <= most) continue;
      most = std::abs(load);
      entering = static_cast<int>(r);
      sign = load < 0 ? -1 : 1;
    }
    if (entering < 0) {
      u.noalias() += Z_.lazyProduct(point_.head(q));
      return true;
    }
    if (!exchange(entering, sign)) break;
  }
  basis_.clear();
  set_ = nullptr;
  return false;
}

}  // namespace maxwrench
