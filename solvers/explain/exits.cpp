#include "solvers/explain/exits.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

/// Shares of |a| and of |B_i| below which a product with a unit normal is zero up to rounding.
constexpr double kFlatSlope = 1e-12, kFlatColumn = 1e-13;
/// An exit within this share of 1 + |beta| of the least one is active, too.
constexpr double kSameExit = 1e-9;

/// By how much a limit may move at `rate` until something with this slack is met; negative slack is
/// rounding.
double until(double slack, double rate) {
  return rate > 0 ? std::max(slack, 0.0) / rate : kInfinity;
}

}  // namespace

Exits::Exits(const WrenchProgram& program)
    : set_(*program.actuation), NtB_(set_.N.transpose() * set_.B) {
  for (Eigen::Index i = 0; i < NtB_.cols(); ++i) {
    const double least = kFlatColumn * set_.B.col(i).norm();
    for (double& entry : NtB_.col(i)) entry = std::abs(entry) < least ? 0 : entry;
  }
  const auto a = program.JtW.col(0);
  const double flat = kFlatSlope * a.norm();
  for (Eigen::Index pair = 0; pair < set_.N.cols(); ++pair) {
    const auto normal = set_.N.col(pair);
    for (const double sign : {1.0, -1.0}) {
      const double b = sign > 0 ? set_.b_max[pair] : -set_.b_min[pair];
      if (!(b < kInfinity)) continue;
      const double slack = b - sign * normal.dot(program.tau_d);
      const double slope = sign * normal.dot(a);
      if (std::abs(slope) <= flat) {
        parallel_.push_back({pair, sign, 1, slack});
      } else {
        (slope > 0 ? exits_ : entries_).push_back({pair, sign, slope, slack / slope});
      }
    }
  }
  for (const Side& exit : exits_) beta_ = std::min(beta_, exit.x);
}

/// d x/d limit of a side.
double Exits::moves(const Side& side, Eigen::Index i, LimitSide limit) const {
  const double along = side.sign * NtB_(side.pair, i);
  return (limit == LimitSide::kUpper ? std::max(along, 0.0) : std::min(along, 0.0)) / side.slope;
}

LimitRange Exits::range(Eigen::Index i, LimitSide limit) const {
  LimitRange range{kInfinity, -kInfinity};
  for (const Side& exit : exits_) {
    if (exit.x > beta_ + kSameExit * (1 + std::abs(beta_))) continue;
    range.rate_up = std::min(range.rate_up, moves(exit, i, limit));
    range.rate_down = std::max(range.rate_down, moves(exit, i, limit));
  }
  const auto end = [&range](double up, double down) {
    range.up = std::min(range.up, up);
    range.down = std::min(range.down, down);
  };
  for (const Side& exit : exits_) {
    const double move = moves(exit, i, limit), slack = exit.x - beta_;
    if (slack <= kSameExit * (1 + std::abs(beta_))) continue;
    end(until(slack, range.rate_up - move), until(slack, move - range.rate_down));
  }
  for (const Side& entry : entries_) {
    const double move = moves(entry, i, limit), slack = beta_ - entry.x;
    end(until(slack, move - range.rate_up), until(slack, range.rate_down - move));
  }
  for (const Side& side : parallel_) {
    const double move = moves(side, i, limit);
    end(until(side.x, -move), until(side.x, move));
  }
  const double width = set_.u_max[i] - set_.u_min[i];
  if (limit == LimitSide::kUpper) end(kInfinity, width);
  if (limit == LimitSide::kLower) end(width, kInfinity);
  return range;
}

}  // namespace maxwrench
