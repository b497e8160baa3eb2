#include "lib/scenario/scenario_margins.h"

#include <Eigen/QR>
#include <algorithm>
#include <stdexcept>

#include "lib/scenario/current_load.h"

namespace maxwrench {
namespace {

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

ScenarioMargins::ScenarioMargins(const Problem& problem)
    : N_(problem.robot.actuation.N),
      pairs_(problem.robot.actuation.facet_pairs()),
      nominal_(pairs_),
      most_(pairs_),
      least_(pairs_),
      value_(pairs_),
      values_(2 * pairs_),
      tau_(problem.robot.actuation.dimension()) {
  for (const LoadGroup& group : problem.scenarios.loads)
    loads_.push_back(make_load(problem.robot, group));
  const bool currents = std::any_of(loads_.begin(), loads_.end(),
                                    [](const Load& load) { return load.currents.has_value(); });
  if (currents) of_.resize(static_cast<std::size_t>(2 * pairs_));
}

/// Cases that change masses only are combinations of at most four loads for each link.
auto ScenarioMargins::make_load(const Robot& robot, const LoadGroup& cases) -> Load {
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
    const FacetNormals& N = robot.actuation.N;
    load.bound.resize(N.cols());
    for (Eigen::Index pair = 0; pair < N.cols(); ++pair) {
      load.bound[pair] = load.currents->most(N.col(pair));
    }
    load.anywhere = load.bound.allFinite();
    load.worst.resize(static_cast<std::size_t>(2 * load.bound.size()));
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

void project(const FacetNormals& N, const Eigen::VectorXd& tau, Eigen::Ref<Eigen::ArrayXd> onto) {
  onto.matrix().noalias() = N.transpose().lazyProduct(tau);
}

/// Writes n_j'tau of a case, for all j, into `value_`.
void ScenarioMargins::combine(const Load& load, Eigen::Index which) {
  value_.setZero();
  for (Eigen::Index i = 0; i < load.coefficients.rows(); ++i) {
    const double factor = load.coefficients(i, which);
    if (factor != 0) value_ += factor * load.projections.col(i);
  }
}

/// Gives all currents the normal of a pair.
void ScenarioMargins::aim(Eigen::Index pair) {
  if (aimed_ == pair) return;
  aimed_ = pair;
  normal_ = N_.col(pair);
  for (Load& load : loads_) {
    if (load.currents) load.currents->aim(normal_);
  }
}

/// The largest n_j'tau of all cases, or -n_j'tau of a lower side, and the case that has it.
double ScenarioMargins::worst_case(Load& load, Eigen::Index row, int& which) {
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

void ScenarioMargins::set(ScenarioForces& at) {
  project(N_, at.tau_d(), nominal_);
  values_ << -nominal_, nominal_;
  for (Load& load : loads_) {
    if (load.currents) continue;
    load.projections.resize(pairs_, static_cast<Eigen::Index>(load.basis.size()));
    for (std::size_t i = 0; i < load.basis.size(); ++i) {
      tau_.setZero();
      at.add_load(load.basis[i], tau_);
      project(N_, tau_, load.projections.col(static_cast<Eigen::Index>(i)));
    }
    most_.setConstant(-kInfinity);
    least_.setConstant(kInfinity);
    for (Eigen::Index i = 0; i < load.count(); ++i) {
      combine(load, i);
      most_ = most_.max(value_);
      least_ = least_.min(value_);
    }
    values_.head(pairs_) -= most_;
    values_.tail(pairs_) += least_;
  }
  if (!of_.empty()) set_bounds(at);
}

/// Subtracts the bounds of all currents from the margins.
void ScenarioMargins::set_bounds(ScenarioForces& at) {
  still_ = values_;
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
    values_.head(pairs_) -= load.bound;
    values_.tail(pairs_) -= load.bound;
  }
}

bool ScenarioMargins::refine(Eigen::Index row) {
  if (of_.empty()) return false;
  Margin& of = of_[static_cast<std::size_t>(row)];
  if (of == Margin::kOfCases) return false;
  of = of == Margin::kBounded ? Margin::kBoundedClosely : Margin::kOfCases;
  const Eigen::Index pair = row % pairs_;
  aim(pair);
  values_[row] = still_[row];
  for (Load& load : loads_) {
    if (!load.currents) continue;
    if (of == Margin::kBoundedClosely) {
      values_[row] -= load.currents->bound();
    } else {
      values_[row] -= worst_case(load, row, load.worst[static_cast<std::size_t>(row)]);
    }
  }
  return true;
}

void ScenarioMargins::refine_all() {
  for (Eigen::Index pair = 0; pair < pairs_; ++pair) {
    while (refine(pair) || refine(pair + pairs_)) {
    }
  }
}

void ScenarioMargins::choose(Eigen::Index row, ScenarioChoice& choice) {
  choice.cases.resize(loads_.size());
  const auto at = static_cast<std::size_t>(row);
  for (std::size_t group = 0; group < loads_.size(); ++group) {
    Load& load = loads_[group];
    if (load.currents && of_[at] == Margin::kOfCases) {
      choice.cases[group] = load.worst[at];
    } else {
      worst_case(load, row, choice.cases[group]);
    }
  }
}

}  // namespace maxwrench
