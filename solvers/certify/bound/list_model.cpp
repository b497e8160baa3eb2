#include "solvers/certify/bound/list_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "lib/scenario/scenario_facets.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {
namespace {

/// The component of a load: its wet mass, or that of the first moment.
double component_of(const LinkLoad& load, int component) {
  return component == 0 ? load.mass : load.moment[component - 1];
}

/// The robot with no weight but a unit of wet mass, or of its first moment, on one link. Water of
/// density 1 carries a mass of 1 whose first moment is wanted alone.
void leave_unit_load(int link, int component, Robot& robot) {
  for (Link& each : robot.links) {
    each.mass = each.volume = 0;
    each.com.setZero();
    each.cob.setZero();
  }
  robot.trim = {};
  robot.water_density = 1;
  Link& at = robot.links[static_cast<std::size_t>(link)];
  at.mass = 1;
  if (component == 0) return;
  at.com = Eigen::Vector3d::Unit(component - 1);
  at.volume = 1;
}

[[noreturn]] void reject_list(const Problem& problem, const std::string& got,
                              const std::string& expected) {
  throw std::invalid_argument("certify: got " + got + ", expected " + expected + " (" +
                              problem.name + ")");
}

}  // namespace

ListModel::ListModel(const Problem& problem) : problem_(problem), kept_(problem) {
  if (!ScenarioFacets::supports(problem)) {
    reject_list(problem, "a list for actuators with too many facets", "one wrench");
  }
  if (list().payload && problem.free.count() > 0) {
    reject_list(problem, "a payload at a pose that is partly free", "a fixed pose");
  }
  leave_out();
  find_units();
  find_axes();
  const auto count = static_cast<std::size_t>(std::max(loads(), axes()));
  for (std::size_t b = 0; b < count; ++b) {
    tasks_.push_back(std::make_unique<const Problem>(block_task(b, problem)));
    blocks_.push_back(std::make_unique<LoopModel>(*tasks_.back()));
    if (b > 0) blocks_.back()->leave_equations();
  }
  key_size_ = 2 + static_cast<Eigen::Index>(list().loads.size());
  if (list().ball) key_size_ += list().ball->E.cols();
  set_ceiling();
}

void ListModel::leave_out() {
  ScenarioList& kept = kept_.scenarios;
  kept.limits.clear();
  for (std::size_t i = 0; i < list().limits.size(); ++i) {
    const Zonotope& limits = list().limits[i].actuation;
    if (!limits.u_min.allFinite() || !limits.u_max.allFinite()) continue;
    kept.limits.push_back(list().limits[i]);
    kept_limits_.push_back(static_cast<int>(i));
  }
  if (kept.limits.empty()) reject_list(problem_, "no scenario with finite limits", "one");
  for (std::size_t group = 0; group < list().loads.size(); ++group) {
    LoadGroup& cases = kept.loads[group];
    std::vector<int>& numbers = kept_cases_.emplace_back();
    cases.clear();
    for (std::size_t i = 0; i < list().loads[group].size(); ++i) {
      const LoadCase& load = list().loads[group][i];
      if (!load.current.isZero(0)) continue;
      cases.push_back(load);
      numbers.push_back(static_cast<int>(i));
    }
    if (cases.empty()) reject_list(problem_, "a load that always has a current", "still water");
  }
}

void ListModel::find_units() {
  for (const LoadGroup& group : kept_.scenarios.loads) {
    for (const LoadCase& load : group) {
      for (const LinkLoad& change : load.loads) {
        for (int component = 0; component < 4; ++component) {
          const UnitLoad unit{change.link, component};
          if (component_of(change, component) == 0) continue;
          if (std::find(units_.begin(), units_.end(), unit) == units_.end()) units_.push_back(unit);
        }
      }
    }
  }
}

void ListModel::find_axes() {
  Vector6d used = Vector6d::Zero();
  for (const ScenarioWrench& wrench : list().wrenches) used += wrench.c.cwiseAbs();
  if (list().ball) used += list().ball->E.cwiseAbs().rowwise().sum();
  for (int k = 0; k < 6; ++k) {
    place_[static_cast<std::size_t>(k)] = -1;
    if (used[k] == 0) continue;
    place_[static_cast<std::size_t>(k)] = static_cast<int>(axes_.size());
    axes_.push_back(k);
  }
}

/// An ordinary task with T_b and A_b in place of tau_d and J'c.
Problem ListModel::block_task(std::size_t block, const Problem& nominal) const {
  Problem task = nominal;
  task.scenarios = {};
  task.c = Vector6d::Unit(axes_[std::min(block, axes_.size() - 1)]);
  if (block > 0 && block <= units_.size()) {
    leave_unit_load(units_[block - 1].link, units_[block - 1].component, task.robot);
  }
  return task;
}

void ListModel::weigh(const LoadCase& load, Eigen::VectorXd& loads) const {
  for (const LinkLoad& change : load.loads) {
    for (std::size_t b = 0; b < units_.size(); ++b) {
      if (units_[b].link != change.link) continue;
      loads[static_cast<Eigen::Index>(b) + 1] += component_of(change, units_[b].component);
    }
  }
}

