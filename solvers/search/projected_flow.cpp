#include "solvers/search/projected_flow.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

constexpr int kClimbSteps = 200;
constexpr double kClimbReach = 0.1;  // rad or m, of one of these steps
constexpr int kHalvings = 8;         // of a step that does not raise the capability enough
constexpr double kEnough = 1e-4;     // Armijo: the share of the rise that the gradient promises

}  // namespace

ProjectedFlow::ProjectedFlow(const InstantSource& source, const Problem& problem,
                             InstantCount& count)
    : problem_(problem), count_(count), per_interval_(problem.motion->instants_per_interval) {
  const MotionTask& task = *problem.motion;
  const int intervals = per_interval_ * (task.k - 1);
  step_time_ = task.T / intervals;
  for (int n = 0; n <= intervals; ++n) {
    instants_.push_back(
        source.make_window(make_resting_instant(task, n == intervals ? task.T : n * step_time_)));
  }
}

double ProjectedFlow::value(int instant, const Eigen::VectorXd& theta_r) {
  stopped_ = stopped_ || !count_.has(1);
  if (stopped_) return -kInfinity;
  count_.spend(1);
  WindowEvaluator& at = *instants_[static_cast<std::size_t>(instant)];
  const double value = at.evaluate(theta_r.transpose());
  return value > -kInfinity && at.collides() ? -kInfinity : value;
}

Eigen::VectorXd ProjectedFlow::climb(Eigen::VectorXd theta_r) {
  const Eigen::VectorXd reach = Eigen::VectorXd::Constant(theta_r.size(), kClimbReach);
  for (int i = 0; i < kClimbSteps && step(0, reach, false, theta_r); ++i) {
  }
  return theta_r;
}

Eigen::MatrixXd ProjectedFlow::flow(Eigen::VectorXd theta_r) {
  Eigen::MatrixXd P(problem_.motion->k, theta_r.size());
  Eigen::VectorXd reach(theta_r.size());
  for (Eigen::Index j = 0; j < reach.size(); ++j) {
    const auto joint = static_cast<std::size_t>(problem_.redundant[static_cast<std::size_t>(j)]);
    reach[j] = problem_.robot.joints[joint].velocity_max * step_time_;
  }
  for (int n = 0; n < instants(); ++n) {
    if (n % per_interval_ == 0) P.row(n / per_interval_) = theta_r.transpose();
    if (n + 1 < instants()) step(n, reach, true, theta_r);
  }
  return P;
}

/// Moves theta_r by as much as raises f at this instant and each `reach` permits; `in_time`: also
/// the speeds of dependent joints. Returns whether it moved.
bool ProjectedFlow::step(int instant, const Eigen::VectorXd& reach, bool in_time,
                         Eigen::VectorXd& theta_r) {
  const double before = value(instant, theta_r);
  if (before == -kInfinity) return false;
  WindowEvaluator& at = *instants_[static_cast<std::size_t>(instant)];
  at.gradient(gradient_);
  const Eigen::VectorXd g = gradient_.row(0).transpose();
  const Eigen::MatrixXd A_r = at.A_r(0);
  const Eigen::VectorXd v = at.v(0);
  const Eigen::VectorXd way = direction(A_r.transpose() * A_r, g, theta_r);
  double alpha = kInfinity;  // times a duration
  for (Eigen::Index j = 0; j < way.size(); ++j) {
    if (way[j] != 0) alpha = std::min(alpha, reach[j] / std::abs(way[j]));
  }
  if (in_time) alpha = std::min(alpha, step_time_ * share_of_speeds(A_r * way, v));
  if (!std::isfinite(alpha)) return false;
  for (int halving = 0; halving <= kHalvings && !stopped_; ++halving, alpha /= 2) {
    const Eigen::VectorXd trial =
        (theta_r + alpha * way).cwiseMax(problem_.theta_r_min).cwiseMin(problem_.theta_r_max);
    const double promised = g.dot(trial - theta_r);
    if (!(promised > 0) || !(value(instant, trial) > before + kEnough * promised)) continue;
    theta_r = trial;
    return true;
  }
  return false;
}

/// M_FF^-1 g_F, where coordinates at a limit that would leave it are fixed one after the other.
Eigen::VectorXd ProjectedFlow::direction(Eigen::MatrixXd M, Eigen::VectorXd g,
                                         const Eigen::VectorXd& theta_r) const {
  for (Eigen::Index left = g.size(); left >= 0; --left) {
    const Eigen::VectorXd way = M.ldlt().solve(g);
    if (!way.allFinite()) break;
    Eigen::Index worst = -1;
    for (Eigen::Index j = 0; j < g.size(); ++j) {
      const bool leaves = (theta_r[j] <= problem_.theta_r_min[j] && way[j] < 0) ||
                          (theta_r[j] >= problem_.theta_r_max[j] && way[j] > 0);
      if (leaves && (worst < 0 || std::abs(way[j]) > std::abs(way[worst]))) worst = j;
    }
    if (worst < 0) return way;
    M.row(worst).setZero();
    M.col(worst).setZero();
    M(worst, worst) = 1;
    g[worst] = 0;
  }
  return Eigen::VectorXd::Zero(g.size());
}

/// The largest factor of the velocities `added` to v with which no dependent joint is too fast.
double ProjectedFlow::share_of_speeds(const Eigen::VectorXd& added,
                                      const Eigen::VectorXd& v) const {
  const std::size_t axes = problem_.robot.base_axes.size();
  double share = kInfinity;
  for (const int number : problem_.dependent) {
    const auto index = static_cast<std::size_t>(number);
    const auto row = static_cast<Eigen::Index>(axes + index);
    const double limit = problem_.robot.joints[index].velocity_max;
    const double room = limit - std::copysign(1, added[row]) * v[row];
    if (added[row] != 0) share = std::min(share, std::max(room, 0.0) / std::abs(added[row]));
  }
  return share;
}

}  // namespace maxwrench
