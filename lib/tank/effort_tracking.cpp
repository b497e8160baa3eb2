#include "lib/tank/effort_tracking.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

constexpr double kReached = 1e-9;     // of the largest control effort, at least 1
constexpr double kMissed = 1e-6;      // likewise; above this the control effort is not reached
constexpr double kAtBound = 1e-9;     // of an effort
constexpr double kStiffness = 1e6;    // weight of the shortfall relative to the distance from u*
constexpr double kRankMargin = 1e-9;  // of B Q^-1 B', so that it always has an inverse
constexpr int kMultiplierSteps = 8;   // each shrinks the shortfall by up to kStiffness
constexpr int kIterationsPerEffort = 20;

}  // namespace

EffortTracker::EffortTracker(const Eigen::VectorXd& Q)
    : Q_(Q), side_(static_cast<std::size_t>(Q.size())) {}

void EffortTracker::solve(const EffortRequest& request, EffortAnswer& answer) {
  answer.iterations = 0;
  answer.converged = true;
  answer.saturated = false;
  const double scale = std::max(1.0, request.tau_c.lpNorm<Eigen::Infinity>());
  BQ_ = Q_.cwiseInverse().asDiagonal() * request.B.transpose();
  S_ = request.B * BQ_;
  S_.diagonal().array() += kRankMargin * S_.trace() / static_cast<double>(S_.rows());
  factored_S_.compute(S_);
  if (!pseudo_inverse(request, answer)) active_set(request, scale, answer);
  answer.shortfall = (request.B * answer.u - request.tau_c).lpNorm<Eigen::Infinity>();
  answer.relaxed = answer.shortfall > kMissed * scale;
  for (Eigen::Index i = 0; i < Q_.size(); ++i) {
    if (request.lower[i] == request.upper[i]) continue;  // it was never free
    const double margin = kAtBound * (1 + std::abs(answer.u[i]));
    answer.saturated |=
        answer.u[i] - request.lower[i] < margin || request.upper[i] - answer.u[i] < margin;
  }
}

/// True if the answer is within the bounds. The second step removes the error due to kRankMargin.
bool EffortTracker::pseudo_inverse(const EffortRequest& request, EffortAnswer& answer) {
  answer.u = request.u_star;
  for (int step = 0; step < 2; ++step) {
    rhs_ = request.tau_c - request.B * answer.u;
    answer.u += BQ_ * factored_S_.solve(rhs_);
  }
  return (answer.u.array() >= request.lower.array()).all() &&
         (answer.u.array() <= request.upper.array()).all();
}

/// With P = (B Q^-1 B')^-1, minimises (u - u*)'Q(u - u*) + rho (B u - y)'P(B u - y) within the
/// bounds. y starts as tau_c and moves until B u = tau_c.
void EffortTracker::active_set(const EffortRequest& request, double scale, EffortAnswer& answer) {
  PB_ = factored_S_.solve(request.B);
  H_ = kStiffness * request.B.transpose() * PB_;
  H_.diagonal() += Q_;
  std::fill(side_.begin(), side_.end(), 0);
  y_ = request.tau_c;
  answer.u = answer.u.cwiseMax(request.lower).cwiseMin(request.upper);
  for (int step = 0; step < kMultiplierSteps; ++step) {
    f_ = Q_.cwiseProduct(request.u_star) + kStiffness * PB_.transpose() * y_;
    minimise_in_box(request, answer);
    if (step == 0) first_ = answer.u;
    rhs_ = request.tau_c - request.B * answer.u;
    if (rhs_.lpNorm<Eigen::Infinity>() <= kReached * scale) return;
    y_ += rhs_;
  }
  // If tau_c cannot be reached, the multipliers grow without bound. The first answer is the
  // nearest.
  if (rhs_.lpNorm<Eigen::Infinity>() > kMissed * scale) answer.u = first_;
}

/// Minimises u'H u/2 - f'u within the bounds, from answer.u within them and the bounds in side_.
void EffortTracker::minimise_in_box(const EffortRequest& request, EffortAnswer& answer) {
  const int limit = kIterationsPerEffort * static_cast<int>(Q_.size());
  target_ = answer.u;
  for (int k = 0; k < limit; ++k) {
    ++answer.iterations;
    target_ = answer.u;
    solve_free();
    if (!step_towards_free(request, answer.u)) continue;  // a bound was met
    if (!release(answer.u)) return;
  }
  answer.converged = false;
}

/// Sets target_ to the minimum over the free efforts, with the others constant.
void EffortTracker::solve_free() {
  free_.clear();
  for (std::size_t i = 0; i < side_.size(); ++i) {
    if (side_[i] == 0) free_.push_back(static_cast<int>(i));
  }
  if (free_.empty()) return;
  gradient_ = f_ - H_ * target_;
  H_free_ = H_(free_, free_);
  rhs_ = gradient_(free_);
  const Eigen::VectorXd step = H_free_.llt().solve(rhs_);
  for (std::size_t i = 0; i < free_.size(); ++i) {
    target_[free_[i]] += step[static_cast<Eigen::Index>(i)];
  }
}

/// Steps as far as the bounds allow. True if the whole step was possible.
bool EffortTracker::step_towards_free(const EffortRequest& request, Eigen::VectorXd& u) {
  double length = 1;
  int blocking = -1, side = 0;
  for (const int i : free_) {
    const double move = target_[i] - u[i];
    const double room = (move < 0 ? request.lower[i] : request.upper[i]) - u[i];
    if (std::abs(move) > std::abs(room) && std::abs(room) < length * std::abs(move)) {
      length = std::abs(room / move);
      blocking = i;
      side = move < 0 ? -1 : 1;
    }
  }
  u += length * (target_ - u);
  if (blocking < 0) return true;
  u[blocking] = side < 0 ? request.lower[blocking] : request.upper[blocking];
  side_[static_cast<std::size_t>(blocking)] = side;
  return false;
}

/// Frees the effort at a bound that the objective pulls inwards most. False if there is none.
bool EffortTracker::release(const Eigen::VectorXd& u) {
  gradient_ = H_ * u - f_;
  int worst = -1;
  double most = 1e-11 * (1 + f_.lpNorm<Eigen::Infinity>());
  for (std::size_t i = 0; i < side_.size(); ++i) {
    const double pull = side_[i] * gradient_[static_cast<Eigen::Index>(i)];
    if (pull > most) {
      most = pull;
      worst = static_cast<int>(i);
    }
  }
  if (worst < 0) return false;
  side_[static_cast<std::size_t>(worst)] = 0;
  return true;
}

}  // namespace maxwrench
