#include "lib/scenario/scenario_facets.h"

#include <cmath>

namespace maxwrench {
namespace {

/// A row with a slope below this share of |J'c| counts as parallel to beta.
constexpr double kFlat = 1e-12;
/// The violation of a parallel row [N, N m] that rounding may cause, relative to its value.
constexpr double kRowRounding = 1e-9;

}  // namespace

bool ScenarioFacets::supports(const Problem& problem) {
  return problem.robot.actuation.has_facets && problem.contact_columns() == 0;
}

ScenarioFacets::ScenarioFacets(const Problem& problem)
    : problem_(problem),
      set_(problem.robot.actuation),
      pairs_(set_.facet_pairs()),
      wrenches_(problem.scenarios.wrenches.size()),
      margins_(problem),
      slope_(pairs_),
      widening_(pairs_),
      ends_(2 * pairs_),
      tau_(set_.dimension()) {
  const ScenarioList& list = problem.scenarios;
  for (const ScenarioLimits& limits : list.limits) {
    limits_.emplace_back(2 * pairs_);
    limits_.back() << limits.actuation.b_max.array(), -limits.actuation.b_min.array();
  }
  for (Wrench& wrench : wrenches_) {
    wrench.inverse.setZero(2 * pairs_);
    wrench.parallel.reserve(static_cast<std::size_t>(2 * pairs_));
  }
  if (list.ball) ball_.resize(pairs_, list.ball->E.cols());
}

/// Sets the slopes of a wrench, and by how much the ball widens them.
void ScenarioFacets::set_slopes(ScenarioForces& at, int i) {
  const ScenarioList& list = problem_.scenarios;
  at.exert(at.wrench(i), tau_);
  size_ = tau_.norm();
  project(set_.N, tau_, slope_);
  widening_.setZero();
  if (list.ball && !list.wrenches[static_cast<std::size_t>(i)].hold) {
    for (Eigen::Index axis = 0; axis < ball_.cols(); ++axis) {
      at.exert(at.ball_axis(axis), tau_);
      size_ += tau_.norm();
      project(set_.N, tau_, ball_.col(axis));
      widening_ += ball_.col(axis).square();
    }
    widening_ = widening_.sqrt();
  }
}

void ScenarioFacets::set_wrench(ScenarioForces& at, int i) {
  set_slopes(at, i);
  Wrench& wrench = wrenches_[static_cast<std::size_t>(i)];
  wrench.inverse << widening_ + slope_, widening_ - slope_;
  wrench.parallel.clear();
  for (Eigen::Index row = 0; row < 2 * pairs_; ++row) {
    double& slope = wrench.inverse[row];
    if (std::abs(slope) > kFlat * size_) {
      slope = 1 / slope;
    } else {
      slope = 0;
      wrench.parallel.push_back(static_cast<int>(row));
    }
  }
}

bool ScenarioFacets::misses(const Eigen::ArrayXd& limits, const Wrench& wrench, Eigen::Index& row) {
  const auto holds = [&](Eigen::Index each) {
    const double margin = margins_.values()[each];
    return limits[each] + margin >= -kRowRounding * (1 + std::abs(margin));
  };
  for (const int each : wrench.parallel) {
    bool held = holds(each);
    while (!held && margins_.refine(each)) held = holds(each);
    if (held) continue;
    row = each;
    return true;
  }
  return false;
}

/// Fills a choice with the scenario of a row: the cases of the loads that are worst for it.
bool ScenarioFacets::choose(ScenarioForces& at, const End& end, ScenarioChoice& choice) {
  if (end.wrench < 0) return false;
  const Eigen::Index pair = end.row % pairs_;
  const double side = end.row < pairs_ ? 1 : -1;
  choice.wrench = end.wrench;
  choice.limits = end.limits;
  choice.c = at.wrench(end.wrench);
  const ScenarioList& list = problem_.scenarios;
  if (list.ball && !list.wrenches[static_cast<std::size_t>(end.wrench)].hold) {
    const double length = ball_.row(pair).matrix().norm();
    for (Eigen::Index axis = 0; length > 0 && axis < ball_.cols(); ++axis) {
      choice.c += at.ball_axis(axis) * (side * ball_(pair, axis) / length);
    }
  }
  margins_.choose(end.row, choice);
  return true;
}

void ScenarioFacets::fill_rows(ScenarioForces& at, Eigen::VectorXd& load, Eigen::VectorXd& slope) {
  margins_.set(at);
  margins_.refine_all();
  const auto wrenches = static_cast<Eigen::Index>(wrenches_.size());
  load = -margins_.values().matrix().replicate(wrenches, 1);
  slope.resize(load.size());
  for (Eigen::Index i = 0; i < wrenches; ++i) {
    set_slopes(at, static_cast<int>(i));
    slope.segment(2 * pairs_ * i, pairs_) = widening_ + slope_;
    slope.segment(2 * pairs_ * i + pairs_, pairs_) = widening_ - slope_;
  }
}

void ScenarioFacets::worst(ScenarioForces& at, int wrench, Eigen::Index row,
                           ScenarioChoice& choice) {
  choose(at, {wrench, 0, row}, choice);
}

void ScenarioFacets::scan(ScenarioForces& at) {
  margins_.set(at);
  high = kInfinity;
  low = problem_.scenarios.non_negative ? 0 : -kInfinity;
  missed = false;
  high_end_ = low_end_ = {};
  for (int i = 0; i < static_cast<int>(wrenches_.size()); ++i) {
    set_wrench(at, i);
    for (int l = 0; l < static_cast<int>(limits_.size()); ++l) {
      if (!scan_high(i, l)) {
        missed = true;
        return;
      }
      if (margins_.exact()) scan_low(i, l);
    }
  }
  if (margins_.exact()) return;
  for (int i = 0; i < static_cast<int>(wrenches_.size()); ++i) {
    for (int l = 0; l < static_cast<int>(limits_.size()); ++l) scan_low(i, l);
  }
}

/// Writes the ends of the rows whose slopes have a sign; of the others `none`.
void ScenarioFacets::fill_ends(const Wrench& rows, const Eigen::ArrayXd& limits, double sign,
                               double none) {
  const Eigen::ArrayXd& margins = margins_.values();
  for (Eigen::Index i = 0; i < ends_.size(); ++i) {
    const double end = (limits[i] + margins[i]) * rows.inverse[i];
    ends_[i] = sign * rows.inverse[i] > 0 ? end : none;  // by value: without a branch
  }
}

Eigen::Index ScenarioFacets::row_of(double end) const {
  Eigen::Index row = 0;
  while (ends_[row] != end) ++row;
  return row;
}

/// Refines a row and its end; false if they are exact already.
bool ScenarioFacets::refine_end(const Wrench& rows, const Eigen::ArrayXd& limits,
                                Eigen::Index row) {
  if (!margins_.refine(row)) return false;
  ends_[row] = (limits[row] + margins_.values()[row]) * rows.inverse[row];
  return true;
}

/// Lowers `high` to that of one wrench with one set of limits; false if a row is missed.
bool ScenarioFacets::scan_high(int wrench, int limits) {
  const Wrench& rows = wrenches_[static_cast<std::size_t>(wrench)];
  const Eigen::ArrayXd& bounds = limits_[static_cast<std::size_t>(limits)];
  Eigen::Index missed_row = 0;
  if (misses(bounds, rows, missed_row)) {
    low_end_ = {wrench, limits, missed_row};
    return false;
  }
  fill_ends(rows, bounds, 1, kInfinity);
  for (double end = ends_.minCoeff(); end < high; end = ends_.minCoeff()) {
    const Eigen::Index row = row_of(end);
    if (refine_end(rows, bounds, row)) continue;
    high = end;
    high_end_ = {wrench, limits, row};
    high_inverse_ = rows.inverse[row];
  }
  return true;
}

/// Raises `low` likewise. A bound that is not above `high` is enough.
void ScenarioFacets::scan_low(int wrench, int limits) {
  const Wrench& rows = wrenches_[static_cast<std::size_t>(wrench)];
  const Eigen::ArrayXd& bounds = limits_[static_cast<std::size_t>(limits)];
  fill_ends(rows, bounds, -1, -kInfinity);
  for (double end = ends_.maxCoeff(); end > low; end = ends_.maxCoeff()) {
    const Eigen::Index row = row_of(end);
    if (end > high && refine_end(rows, bounds, row)) continue;
    low = end;
    low_end_ = {wrench, limits, row};
  }
}

bool ScenarioFacets::high_scenario(ScenarioForces& at, ScenarioChoice& choice) {
  return choose(at, high_end_, choice);
}

bool ScenarioFacets::low_scenario(ScenarioForces& at, ScenarioChoice& choice) {
  return choose(at, low_end_, choice);
}

void ScenarioFacets::fill_slope(Eigen::VectorXd& lambda) const {
  const double sign = high_end_.row < pairs_ ? -1 : 1;
  lambda = set_.N.col(high_end_.row % pairs_) * (sign * high_inverse_);
}

}  // namespace maxwrench
