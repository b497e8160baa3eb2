#include "lib/posture/ik/ik_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/posture/ik/ik_start_system.h"

namespace maxwrench {
namespace {

/// [rad or m] If the last theta_r is closer than this, no node of the start system is used.
constexpr double kNear = 0.2;
/// The largest imaginary part of a detour, as a share of its length.
constexpr double kSidestep = 0.4;
/// [rad or m] The spacing of the grid on which postures are sorted.
constexpr double kEqual = 1e-7;

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == 0 ? 0 : (a - b).lpNorm<Eigen::Infinity>();
}

}  // namespace

IkSolver::IkSolver(std::shared_ptr<const IkStartSystem> start_system)
    : start_system_(std::move(start_system)),
      tracker_(start_system_->chain(), start_system_->pose()) {}

int IkSolver::solve(const Eigen::VectorXd& theta_r) {
  if (!start_system_->reaches()) return 0;
  if (node_.theta_r.size() == theta_r.size() && node_.theta_r == theta_r && node_.complete) {
    return count();
  }
  next_.theta_r = theta_r;
  const IkSolutionSet& from = nearest(theta_r);
  next_.complete = next_.full =
      from.full && (track_straight(from) || track_detour(from, 1) || track_detour(from, -1));
  if (!next_.complete) start_system_->go_from_generic(theta_r, tracker_, next_);
  std::swap(node_, next_);
  if (node_.full) last_ = node_;
  sort();
  return count();
}

const IkSolutionSet& IkSolver::nearest(const Eigen::VectorXd& theta_r) {
  double best = last_.full ? distance(last_.theta_r, theta_r) : kInfinity;
  if (best < kNear) return last_;
  int place = -1;
  for (int i = 0; i < start_system_->nodes(); ++i) {
    const double path = distance(start_system_->place(i), theta_r);
    if (path >= best) continue;
    best = path;
    place = i;
  }
  if (place < 0 || !start_system_->node(place).full) return last_;
  return start_system_->node(place);
}

bool IkSolver::track_straight(const IkSolutionSet& from) {
  next_.real = from.real;
  next_.pairs = from.pairs;
  return tracker_.track_straight(from.theta_r, next_);
}

bool IkSolver::track_detour(const IkSolutionSet& from, double side) {
  HomotopyPath<Complex>& path = tracker_.path();
  assign(from.theta_r, path.from);
  assign(next_.theta_r, path.to);
  for (Eigen::Index k = 0; k < path.bend.size(); ++k) {
    path.bend[k] = Complex(0, side * 4 * kSidestep * (next_.theta_r[k] - from.theta_r[k]));
  }
  tracker_.begin();
  for (const Six<double>& y : from.real) tracker_.carry(complex_of(y));
  for (const Six<Complex>& y : from.pairs) {
    tracker_.carry(y);
    Six<Complex> conjugate = y;
    for (Complex& y_i : conjugate) y_i.im = -y_i.im;
    tracker_.carry(conjugate);
  }
  tracker_.finish(next_);
  return next_.full;
}

void IkSolver::sort() {
  // Sorted on a grid, so that rounding rarely changes the order. The angles -pi and pi count as
  // equal.
  const ToolChain& chain = start_system_->chain();
  const auto place = [&](const Six<double>& y, int i) {
    const double y_i = y[static_cast<std::size_t>(i)];
    const bool wraps = chain.turns(i) && y_i < kEqual - std::numbers::pi;
    return std::round((wraps ? std::numbers::pi : y_i) / kEqual);
  };
  std::sort(node_.real.begin(), node_.real.end(), [&](const Six<double>& a, const Six<double>& b) {
    for (int i = 0; i < chain.unknowns(); ++i) {
      if (place(a, i) != place(b, i)) return place(a, i) < place(b, i);
    }
    return false;
  });
}

}  // namespace maxwrench
