#include "solvers/search/mpc_window.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

// Shorter than with `SlpRun`: a horizon is planned again at the next knot.
constexpr double kMpcRadius = 0.1, kMpcSmallestRadius = 1e-6;  // rad or m
constexpr double kMpcConverged = 1e-7;                         // predicted, relative to 1 + |f|

}  // namespace

MpcWindow::MpcWindow(const InstantSource& source, const Problem& problem, int first, int last,
                     InstantCount& count)
    : problem_(problem),
      count_(count),
      window_(source.make_window(make_spline_window(*problem.motion, first, last))),
      step_(problem.redundancy()) {
  for (Eigen::Index j = 0; j < step_.size(); ++j) {
    const auto joint = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
    step_[j] = problem.robot.joints[joint].velocity_max * window_->maps().dt;
  }
}

/// An evaluation or a linear program of the horizon.
bool MpcWindow::pay() {
  const int instants = window_->maps().instants();
  stopped_ = stopped_ || !count_.has(instants);
  if (!stopped_) count_.spend(instants);
  return !stopped_;
}

double MpcWindow::evaluate(const Eigen::MatrixXd& P) {
  if (!pay()) return -kInfinity;
  const double value = window_->evaluate(P);
  return value > -kInfinity && window_->collides() ? -kInfinity : value;
}

void MpcWindow::set(const Eigen::MatrixXd& P) {
  P_ = P;
  value_ = evaluate(P);
}

void MpcWindow::offer(const Eigen::MatrixXd& P) {
  const double value = evaluate(P);
  if (!(value > value_)) return;
  P_ = P;
  value_ = value;
}

void MpcWindow::optimise(int steps) {
  const Eigen::Index free = P_.rows() - given();
  if (free == 0 || value_ == -kInfinity) return;
  TrustRegion trust(kMpcRadius);
  if (evaluate(P_) == -kInfinity) return;
  bool coupled = window_->coupled();
  TrajectoryProgram* program = &window_->linearize();
  const TrajectorySolution& solution = solver_.solution();
  for (int i = 0; i < steps && trust.radius() > kMpcSmallestRadius; ++i) {
    if (!pay()) return;
    set_bounds(*program, trust.radius());
    set_rows(*program, trust.radius());
    if (!solver_.solve(*program, coupled)) return;
    const double predicted = solution.value - solution.price - value_;
    if (!(predicted > kMpcConverged * (1 + std::abs(value_)))) return;
    Eigen::MatrixXd trial = P_;
    trial.bottomRows(free) += unstacked(solution.y, free);
    keep_limits(trial);
    move_apart(trial);
    const double value = evaluate(trial);
    if (value > -kInfinity) coupled = window_->coupled();
    const double size = solution.y.lpNorm<Eigen::Infinity>();
    if (!trust.judge(value - value_, predicted, size)) continue;
    P_ = trial;
    value_ = value;
    program = &window_->linearize();
  }
}

void MpcWindow::keep_limits(Eigen::MatrixXd& P) const {
  for (Eigen::Index i = given(); i < P.rows(); ++i) {
    P.row(i) = P.row(i)
                   .cwiseMax(problem_.theta_r_min.transpose())
                   .cwiseMin(problem_.theta_r_max.transpose());
  }
}

/// Moves bodies that collide at knots apart, by Newton's method along the gradients of their
/// clearance by the control points that are not given.
void MpcWindow::move_apart(Eigen::MatrixXd& P) {
  const Eigen::Index free = P.rows() - given();
  for (int round = 0; round < kApartRounds; ++round) {
    const std::vector<NearPair>& near = window_->near_pairs(P, 0);
    if (near.empty()) return;
    for (const NearPair& pair : near) {
      const Eigen::RowVectorXd weights = window_->maps().P.row(pair.knot).tail(free);
      const double squared = weights.squaredNorm() * pair.gradient.squaredNorm();
      if (!(squared > 0)) continue;
      P.bottomRows(free) +=
          (kSpare - pair.clearance) / squared * weights.transpose() * pair.gradient.transpose();
    }
    keep_limits(P);
  }
}

void MpcWindow::set_bounds(TrajectoryProgram& program, double radius) {
  const Eigen::Index free = P_.rows() - given();
  const Eigen::VectorXd at = stacked(P_.bottomRows(free));
  program.y_min = (problem_.theta_r_min.replicate(free, 1) - at).cwiseMax(-radius);
  program.y_max = (problem_.theta_r_max.replicate(free, 1) - at).cwiseMin(radius);
}

void MpcWindow::set_rows(TrajectoryProgram& program, double radius) {
  const Eigen::Index r = problem_.redundancy(), before = given();
  rows_.clear();
  for (Eigen::Index i = std::max<Eigen::Index>(before, 1); i < P_.rows(); ++i) {
    for (Eigen::Index j = 0; j < r; ++j) {
      if (step_[j] == kInfinity) continue;
      const double at = P_(i, j) - P_(i - 1, j);
      rows_.add((i - before) * r + j, 1);
      if (i > before) rows_.add((i - before - 1) * r + j, -1);
      rows_.end_row(-step_[j] - at, step_[j] - at);
    }
  }
  const DependentRows& dependent = window_->dependent_rows();
  rows_.add(dependent.R, dependent.r_min - dependent.at, dependent.r_max - dependent.at);
  for (const NearPair& pair : window_->near_pairs(P_, kNearing * radius)) {
    for (Eigen::Index i = before; i < P_.rows(); ++i) {
      const double weight = window_->maps().P(pair.knot, i);
      for (Eigen::Index j = 0; weight != 0 && j < r; ++j) {
        rows_.add((i - before) * r + j, weight * pair.gradient[j]);
      }
    }
    rows_.end_row(-pair.clearance, kInfinity);
  }
  rows_.move_to(program, (P_.rows() - before) * r);
}

}  // namespace maxwrench
