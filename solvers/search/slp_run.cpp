#include "solvers/search/slp_run.h"

#include <algorithm>
#include <cmath>

#include "solvers/search/factor_program.h"
#include "solvers/trajectory/makers.h"
#if MAXWRENCH_WITH_NLOPT
#include "solvers/search/row_sqp.h"
#endif

namespace maxwrench {
namespace {

constexpr double kFirstRadius = 0.1;  // rad or m
constexpr double kSmallestRadius = 1e-7;
constexpr double kAccept = 0.05, kShrink = 0.25, kGrow = 0.7;  // shares of the predicted rise
constexpr double kNearing = 2;           // m per radius: how much nearer bodies may come in a step
constexpr double kSpare = 1e-9;          // m, added to the margin when knots are moved apart
constexpr int kApartRounds = 5;          // rounds of moving knots apart
constexpr double kStepTolerance = 1e-6;  // of a linear program, whose answer is used only as a step
constexpr double kConverged = 1e-9;      // predicted, relative to 1 + |f|
[[maybe_unused]] constexpr int kPolishPoints = 400;

}  // namespace

SlpRun::SlpRun(const TrajectoryObjective& objective, Candidate start, SearchRun& run, bool alike,
               bool guides)
    : objective_(objective.copy(objective.counts())),
      trajectories_(objective_->trajectories()),
      run_(run),
      solver_(make_trajectory_ipm(kStepTolerance)),
      at_(std::move(start)),
      best_(at_),
      guides_(guides || objective.counts() != TrajectoryValue::kAtInstants),
      radius_(kFirstRadius),
      reach_(trajectories_.rows().R.cwiseAbs() * Eigen::VectorXd::Ones(at_.theta_r.size())) {
  if (!alike) return;
  const Eigen::Index r = at_.theta_r.size() / trajectories_.knots();
  shared_ = Eigen::MatrixXd::Identity(r, r).replicate(trajectories_.knots(), 1);
}

TrajectoryProgram* SlpRun::linearize() {
  TrajectoryProgram& program = trajectories_.linearize();
  if (shared_.size() > 0) {
    for (Eigen::MatrixXd& G : program.G) G = G * shared_;
  }
  return &program;
}

void SlpRun::optimise(long evaluations) {
  const auto left = [&] { return evaluations - found_.trace.evaluations(); };
  while (!done_ && left() >= 3 && !run_.ended()) {
    if (program_ == nullptr) {
      // The program is linearised about the efforts of this evaluation.
      done_ = evaluate(at_.theta_r) == -kInfinity;
      if (done_) return;
      program_ = linearize();
    }
    if (run_.ended()) return;
    if (try_step()) program_ = linearize();
    done_ = done_ || !(radius_ > kSmallestRadius);
  }
}

void SlpRun::polish([[maybe_unused]] long evaluations) {
#if MAXWRENCH_WITH_NLOPT
  const long left = std::min<long>(kPolishPoints, evaluations - found_.trace.evaluations() - 1);
  if (left < 3 || run_.ended() || best_.value == -kInfinity || shared_.size() > 0) return;
  if (!FactorProgram::supports(trajectories_, trajectories_.dependent_rows().at.size() > 0)) return;
  FactorProgram program(trajectories_, objective_->lower(), objective_->upper(), best_.theta_r,
                        best_.value, left);
  const RowEnd end = solve_rows_by_slsqp(program, kPolishPoints);
  for (long point = 0; point < program.looked(); ++point) note(best_.theta_r, -kInfinity);
  found_.calls.push_back({"slp", "sqp", program.looked()});
  const Eigen::VectorXd x = inside(program.knots(end.y));
  program_ = nullptr;
  const double value = evaluate(x);
  if (value > at_.value) at_ = {x, value};
#endif
}

/// Returns whether the knots moved; then `trajectories_` is at the new point.
bool SlpRun::try_step() {
  if (!solve()) {
    done_ = true;
    return false;
  }
  const double predicted = solution_.value - solution_.price - at_.value;
  if (!(predicted > kConverged * (1 + std::abs(at_.value)))) {
    done_ = true;
    return false;
  }
  const bool alike = shared_.size() > 0;
  const Eigen::VectorXd step = alike ? shared_ * solution_.y : solution_.y;
  Eigen::VectorXd trial = inside(at_.theta_r + step);
  if (!alike) trial = apart(std::move(trial));
  const double size = solution_.y.lpNorm<Eigen::Infinity>();
  const double value = evaluate(trial), risen = value - at_.value;
  if (!(risen >= kShrink * predicted)) {
    radius_ = 0.4 * size;
  } else if (risen > kGrow * predicted && size > 0.9 * radius_) {
    radius_ *= 2;
  }
  if (!(risen >= kAccept * predicted)) return false;
  at_ = {trial, value};
  return true;
}

/// The value at the instants. Once the run has ended, there is none, at no cost.
double SlpRun::evaluate(const Eigen::VectorXd& x) {
  if (run_.ended()) return -kInfinity;
  double value = trajectories_.evaluate_elastic(unstacked(x, trajectories_.knots()), nullptr);
  if (std::isnan(value)) value = -kInfinity;
  note(x, guides_ ? -kInfinity : value);
  if (value > -kInfinity) coupled_ = trajectories_.coupled();
  if (value > best_.value) best_ = {x, value};
  return value;
}

/// Records an evaluation, of the objective or of another value.
void SlpRun::note(const Eigen::VectorXd& x, double value) {
  found_.trace.add(value);
  run_.show(value);
  if (value > found_.best.value) found_.best = {x, value};
}

Eigen::VectorXd SlpRun::inside(const Eigen::VectorXd& x) const {
  return x.cwiseMax(objective_->lower()).cwiseMin(objective_->upper());
}

double SlpRun::worth(const Candidate& trajectory) {
  if (objective_->counts() == TrajectoryValue::kAtInstants) return trajectory.value;
  done_ = true;
  const double worth = objective_->evaluate_throughout(trajectory.theta_r, trajectory.value);
  for (int before = 1; before < kJudgement; ++before) note(trajectory.theta_r, -kInfinity);
  note(trajectory.theta_r, worth);
  return worth;
}

/// Sets the radius, limited by the distance to the bounds: for a step that knots share, that of the
/// nearest knot.
void SlpRun::set_bounds() {
  const Eigen::Index size = at_.theta_r.size();
  const Eigen::Index moved = shared_.size() > 0 ? shared_.cols() : size;
  const Eigen::MatrixXd low = (objective_->lower() - at_.theta_r).reshaped(moved, size / moved);
  const Eigen::MatrixXd high = (objective_->upper() - at_.theta_r).reshaped(moved, size / moved);
  program_->y_min = low.rowwise().maxCoeff().cwiseMax(-radius_);
  program_->y_max = high.rowwise().minCoeff().cwiseMin(radius_);
}

/// Solves for a step. Returns whether there is an answer.
bool SlpRun::solve() {
  set_bounds();
  set_rows();
  note(at_.theta_r, -kInfinity);
  solution_.price = 0;
  const bool by_facets =
      !coupled_ && BorderedFacets::suits(*program_) && uncoupled_.solve(*program_, solution_);
  found_.calls.push_back({"slp", by_facets ? "facets" : "ipm", 1});
  if (by_facets) return true;
  solver_->solve(*program_, solution_);
  return solution_.status == Status::kOptimal;
}

/// Adds low <= R y <= high without the rows that no step of this radius reaches. `reach` sums the
/// magnitudes of each row.
void SlpRun::add_rows(const Eigen::SparseMatrix<double>& R, const Eigen::VectorXd& reach,
                      const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  row_of_.assign(static_cast<std::size_t>(R.rows()), -1);
  for (Eigen::Index i = 0; i < R.rows(); ++i) {
    if (low[i] < -radius_ * reach[i] && high[i] > radius_ * reach[i]) continue;
    row_of_[static_cast<std::size_t>(i)] = static_cast<int>(low_.size());
    // A violation by rounding must not make the program infeasible.
    low_.push_back(std::min(low[i], 0.0));
    high_.push_back(std::max(high[i], 0.0));
  }
  for (int column = 0; column < R.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(R, column); it; ++it) {
      const int row = row_of_[static_cast<std::size_t>(it.row())];
      if (row >= 0) entries_.emplace_back(row, it.col(), it.value());
    }
  }
}

