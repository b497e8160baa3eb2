#include "maxwrench/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "lib/math/decompositions.h"
#include "maxwrench/problem.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"
#include "solvers/solve/solve_from.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

void require_one_contact(const Problem& task) {
  if (!task.motion && !task.contact) return;
  throw std::invalid_argument("sensitivity: got " + task.name + ", " +
                              (task.motion ? "a task in time" : "a task with a second contact") +
                              ", expected a static task with one contact");
}

/// Rejects a task whose actuators may be weaker: the limits to compare are those of the robot.
void require_full_strength(const Problem& task) {
  if (task.scenarios.empty()) return;
  const Zonotope &weak = task.scenarios.limits.front().actuation, &full = task.robot.actuation;
  if (weak.u_min == full.u_min && weak.u_max == full.u_max) return;
  throw std::invalid_argument("sensitivity: got " + task.name +
                              ", in which actuators may be weaker, expected no uncertainty.thrust "
                              "and uncertainty.torque");
}

/// The scenarios of a task. One wrench of the nominal robot becomes a list of one.
ScenarioList list_of(const Problem& task) {
  if (!task.scenarios.empty()) return task.scenarios;
  ScenarioList list;
  list.wrenches.push_back({"", task.c});
  const Eigen::VectorXd along_c = task.W_any.transpose() * task.c;
  list.F = task.W_any * split(along_c).complement;
  list.unit = task.unit();
  return list;
}

/// The task with these limits. One wrench of the nominal robot remains an ordinary task.
Problem limited(const Problem& task, const ScenarioLimits& limits) {
  Problem changed = task;
  if (task.scenarios.empty()) {
    changed.robot.actuation = limits.actuation;
  } else {
    changed.scenarios.limits = {limits};
  }
  return changed;
}

/// A joint that its brake holds rests where it is, so the search does not move it. Other
/// coordinates would move a dependent joint, so where one of these is locked the posture rests.
void hold_locked_joints(const ScenarioLimits& limits, const Eigen::VectorXd& theta_r,
                        Problem& task) {
  const auto thrusters = static_cast<int>(task.robot.thrusters.size());
  const auto is_locked = [&](int joint) {
    const auto& locked = limits.lost.locked;
    return std::find(locked.begin(), locked.end(), thrusters + joint) != locked.end();
  };
  const bool rests = std::any_of(task.dependent.begin(), task.dependent.end(), is_locked);
  for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!rests && !(i < task.redundant.size() && is_locked(task.redundant[i]))) continue;
    task.theta_r_min[k] = task.theta_r_max[k] = task.theta_r_default[k] = theta_r[k];
  }
}

double value_of(const Answer& answer) { return answer.has_value() ? answer.beta() : -kInfinity; }

bool is_within(const Eigen::VectorXd& theta_r, const Problem& task) {
  return (theta_r.array() >= task.theta_r_min.array()).all() &&
         (theta_r.array() <= task.theta_r_max.array()).all();
}

/// Evaluations of a search that continues from postures that other limits have found, if the
/// options have no budget.
constexpr long kContinued = 3000;

class Comparison {
 public:
  Comparison(const Eigen::VectorXd& theta_r, const Options& options)
      : theta_r_(theta_r), options_(options) {}

  LossEffect compare(const std::string& name, const Problem& task) const {
    LossEffect effect{name, at(task, theta_r_), {}};
    if (!options_.interrupted || !options_.interrupted()) {
      effect.best = solve(task, options_);
    } else {
      effect.best.conclude(Status::kBudgetExhausted, "interrupted");
    }
    return effect;
  }

  /// Searches again from the best postures of other limits, if one of them has a larger value than
  /// the best posture so far.
  void improve(const Problem& task, const std::vector<Eigen::VectorXd>& postures,
               LossEffect& effect) const {
    if (options_.interrupted && options_.interrupted()) return;
    std::vector<Eigen::VectorXd> better;
    for (const Eigen::VectorXd& posture : postures) {
      if (!is_within(posture, task)) continue;
      if (value_of(at(task, posture)) > value_of(effect.best)) better.push_back(posture);
    }
    if (better.empty()) return;
    Options options = options_;
    if (options.budget == 0) options.budget = kContinued;
    Answer again = solve_from(std::make_shared<const Problem>(task), better, options);
    again.evaluations += effect.best.evaluations;
    if (value_of(again) > value_of(effect.best)) effect.best = std::move(again);
  }

