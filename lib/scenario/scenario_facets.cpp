#include "lib/scenario/scenario_facets.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/scenario/current_load.h"

namespace maxwrench {
namespace {

/// A row with a slope below this share of |J'c| counts as parallel to beta.
constexpr double kFlat = 1e-12;
/// The violation of a parallel row [N, N m] that rounding may cause, relative to its value.
constexpr double kRowRounding = 1e-9;

/// The changes of a case as numbers: mass and moment of each link in turn.
Eigen::VectorXd numbers_of(const LoadCase& load, int links) {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(4 * links);
  for (const LinkLoad& change : load.loads) {
    numbers[4 * change.link] += change.mass;
    numbers.segment<3>(4 * change.link + 1) += change.moment;
  }
  return numbers;
}

LoadCase case_of(const Eigen::VectorXd& numbers) {
  LoadCase load;
  for (int link = 0; 4 * link < numbers.size(); ++link) {
    if (numbers.segment<4>(4 * link).isZero(0)) continue;
    load.loads.push_back({link, numbers[4 * link], numbers.segment<3>(4 * link + 1)});
  }
  return load;
}

}  // namespace

bool ScenarioFacets::supports(const Problem& problem) { return problem.robot.actuation.has_facets; }

ScenarioFacets::ScenarioFacets(const Problem& problem)
    : problem_(problem),
      set_(problem.robot.actuation),
      pairs_(set_.facet_pairs()),
      wrenches_(problem.scenarios.wrenches.size()),
      nominal_(pairs_),
      most_(pairs_),
      least_(pairs_),
      value_(pairs_),
      margins_(2 * pairs_),
      slope_(pairs_),
      widening_(pairs_),
      row_(2 * pairs_),
      part_(2 * pairs_),
      tau_(set_.dimension()) {
  const ScenarioList& list = problem.scenarios;
  for (const LoadGroup& group : list.loads) loads_.push_back(make_load(problem.robot, group));
  const bool currents = std::any_of(loads_.begin(), loads_.end(),
                                    [](const Load& load) { return load.currents.has_value(); });
  if (currents) of_.resize(static_cast<std::size_t>(2 * pairs_));
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

/// Cases that change masses only are combinations of at most four loads for each link.
auto ScenarioFacets::make_load(const Robot& robot, const LoadGroup& cases) -> Load {
  Load load;
  load.cases = &cases;
  if (has_current(cases)) {
    for (const LoadCase& each : cases) {
      if (!each.loads.empty()) {
        throw std::invalid_argument(
            "scenarios: got a case with a current and masses, expected two "
            "loads, one of currents and one of masses");
      }
    }
    load.currents.emplace(robot, cases);
    const Eigen::VectorXd& most = load.currents->most();
    load.anywhere = most.allFinite();
    load.bound.setZero(robot.actuation.facet_pairs());
    load.worst.resize(static_cast<std::size_t>(2 * load.bound.size()));
    if (load.anywhere) load.bound = (robot.actuation.N.cwiseAbs().transpose() * most).array();
    return load;
  }
  int links = 0;
  for (const LoadCase& each : cases) {
    for (const LinkLoad& change : each.loads) links = std::max(links, change.link + 1);
  }
  Eigen::MatrixXd all(4 * links, static_cast<Eigen::Index>(cases.size()));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) = numbers_of(cases[i], links);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(all);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(all.rows(), qr.rank());
  for (Eigen::Index i = 0; i < Q.cols(); ++i) load.basis.push_back(case_of(Q.col(i)));
  load.coefficients = Q.transpose() * all;
  return load;
}

/// N'tau, by rows of N.
void ScenarioFacets::project(const Eigen::VectorXd& tau, Eigen::Ref<Eigen::ArrayXd> onto) const {
  onto.setZero();
  for (Eigen::Index i = 0; i < tau.size(); ++i) {
    if (tau[i] != 0) onto += tau[i] * set_.N.row(i).array().transpose();
  }
}

/// Writes n_j'tau of a case, for all j, into `value_`.
void ScenarioFacets::combine(const Load& load, Eigen::Index which) {
  value_.setZero();
  for (Eigen::Index i = 0; i < load.coefficients.rows(); ++i) {
    const double factor = load.coefficients(i, which);
    if (factor != 0) value_ += factor * load.projections.col(i);
  }
}

/// Gives all currents the normal of a pair.
void ScenarioFacets::aim(Eigen::Index pair) {
  if (aimed_ == pair) return;
  aimed_ = pair;
  normal_ = set_.N.col(pair);
  for (Load& load : loads_) {
    if (load.currents) load.currents->aim(normal_);
  }
}

/// The largest n_j'tau of all cases, or -n_j'tau of a lower side, and the case that has it.
double ScenarioFacets::worst_case(Load& load, Eigen::Index row, int& which) {
  const Eigen::Index pair = row % pairs_;
  const double side = row < pairs_ ? 1 : -1;
  if (load.currents) {
    aim(pair);
    return load.currents->worst(side, which);
  }
  double worst = -kInfinity;
  for (Eigen::Index i = 0; i < load.count(); ++i) {
    double value = 0;
    for (Eigen::Index k = 0; k < load.coefficients.rows(); ++k) {
      value += load.coefficients(k, i) * load.projections(pair, k);
    }
    if (side * value <= worst) continue;
    worst = side * value;
    which = static_cast<int>(i);
  }
  return worst;
}

void ScenarioFacets::set_margins(ScenarioForces& at) {
  project(at.tau_d(), nominal_);
  margins_ << -nominal_, nominal_;
  for (Load& load : loads_) {
    if (load.currents) continue;
    load.projections.resize(pairs_, static_cast<Eigen::Index>(load.basis.size()));
    for (std::size_t i = 0; i < load.basis.size(); ++i) {
      tau_.setZero();
      at.add_load(load.basis[i], tau_);
      project(tau_, load.projections.col(static_cast<Eigen::Index>(i)));
    }
    most_.setConstant(-kInfinity);
    least_.setConstant(kInfinity);
    for (Eigen::Index i = 0; i < load.count(); ++i) {
      combine(load, i);
      most_ = most_.max(value_);
      least_ = least_.min(value_);
    }
    margins_.head(pairs_) -= most_;
    margins_.tail(pairs_) += least_;
  }
  if (!of_.empty()) set_bounds(at);
}

/// Subtracts the bounds of all currents from the margins.
void ScenarioFacets::set_bounds(ScenarioForces& at) {
  still_ = margins_;
  std::fill(of_.begin(), of_.end(), Margin::kBounded);
  aimed_ = -1;
  for (Load& load : loads_) {
    if (load.currents) load.currents->set(at.posture());
  }
  for (Load& load : loads_) {
    if (!load.currents) continue;
    for (Eigen::Index pair = 0; !load.anywhere && pair < pairs_; ++pair) {
      aim(pair);
      load.bound[pair] = load.currents->bound();
    }
    margins_.head(pairs_) -= load.bound;
    margins_.tail(pairs_) -= load.bound;
  }
}

/// Brings the margin of a row nearer to that of the worst cases; false if it is that already.
bool ScenarioFacets::refine(Eigen::Index row) {
  if (of_.empty()) return false;
  Margin& of = of_[static_cast<std::size_t>(row)];
  if (of == Margin::kOfCases) return false;
  of = of == Margin::kBounded ? Margin::kBoundedClosely : Margin::kOfCases;
  const Eigen::Index pair = row % pairs_;
  aim(pair);
  margins_[row] = still_[row];
  for (Load& load : loads_) {
    if (!load.currents) continue;
    if (of == Margin::kBoundedClosely) {
      margins_[row] -= load.currents->bound();
    } else {
      margins_[row] -= worst_case(load, row, load.worst[static_cast<std::size_t>(row)]);
    }
  }
  return true;
}

/// Sets the slopes of a wrench, and by how much the ball widens them.
void ScenarioFacets::set_slopes(ScenarioForces& at, int i) {
  const ScenarioList& list = problem_.scenarios;
  at.exert(at.wrench(i), tau_);
  size_ = tau_.norm();
  project(tau_, slope_);
  widening_.setZero();
  if (list.ball && !list.wrenches[static_cast<std::size_t>(i)].hold) {
    for (Eigen::Index axis = 0; axis < ball_.cols(); ++axis) {
      at.exert(at.ball_axis(axis), tau_);
      size_ += tau_.norm();
      project(tau_, ball_.col(axis));
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
    const double slack = kRowRounding * (1 + std::abs(margins_[each]));
    return limits[each] + margins_[each] >= -slack;
  };
  for (const int each : wrench.parallel) {
    bool held = holds(each);
    while (!held && refine(each)) held = holds(each);
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
  choice.cases.resize(loads_.size());
  for (std::size_t group = 0; group < loads_.size(); ++group) {
    Load& load = loads_[group];
    const auto row = static_cast<std::size_t>(end.row);
    if (load.currents && of_[row] == Margin::kOfCases) {
      choice.cases[group] = load.worst[row];
    } else {
      worst_case(load, end.row, choice.cases[group]);
    }
  }
  return true;
}

void ScenarioFacets::fill_rows(ScenarioForces& at, Eigen::VectorXd& load, Eigen::VectorXd& slope) {
  set_margins(at);
  for (Eigen::Index pair = 0; pair < pairs_; ++pair) {
    while (refine(pair) || refine(pair + pairs_)) {
    }
  }
  const auto wrenches = static_cast<Eigen::Index>(wrenches_.size());
  load = -margins_.matrix().replicate(wrenches, 1);
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
  set_margins(at);
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
      if (of_.empty()) scan_low(i, l);  // while its rows are at hand
    }
  }
  if (of_.empty()) return;
  for (int i = 0; i < static_cast<int>(wrenches_.size()); ++i) {
    for (int l = 0; l < static_cast<int>(limits_.size()); ++l) scan_low(i, l);
  }
}

Eigen::Index ScenarioFacets::row_of(double end) const {
  Eigen::Index row = 0;
  while (part_[row] != end) ++row;
  return row;
}

/// Refines a row and its end; false if they are exact already.
bool ScenarioFacets::refine_end(const Wrench& rows, const Eigen::ArrayXd& limits,
                                Eigen::Index row) {
  if (!refine(row)) return false;
  part_[row] = (limits[row] + margins_[row]) * rows.inverse[row];
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
  row_ = (bounds + margins_) * rows.inverse;
  part_ = (rows.inverse > 0).select(row_, kInfinity);
  for (double end = part_.minCoeff(); end < high; end = part_.minCoeff()) {
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
  if (!of_.empty()) row_ = (bounds + margins_) * rows.inverse;  // else it is that of `scan_high`
  part_ = (rows.inverse < 0).select(row_, -kInfinity);
  for (double end = part_.maxCoeff(); end > low; end = part_.maxCoeff()) {
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
