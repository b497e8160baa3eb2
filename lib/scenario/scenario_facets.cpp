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
  bounded_ = std::any_of(loads_.begin(), loads_.end(),
                         [](const Load& load) { return load.currents.has_value(); });
  if (bounded_) abs_N_ = set_.N.cwiseAbs();
  exact_.resize(static_cast<std::size_t>(2 * pairs_));
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

/// Writes n_j'tau of all cases, for one j, into `values`.
void ScenarioFacets::fill_values(Load& load, Eigen::Index pair) {
  if (load.currents) {
    load.currents->project(set_.N.col(pair), load.values);
  } else {
    load.values.matrix().noalias() =
        load.coefficients.transpose() * load.projections.row(pair).transpose().matrix();
  }
}

void ScenarioFacets::set_margins(ScenarioForces& at) {
  project(at.tau_d(), nominal_);
  margins_ << -nominal_, nominal_;
  std::fill(exact_.begin(), exact_.end(), 0);
  for (Load& load : loads_) {
    if (load.currents) {
      load.currents->set(at.posture());
      bound_cases(load);
      margins_.head(pairs_) -= load.centre + load.half;
      margins_.tail(pairs_) += load.centre - load.half;
      continue;
    }
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
}

/// Bounds of n_j'tau by those of the coordinates.
void ScenarioFacets::bound_cases(Load& load) {
  load.currents->bound(centre_, half_);
  load.centre.setZero(pairs_);
  load.half.setZero(pairs_);
  for (Eigen::Index i = 0; i < centre_.size(); ++i) {
    load.centre += centre_[i] * set_.N.row(i).array().transpose();
    load.half += half_[i] * abs_N_.row(i).array().transpose();
  }
}

/// Makes the margin of a row that of the worst cases; false if it is that already.
bool ScenarioFacets::refine(Eigen::Index row) {
  if (!bounded_ || exact_[static_cast<std::size_t>(row)]) return false;
  exact_[static_cast<std::size_t>(row)] = 1;
  const Eigen::Index pair = row % pairs_;
  const double side = row < pairs_ ? 1 : -1;
  for (Load& load : loads_) {
    if (!load.currents) continue;
    fill_values(load, pair);
    const double worst = side > 0 ? load.values.maxCoeff() : -load.values.minCoeff();
    margins_[row] += side * load.centre[pair] + load.half[pair] - worst;
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
    if (holds(each) || (refine(each) && holds(each))) continue;
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
    fill_values(load, pair);
    load.values *= side;
    Eigen::Index worst = 0;
    load.values.maxCoeff(&worst);
    choice.cases[group] = static_cast<int>(worst);
  }
  return true;
}

void ScenarioFacets::fill_rows(ScenarioForces& at, Eigen::VectorXd& load, Eigen::VectorXd& slope) {
  set_margins(at);
  for (Eigen::Index row = 0; row < 2 * pairs_; ++row) refine(row);
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
      if (scan_rows(i, l)) continue;
      missed = true;
      return;
    }
  }
}

/// Moves both ends to those of one wrench with one set of limits; false if a row is missed.
bool ScenarioFacets::scan_rows(int wrench, int limits) {
  const Wrench& rows = wrenches_[static_cast<std::size_t>(wrench)];
  const Eigen::ArrayXd& bounds = limits_[static_cast<std::size_t>(limits)];
  const auto find = [this](double end) {
    Eigen::Index row = 0;
    while (part_[row] != end) ++row;
    return row;
  };
  Eigen::Index missed_row = 0;
  if (misses(bounds, rows, missed_row)) {
    low_end_ = {wrench, limits, missed_row};
    return false;
  }
  row_ = (bounds + margins_) * rows.inverse;
  const auto refined = [&](Eigen::Index row) {
    if (!refine(row)) return false;
    part_[row] = (bounds[row] + margins_[row]) * rows.inverse[row];
    return true;
  };
  part_ = (rows.inverse > 0).select(row_, kInfinity);
  for (double end = part_.minCoeff(); end < high; end = part_.minCoeff()) {
    const Eigen::Index row = find(end);
    if (refined(row)) continue;
    high = end;
    high_end_ = {wrench, limits, row};
    high_inverse_ = rows.inverse[row];
  }
  part_ = (rows.inverse < 0).select((bounds + margins_) * rows.inverse, -kInfinity);
  for (double end = part_.maxCoeff(); end > low; end = part_.maxCoeff()) {
    const Eigen::Index row = find(end);
    if (refined(row)) continue;
    low = end;
    low_end_ = {wrench, limits, row};
  }
  return true;
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
