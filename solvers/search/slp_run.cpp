#include "solvers/search/slp_run.h"

#include <algorithm>
#include <cmath>

#include "solvers/search/factor_program.h"
#if MAXWRENCH_WITH_NLOPT
#include "solvers/search/row_sqp.h"
#endif

namespace maxwrench {
namespace {

constexpr double kFirstRadius = 0.1;  // rad or m
constexpr double kSmallestRadius = 1e-7;
constexpr double kConverged = 1e-9;  // predicted, relative to 1 + |f|
[[maybe_unused]] constexpr int kPolishPoints = 400;

/// The weight of each knot in theta_r where two bodies are near each other.
double weight(const NearPair& pair, Eigen::Index knot) {
  return pair.weights.size() > 0 ? pair.weights[knot] : knot == pair.knot ? 1 : 0;
}

}  // namespace

Eigen::VectorXd moved_apart(TrajectoryEvaluator& trajectories, const Objective& objective,
                            Eigen::VectorXd x) {
  const Eigen::Index r = x.size() / trajectories.knots();
  for (int round = 0; round < kApartRounds; ++round) {
    const Eigen::VectorXd before = x;
    const auto& near = trajectories.near_pairs(unstacked(x, trajectories.knots()), 0);
    if (near.empty()) break;
    for (const NearPair& pair : near) {
      if (pair.weights.size() == 0) {
        const double squared = pair.gradient.squaredNorm();
        if (!(squared > 0)) continue;
        x.segment(pair.knot * r, r) += (kSpare - pair.clearance) / squared * pair.gradient;
        continue;
      }
      const Eigen::MatrixXd slopes = pair.gradient * pair.weights.transpose();  // r×k
      const double squared = slopes.squaredNorm();
      const double clearance = pair.clearance + slopes.reshaped().dot(x - before);
      if (squared > 0 && clearance < kSpare) {
        x += (kSpare - clearance) / squared * slopes.reshaped();
      }
    }
    x = x.cwiseMax(objective.lower()).cwiseMin(objective.upper());
  }
  return x;
}

SlpRun::SlpRun(const TrajectoryObjective& objective, Candidate start, SearchRun& run, bool alike,
               bool guides)
    : objective_(objective.copy(objective.counts())),
      trajectories_(objective_->trajectories()),
      run_(run),
      at_(std::move(start)),
      best_(at_),
      guides_(guides || objective.counts() != TrajectoryValue::kAtInstants),
      trust_(kFirstRadius) {
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
    done_ = done_ || !(trust_.radius() > kSmallestRadius);
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
  const TrajectorySolution& solution = solver_.solution();
  const double predicted = solution.value - solution.price - at_.value;
  if (!(predicted > kConverged * (1 + std::abs(at_.value)))) {
    done_ = true;
    return false;
  }
  const bool alike = shared_.size() > 0;
  const Eigen::VectorXd step = alike ? shared_ * solution.y : solution.y;
  Eigen::VectorXd trial = inside(at_.theta_r + step);
  if (!alike) trial = moved_apart(trajectories_, *objective_, std::move(trial));
  const double value = evaluate(trial);
  const double size = solution.y.lpNorm<Eigen::Infinity>();
  if (!trust_.judge(value - at_.value, predicted, size)) return false;
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
  program_->y_min = low.rowwise().maxCoeff().cwiseMax(-trust_.radius());
  program_->y_max = high.rowwise().minCoeff().cwiseMin(trust_.radius());
}

/// Solves for a step. Returns whether there is an answer.
bool SlpRun::solve() {
  set_bounds();
  set_rows();
  note(at_.theta_r, -kInfinity);
  const bool solved = solver_.solve(*program_, coupled_);
  found_.calls.push_back({"slp", solver_.by_facets() ? "facets" : "ipm", 1});
  return solved;
}

/// Adds the limits of the knots; to first order, those of dependent joints; and the condition that
/// no pair of bodies is nearer than its margin.
void SlpRun::set_rows() {
  const KnotRows& rows = trajectories_.rows();
  const DependentRows& following = trajectories_.dependent_rows();
  const Eigen::VectorXd& x = at_.theta_r;
  const Eigen::Index r = x.size() / trajectories_.knots();
  const Eigen::VectorXd at = rows.R * x;
  rows_.clear();
  rows_.add(rows.R, rows.r_min - at, rows.r_max - at, trust_.radius());
  rows_.add(following.R, following.r_min - following.at, following.r_max - following.at,
            trust_.radius());
  for (const NearPair& pair :
       trajectories_.near_pairs(unstacked(x, trajectories_.knots()), kNearing * trust_.radius())) {
    for (Eigen::Index knot = 0; knot < trajectories_.knots(); ++knot) {
      const double share = weight(pair, knot);
      for (Eigen::Index j = 0; share != 0 && j < r; ++j) {
        rows_.add(knot * r + j, share * pair.gradient[j]);
      }
    }
    rows_.end_row(-pair.clearance, kInfinity);
  }
  rows_.move_to(*program_, x.size());
  if (shared_.size() > 0) program_->R = (program_->R * shared_).sparseView();
}

}  // namespace maxwrench