Eigen::VectorXd ListModel::along_axes(const Vector6d& c) const { return c(axes_); }

void ListModel::weigh(const ScenarioKey& key, Eigen::VectorXd& loads, Eigen::VectorXd& axes) const {
  loads.setZero(this->loads());
  loads[0] = 1;
  const std::size_t groups = list().loads.size();
  for (std::size_t group = 0; group < groups; ++group) {
    weigh(list().loads[group][static_cast<std::size_t>(key[2 + group])], loads);
  }
  const ScenarioWrench& wrench = list().wrenches[static_cast<std::size_t>(key[0])];
  Vector6d c = wrench.c;
  if (list().ball && !wrench.hold) {
    const WrenchBall& ball = *list().ball;
    for (Eigen::Index k = 0; k < ball.E.cols(); ++k) {
      const double z = kBallStep * key[2 + groups + static_cast<std::size_t>(k)];
      c += ball.radius * z * ball.E.col(k);
    }
  }
  axes = c(axes_);
}

ScenarioKey ListModel::key_of(const ScenarioChoice& choice) const {
  ScenarioKey key = {choice.wrench, kept_limits_[static_cast<std::size_t>(choice.limits)]};
  for (std::size_t group = 0; group < choice.cases.size(); ++group) {
    key.push_back(kept_cases_[group][static_cast<std::size_t>(choice.cases[group])]);
  }
  if (!list().ball) return key;
  const ScenarioWrench& wrench = list().wrenches[static_cast<std::size_t>(choice.wrench)];
  const WrenchBall& ball = *list().ball;
  Eigen::VectorXd z = ball.E.transpose() * (choice.c - wrench.c) / ball.radius;
  if (wrench.hold) z.setZero();
  z *= (1 - 1e-9) / std::max(1.0, z.norm());  // in the ball, whatever the rounding
  for (const double x : z) key.push_back(static_cast<int>(std::trunc(x / kBallStep)));
  return key;
}

void ListModel::write(const ScenarioKey& key, Eigen::Ref<Eigen::VectorXd> numbers) const {
  const Eigen::Index whole = 2 + static_cast<Eigen::Index>(list().loads.size());
  for (Eigen::Index i = 0; i < key_size_; ++i) {
    numbers[i] = (i < whole ? 1 : kBallStep) * key[static_cast<std::size_t>(i)];
  }
}

ScenarioKey ListModel::read(const Eigen::Ref<const Eigen::VectorXd>& numbers) const {
  const Eigen::Index whole = 2 + static_cast<Eigen::Index>(list().loads.size());
  ScenarioKey key(static_cast<std::size_t>(key_size_));
  for (Eigen::Index i = 0; i < key_size_; ++i) {
    key[static_cast<std::size_t>(i)] =
        static_cast<int>(i < whole ? numbers[i] : numbers[i] / kBallStep);
  }
  return key;
}

/// The ceilings of all wrenches, of a ball those along its axes, with all limits and the first case
/// of each load. Scenarios whose wrench the base's free axes do not limit are left out, unless that
/// is all of them.
void ListModel::set_ceiling() {
  if (!blocks_.front()->coordinates.base_is_dependent) return;
  std::vector<CeilingSizes> wide;
  for (std::size_t b = 0; b < blocks_.size(); ++b) wide.push_back(ceiling_sizes(*tasks_[b]));
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(this->loads());
  loads[0] = 1;
  for (const LoadGroup& group : kept_.scenarios.loads) weigh(group.front(), loads);
  CeilingSizes sizes = wide.front();
  sizes.tau.setZero();
  for (Eigen::Index b = 0; b < loads.size(); ++b) {
    sizes.tau += std::abs(loads[b]) * wide[static_cast<std::size_t>(b)].tau;
  }
  std::optional<std::invalid_argument> why;
  for (const ScenarioWrench& wrench : list().wrenches) {
    if (wrench.hold) continue;
    Matrix6Xd directions = wrench.c;
    if (list().ball) directions = (list().ball->radius * list().ball->E).colwise() + wrench.c;
    for (const Vector6d& c : directions.colwise()) {
      if (c.isZero(0)) continue;
      const Eigen::VectorXd along = c(axes_).cwiseAbs() / c.norm();
      sizes.a.setZero();
      for (Eigen::Index k = 0; k < axes(); ++k) {
        sizes.a += along[k] * wide[static_cast<std::size_t>(k)].a;
      }
      for (const ScenarioLimits& limits : kept_.scenarios.limits) {
        try {
          const double most =
              pure_ceiling(problem_, c / c.norm(), limits.actuation, sizes) / c.norm();
          ceiling_ = std::min(ceiling_, most);
        } catch (const std::invalid_argument& error) {
          why = error;
        }
      }
    }
  }
  if (why && ceiling_ == kInfinity) throw std::invalid_argument(*why);
}

}  // namespace maxwrench