/// Adds the limits of the knots; to first order, those of dependent joints; and the condition that
/// no pair of bodies is nearer than its margin.
void SlpRun::set_rows() {
  const KnotRows& rows = trajectories_.rows();
  const DependentRows& following = trajectories_.dependent_rows();
  const Eigen::VectorXd& x = at_.theta_r;
  const Eigen::Index r = x.size() / trajectories_.knots();
  const Eigen::VectorXd at = rows.R * x, ones = Eigen::VectorXd::Ones(x.size());
  entries_.clear();
  low_.clear();
  high_.clear();
  add_rows(rows.R, reach_, rows.r_min - at, rows.r_max - at);
  add_rows(following.R, following.R.cwiseAbs() * ones, following.r_min - following.at,
           following.r_max - following.at);
  for (const NearPair& pair :
       trajectories_.near_pairs(unstacked(x, trajectories_.knots()), kNearing * radius_)) {
    for (Eigen::Index j = 0; j < r; ++j) {
      entries_.emplace_back(low_.size(), pair.knot * r + j, pair.gradient[j]);
    }
    low_.push_back(std::min(0.0, -pair.clearance));
    high_.push_back(kInfinity);
  }
  const auto count = static_cast<Eigen::Index>(low_.size());
  program_->r_min = Eigen::Map<Eigen::VectorXd>(low_.data(), count);
  program_->r_max = Eigen::Map<Eigen::VectorXd>(high_.data(), count);
  program_->R.resize(count, x.size());
  program_->R.setFromTriplets(entries_.begin(), entries_.end());
  if (shared_.size() > 0) program_->R = (program_->R * shared_).sparseView();
}

/// Moves colliding knots of x apart by Newton's method along the gradients of the clearance.
Eigen::VectorXd SlpRun::apart(Eigen::VectorXd x) {
  const Eigen::Index r = x.size() / trajectories_.knots();
  for (int round = 0; round < kApartRounds; ++round) {
    const auto& near = trajectories_.near_pairs(unstacked(x, trajectories_.knots()), 0);
    if (near.empty()) break;
    for (const NearPair& pair : near) {
      const double squared = pair.gradient.squaredNorm();
      if (!(squared > 0)) continue;
      x.segment(pair.knot * r, r) += (kSpare - pair.clearance) / squared * pair.gradient;
    }
    x = inside(x);
  }
  return x;
}

}  // namespace maxwrench
