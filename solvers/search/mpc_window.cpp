#include "solvers/search/mpc_window.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/problem.h"
#include "solvers/trajectory/makers.h"

namespace maxwrench {
namespace {

// Like those of `SlpRun`, which goes on longer: a horizon is planned again at the next knot.
constexpr double kMpcRadius = 0.1, kMpcSmallestRadius = 1e-6;  // rad or m
constexpr double kMpcAccept = 0.05, kMpcShrink = 0.25, kMpcGrow = 0.7;
constexpr double kMpcConverged = 1e-7;  // predicted, relative to 1 + |f|
constexpr double kMpcTolerance = 1e-6;  // of a linear program, whose answer is a step
constexpr double kMpcNearing = 2;       // m per radius: how much nearer bodies may come in a step
constexpr double kMpcSpare = 1e-9;      // m, added to the margin when bodies are moved apart
constexpr int kMpcApartRounds = 5;

}  // namespace

MpcWindow::MpcWindow(const InstantSource& source, const Problem& problem, int first, int last,
                     InstantCount& count)
    : problem_(problem),
      count_(count),
      window_(source.make_window(make_spline_window(*problem.motion, first, last))),
      step_(problem.redundancy()),
      solver_(make_trajectory_ipm(kMpcTolerance)) {
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
  double radius = kMpcRadius;
  if (evaluate(P_) == -kInfinity) return;
  bool coupled = window_->coupled();
  TrajectoryProgram* program = &window_->linearize();
  for (int i = 0; i < steps && radius > kMpcSmallestRadius; ++i) {
    if (!pay() || !solve(radius, coupled, *program)) return;
    const double predicted = solution_.value - solution_.price - value_;
    if (!(predicted > kMpcConverged * (1 + std::abs(value_)))) return;
    Eigen::MatrixXd trial = P_;
    trial.bottomRows(free) += unstacked(solution_.y, free);
    keep_limits(trial);
    move_apart(trial);
    const double size = solution_.y.lpNorm<Eigen::Infinity>();
    const double value = evaluate(trial), risen = value - value_;
    if (!(risen >= kMpcShrink * predicted)) {
      radius = 0.4 * size;
    } else if (risen > kMpcGrow * predicted && size > 0.9 * radius) {
      radius *= 2;
    }
    if (value > -kInfinity) coupled = window_->coupled();
    if (!(risen >= kMpcAccept * predicted)) continue;
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
  for (int round = 0; round < kMpcApartRounds; ++round) {
    const std::vector<NearPair>& near = window_->near_pairs(P, 0);
    if (near.empty()) return;
    for (const NearPair& pair : near) {
      const Eigen::RowVectorXd weights = window_->maps().P.row(pair.knot).tail(free);
      const double squared = weights.squaredNorm() * pair.gradient.squaredNorm();
      if (!(squared > 0)) continue;
      P.bottomRows(free) +=
          (kMpcSpare - pair.clearance) / squared * weights.transpose() * pair.gradient.transpose();
    }
    keep_limits(P);
  }
}

/// Solves for a step from the plan. `coupled`: effort rates matter there.
bool MpcWindow::solve(double radius, bool coupled, TrajectoryProgram& program) {
  set_bounds(program, radius);
  set_rows(program, radius);
  solution_.price = 0;
  if (!coupled && BorderedFacets::suits(program) && facets_.solve(program, solution_)) return true;
  solver_->solve(program, solution_);
  return solution_.status == Status::kOptimal;
}

void MpcWindow::set_bounds(TrajectoryProgram& program, double radius) {
  const Eigen::Index free = P_.rows() - given();
  const Eigen::VectorXd at = stacked(P_.bottomRows(free));
  program.y_min = (problem_.theta_r_min.replicate(free, 1) - at).cwiseMax(-radius);
  program.y_max = (problem_.theta_r_max.replicate(free, 1) - at).cwiseMin(radius);
}

/// A violation by rounding must not make the program infeasible.
void MpcWindow::add_row(double low, double high) {
  low_.push_back(std::min(low, 0.0));
  high_.push_back(std::max(high, 0.0));
}

void MpcWindow::set_rows(TrajectoryProgram& program, double radius) {
  const Eigen::Index r = problem_.redundancy(), before = given();
  entries_.clear();
  low_.clear();
  high_.clear();
  for (Eigen::Index i = std::max<Eigen::Index>(before, 1); i < P_.rows(); ++i) {
    for (Eigen::Index j = 0; j < r; ++j) {
      if (step_[j] == kInfinity) continue;
      const double at = P_(i, j) - P_(i - 1, j);
      entries_.emplace_back(low_.size(), (i - before) * r + j, 1);
      if (i > before) entries_.emplace_back(low_.size(), (i - before - 1) * r + j, -1);
      add_row(-step_[j] - at, step_[j] - at);
    }
  }
  const DependentRows& dependent = window_->dependent_rows();
  const auto first = static_cast<int>(low_.size());
  for (int column = 0; column < dependent.R.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(dependent.R, column); it; ++it) {
      entries_.emplace_back(first + it.row(), it.col(), it.value());
    }
  }
  for (Eigen::Index i = 0; i < dependent.at.size(); ++i) {
    add_row(dependent.r_min[i] - dependent.at[i], dependent.r_max[i] - dependent.at[i]);
  }
  for (const NearPair& pair : window_->near_pairs(P_, kMpcNearing * radius)) {
    for (Eigen::Index i = before; i < P_.rows(); ++i) {
      const double weight = window_->maps().P(pair.knot, i);
      for (Eigen::Index j = 0; weight != 0 && j < r; ++j) {
        entries_.emplace_back(low_.size(), (i - before) * r + j, weight * pair.gradient[j]);
      }
    }
    add_row(-pair.clearance, kInfinity);
  }
  const auto count = static_cast<Eigen::Index>(low_.size());
  program.r_min = Eigen::Map<Eigen::VectorXd>(low_.data(), count);
  program.r_max = Eigen::Map<Eigen::VectorXd>(high_.data(), count);
  program.R.resize(count, (P_.rows() - before) * r);
  program.R.setFromTriplets(entries_.begin(), entries_.end());
}

}  // namespace maxwrench
