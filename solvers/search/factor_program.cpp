#include "solvers/search/factor_program.h"

#include <algorithm>
#include <cmath>

#include "solvers/trajectory/by_facets.h"

namespace maxwrench {
namespace {

/// Limits of s.
constexpr double kLeastUnit = 1e-6, kMostUnit = 1e6;

/// Half the width of a row, or 1 without one.
double half_width(double low, double high) {
  const double half = 0.5 * (high - low);
  return half > 0 && std::isfinite(half) ? half : 1;
}

}  // namespace

bool FactorProgram::supports(const TrajectoryEvaluator& trajectories, bool dependent_joints) {
  const TrajectoryProgram& program = trajectories.program();
  return program.common && !dependent_joints && starts_anywhere(program) &&
         !(program.du_max.array() < kInfinity).any() && !(program.lag.array() > 0).any();
}

FactorProgram::FactorProgram(TrajectoryEvaluator& trajectories, const Eigen::VectorXd& x_min,
                             const Eigen::VectorXd& x_max, const Eigen::VectorXd& x, double t,
                             long points)
    : trajectories_(trajectories), p_(x.size()), points_(points) {
  const TrajectoryProgram& program = trajectories.program();
  const KnotRows& knots = trajectories.rows();
  for (const WrenchProgram& at : program.instants) facets_ += at.actuation->facet_pairs();
  const Eigen::Index rows = facets_ + knots.R.rows();
  row_min_.resize(rows);
  row_max_.resize(rows);
  unit_.resize(rows);
  Eigen::Index row = 0;
  double low = -kInfinity, high = kInfinity;
  for (const WrenchProgram& at : program.instants) {
    const Zonotope& set = *at.actuation;
    for (int j = 0; j < set.facet_pairs(); ++j, ++row) {
      row_min_[row] = set.b_min[j];
      row_max_[row] = set.b_max[j];
    }
    low = std::max(low, at.c_w[0] * at.w_min[0]);
    high = std::min(high, at.c_w[0] * at.w_max[0]);
  }
  row_min_.tail(knots.R.rows()) = knots.r_min;
  row_max_.tail(knots.R.rows()) = knots.r_max;
  for (row = 0; row < rows; ++row) unit_[row] = half_width(row_min_[row], row_max_[row]);
  row_min_ = row_min_.cwiseQuotient(unit_);
  row_max_ = row_max_.cwiseQuotient(unit_);
  w_.assign(program.instants.size(), Eigen::VectorXd(1));
  start_.resize(p_ + 1);
  lower_.resize(p_ + 1);
  upper_.resize(p_ + 1);
  c_y_ = Eigen::VectorXd::Unit(p_ + 1, p_);
  start_ << x, t;
  if (set_rows(start_)) {
    const double steepest = jacobian_.col(p_).head(facets_).lpNorm<Eigen::Infinity>();
    scale_ = std::clamp(std::max(std::abs(t), 1 / steepest), kLeastUnit, kMostUnit);
  }
  start_[p_] = t / scale_;
  lower_ << x_min, low / scale_;
  upper_ << x_max, high / scale_;
}

bool FactorProgram::look(const Eigen::VectorXd& y) {
  if (y_.size() == y.size() && y_ == y) return valid_;
  if (ended() || !y.allFinite()) return false;
  --points_;
  ++looked_;
  y_ = y;
  valid_ = set_rows(y);
  return valid_;
}

/// Sets the rows and their derivatives.
bool FactorProgram::set_rows(const Eigen::VectorXd& y) {
  const double t = y[p_] * scale_;
  const TrajectoryProgram& hard = trajectories_.program();
  for (std::size_t i = 0; i < w_.size(); ++i) w_[i][0] = t / hard.instants[i].c_w[0];
  const TrajectoryProgram& program =
      trajectories_.linearize(unstacked(y.head(p_), trajectories_.knots()), w_);
  const KnotRows& knots = trajectories_.rows();
  rows_.resize(unit_.size());
  jacobian_.setZero(unit_.size(), p_ + 1);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < program.instants.size(); ++i) {
    const WrenchProgram& at = program.instants[i];
    const auto& N = at.actuation->N;
    const Eigen::VectorXd a = at.JtW.col(0) / at.c_w[0];
    rows_.segment(row, N.cols()) = N.transpose() * (at.tau_d + t * a);
    jacobian_.block(row, 0, N.cols(), p_) = -N.transpose() * program.G[i];
    jacobian_.col(p_).segment(row, N.cols()) = scale_ * (N.transpose() * a);
    row += N.cols();
  }
  rows_.tail(knots.R.rows()) = knots.R * y.head(p_);
  jacobian_.bottomLeftCorner(knots.R.rows(), p_) = knots.R;
  rows_ = rows_.cwiseQuotient(unit_);
  jacobian_ = unit_.cwiseInverse().asDiagonal() * jacobian_;
  return rows_.allFinite() && jacobian_.allFinite();
}

}  // namespace maxwrench
