#include "solvers/certify/bound/free_limits.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "solvers/certify/bound/bounds.h"

namespace maxwrench {
namespace {

constexpr double kMargin = 1e-12;  ///< for rounding, as a share
constexpr double kWider = 1e-3;    ///< what makes limits strict, as a share
constexpr double kLeastReach = 1e-9;
constexpr int kTightenings = 4;

}  // namespace

FreeLimits::FreeLimits(const Zonotope& set, const Eigen::MatrixXd& sizes)
    : set_(set),
      rounding_(kBoundRounding * kMostSpread * sizes),
      farthest_(set.u_min.cwiseAbs().cwiseMax(set.u_max.cwiseAbs())),
      scales_((set.B.cwiseAbs() * farthest_).cwiseMax(1e-9)) {
  Z_.setZero(sizes.cols() - 1);
}

/// The pseudo-inverse of A, with each row divided by what the actuators can exert in it.
void FreeLimits::find_inverse(const Eigen::MatrixXd& A) {
  scaled_ = A.array().colwise() / scales_.array();
  normal_.noalias() = scaled_.transpose() * scaled_;
  llt_.compute(normal_);
  P_ = llt_.solve(scaled_.transpose());
  P_.array().rowwise() /= scales_.transpose().array();
}

bool FreeLimits::find(const Eigen::VectorXd& tau, const Eigen::MatrixXd& A,
                      const Eigen::MatrixXd& off, double most_t) {
  find_inverse(A);
  if (!P_.allFinite()) return false;
  PB_.noalias() = P_ * set_.B;
  reach(P_, b_);
  b_ *= kBoundRounding * kMostSpread;
  b_.noalias() += PB_.cwiseAbs() * farthest_;
  b_ += (P_ * tau).cwiseAbs();
  b_.noalias() += P_.cwiseAbs() * (off.col(0) + rounding_.col(0));
  const Eigen::Index columns = A.cols();
  E_.noalias() = P_ * A;
  E_ -= Eigen::MatrixXd::Identity(columns, columns);
  E_ = E_.cwiseAbs().eval();
  E_.noalias() += P_.cwiseAbs() * (off + rounding_).rightCols(columns);
  if (!solve(0, 0)) {
    if (!std::isfinite(most_t) || !solve(1, most_t)) return false;
    Z_[0] = most_t;
  }
  for (int i = 0; i < kTightenings; ++i) {
    Z_[0] = std::min(Z_[0], most_t);
    next_ = b_ * (1 + kMargin);
    next_.noalias() += (1 + kMargin) * E_ * Z_;
    Z_ = Z_.cwiseMin(next_);
  }
  return true;
}

/// Solves for the components of Z from one on; those before it add their column of E times `known`.
/// Returns false if it proves no limits.
bool FreeLimits::solve(Eigen::Index from, double known) {
  const Eigen::Index count = E_.rows() - from;
  I_E_ = -E_.bottomRightCorner(count, count);
  I_E_.diagonal().array() += 1;
  own_ = (b_ + known * E_.col(0)).tail(count).cwiseMax(kLeastReach);
  next_ = I_E_.partialPivLu().solve(own_) * (1 + kWider);
  if (!(next_.array() > 0).all() || !next_.allFinite()) return false;
  own_.noalias() += E_.bottomRightCorner(count, count) * next_;
  if (!((1 + kMargin) * own_.array() < next_.array()).all()) return false;
  Z_.tail(count) = next_;
  return true;
}

void FreeLimits::rest(const Eigen::MatrixXd& P, const Eigen::MatrixXd& A,
                      const Eigen::MatrixXd& off, Eigen::VectorXd& R) {
  const Eigen::Index columns = A.cols();
  E_.noalias() = P * A;
  E_.rightCols(columns - 1) -= Eigen::MatrixXd::Identity(columns - 1, columns - 1);
  R.noalias() = E_.cwiseAbs() * Z_;
  own_ = off.col(0) + rounding_.col(0);
  own_.noalias() += (off + rounding_).rightCols(columns) * Z_;
  R.noalias() += P.cwiseAbs() * own_;
  R *= 1 + kMargin;
}

void FreeLimits::reach(const Eigen::MatrixXd& P, Eigen::VectorXd& most) const {
  most.noalias() = P.cwiseAbs() * (set_.B.cwiseAbs() * farthest_);
}

}  // namespace maxwrench
