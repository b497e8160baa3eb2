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
    : problem_(problem),
      count_(count),
      at_(source.make_window(make_resting_instant(*problem.motion))),
      intervals_(problem.motion->instants_per_interval * (problem.motion->k - 1)),
      step_time_(problem.motion->T / intervals_) {}

double ProjectedFlow::value(int instant, const Eigen::VectorXd& theta_r) {
  stopped_ = stopped_ || !count_.has(1);
  if (stopped_) return -kInfinity;
  count_.spend(1);
  at_->set_time(instant == intervals_ ? problem_.motion->T : instant * step_time_);
  const double value = at_->evaluate(theta_r.transpose());
  return value > -kInfinity && at_->collides() ? -kInfinity : value;
}

Eigen::VectorXd ProjectedFlow::climb(Eigen::VectorXd theta_r) {
  const Eigen::VectorXd reach = Eigen::VectorXd::Constant(theta_r.size(), kClimbReach);
  std::optional<double> f = value(0, theta_r);
  for (int i = 0; i < kClimbSteps && f; ++i) f = step(0, *f, reach, false, theta_r);
  return theta_r;
}

Eigen::MatrixXd ProjectedFlow::flow(Eigen::VectorXd theta_r) {
  Eigen::MatrixXd P(problem_.motion->k, theta_r.size());
  Eigen::VectorXd reach(theta_r.size());
  for (Eigen::Index j = 0; j < reach.size(); ++j) {
    const auto joint = static_cast<std::size_t>(problem_.redundant[static_cast<std::size_t>(j)]);
    // A joint may be without a limit of speed.
    reach[j] = std::min(problem_.robot.joints[joint].velocity_max * step_time_,
                        problem_.theta_r_max[j] - problem_.theta_r_min[j]);
  }
  const int per_interval = problem_.motion->instants_per_interval;
  for (int n = 0; n <= intervals_; ++n) {
    if (n % per_interval == 0) P.row(n / per_interval) = theta_r.transpose();
    if (n < intervals_) step(n, value(n, theta_r), reach, true, theta_r);
  }
  return P;
}

/// Moves theta_r by as much as raises f at this instant and each `reach` permits; `in_time`: also
/// the speeds of dependent joints. `f` is the value there, which was evaluated last. Returns the
/// value after the step, or none if theta_r does not move.
std::optional<double> ProjectedFlow::step(int instant, double f, const Eigen::VectorXd& reach,
                                          bool in_time, Eigen::VectorXd& theta_r) {
  if (f == -kInfinity) return {};
  at_->gradient(gradient_);
  const Eigen::VectorXd g = gradient_.row(0).transpose();
  const Eigen::MatrixXd A_r = at_->A_r(0);
  const Eigen::VectorXd v = at_->v(0);
  const Eigen::VectorXd way = direction(A_r.transpose() * A_r, g, theta_r);
  double alpha = kInfinity;  // times a duration
  for (Eigen::Index j = 0; j < way.size(); ++j) {
    if (way[j] != 0) alpha = std::min(alpha, reach[j] / std::abs(way[j]));
  }
  if (in_time) alpha = std::min(alpha, step_time_ * share_of_speeds(A_r * way, v));
  if (!std::isfinite(alpha)) return {};
  for (int halving = 0; halving <= kHalvings && !stopped_; ++halving, alpha /= 2) {
    const Eigen::VectorXd trial =
        (theta_r + alpha * way).cwiseMax(problem_.theta_r_min).cwiseMin(problem_.theta_r_max);
    const double promised = g.dot(trial - theta_r);
    if (!(promised > 0)) continue;
    const double risen = value(instant, trial);
    if (!(risen > f + kEnough * promised)) continue;
    theta_r = trial;
    return risen;
  }
  return {};
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