 private:
  Answer at(const Problem& task, const Eigen::VectorXd& theta_r) const {
    Options options = options_;
    options.search.clear();
    return evaluate(task, theta_r, options);
  }

  const Eigen::VectorXd& theta_r_;
  const Options& options_;
};

std::string shown(const Answer& answer) {
  return answer.has_value() ? fmt::format("{:.5f}", answer.beta()) : "-";
}

std::string line_of(const LossEffect& effect, const std::string& name) {
  const std::string posture = effect.best.has_value() ? line(effect.best.posture.theta_r) : "";
  return fmt::format("{:<40} {:>11} {:>11}  {}\n", name, shown(effect.at_posture),
                     shown(effect.best), posture);
}

ordered_json object_of(const LossEffect& effect) {
  const Answer& best = effect.best;
  ordered_json theta_r = nullptr;
  if (best.has_value()) theta_r = array(best.posture.theta_r);
  return {{"name", effect.name},
          {"at_posture", known(effect.at_posture.has_value(), effect.at_posture.beta())},
          {"best", known(best.has_value(), best.beta())},
          {"theta_r", theta_r},
          {"status", to_string(best.status)},
          {"evaluations", best.evaluations}};
}

}  // namespace

Sensitivity sensitivity(const Problem& task, const Eigen::VectorXd& theta_r,
                        const std::vector<ScenarioLimits>& limits, const Options& options) {
  require_one_contact(task);
  require_full_strength(task);
  const Comparison comparison(theta_r, options);
  Sensitivity result;
  std::vector<Problem> tasks;
  for (const ScenarioLimits& each : limits) {
    Problem& with_loss = tasks.emplace_back(limited(task, each));
    hold_locked_joints(each, theta_r, with_loss);
    result.effects.push_back(comparison.compare(each.name, with_loss));
  }
  Problem all = task;
  all.scenarios = list_of(task);
  all.scenarios.limits = limits;
  result.all = comparison.compare("any of these", all);
  const auto postures = [&result](std::size_t but) {
    std::vector<Eigen::VectorXd> found;
    const auto add = [&found](const Answer& best) {
      if (best.has_value()) found.push_back(best.posture.theta_r);
    };
    for (std::size_t i = 0; i < result.effects.size(); ++i) {
      if (i != but) add(result.effects[i].best);
    }
    if (but < result.effects.size()) add(result.all.best);
    return found;
  };
  comparison.improve(all, postures(limits.size()), result.all);
  // Limits that allow more come first, so they are searched again from all that others found.
  for (std::size_t i = limits.size(); i-- > 0;) {
    comparison.improve(tasks[i], postures(i), result.effects[i]);
  }
  return result;
}

std::string summary(const Sensitivity& sensitivity) {
  std::vector<const LossEffect*> sorted;
  for (const LossEffect& effect : sensitivity.effects) sorted.push_back(&effect);
  std::stable_sort(sorted.begin(), sorted.end(), [](const LossEffect* a, const LossEffect* b) {
    return value_of(a->best) < value_of(b->best);
  });
  std::string text =
      fmt::format("{:<40} {:>11} {:>11}  theta_r\n", "lost", "at posture", "best found");
  for (const LossEffect* effect : sorted) {
    text += line_of(*effect, effect->name.empty() ? "nothing" : effect->name);
  }
  return text + line_of(sensitivity.all, sensitivity.all.name);
}

std::string to_json(const Sensitivity& sensitivity) {
  ordered_json object;
  object["problem"] = sensitivity.all.at_posture.choice.problem;
  object["unit"] = sensitivity.all.at_posture.unit;
  object["losses"] = ordered_json::array();
  for (const LossEffect& effect : sensitivity.effects) {
    object["losses"].push_back(object_of(effect));
  }
  object["all"] = object_of(sensitivity.all);
  object["version"] = version();
  return in_one_line(object);
}

}  // namespace maxwrench
