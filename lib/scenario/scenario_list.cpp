#include "lib/scenario/scenario_list.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "lib/robot/chain.h"
#include "lib/scenario/current_load.h"
#include "maxwrench/capability.h"
#include "maxwrench/problem.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

long ScenarioList::count() const {
  double all = static_cast<double>(wrenches.size()) * static_cast<double>(limits.size());
  for (const LoadGroup& group : loads) all *= static_cast<double>(group.size());
  return all > static_cast<double>(kMostScenarios) ? kMostScenarios + 1 : std::lround(all);
}

std::string describe(const ScenarioList& list, const ScenarioChoice& choice) {
  std::string text;
  const auto add = [&text](const std::string& name) {
    if (name.empty()) return;
    if (!text.empty()) text += "; ";
    text += name;
  };
  if (list.wrenches.size() > 1) add(list.wrenches[static_cast<std::size_t>(choice.wrench)].name);
  add(list.limits[static_cast<std::size_t>(choice.limits)].name);
  for (std::size_t group = 0; group < choice.cases.size(); ++group) {
    add(list.loads[group][static_cast<std::size_t>(choice.cases[group])].name);
  }
  if (!text.empty()) return text;
  const ScenarioLimits& limits = list.limits[static_cast<std::size_t>(choice.limits)];
  return limits.lost.weaker.empty() ? "nominal" : "weaker actuators";
}

ScenarioData scenario_data(const Problem& problem, const ScenarioChoice& choice) {
  const ScenarioList& list = problem.scenarios;
  const Robot& robot = problem.robot;
  const auto name_of = [&robot](int actuator) { return actuator_name(robot, actuator); };
  ScenarioData data;
  if (list.wrenches.size() > 1) {
    data.wrench = list.wrenches[static_cast<std::size_t>(choice.wrench)].name;
  }
  data.c = choice.c;
  const LostActuators& lost = list.limits[static_cast<std::size_t>(choice.limits)].lost;
  for (const int i : lost.dead) data.dead.push_back(name_of(i));
  for (const int i : lost.limp) data.limp.push_back(name_of(i));
  for (const int i : lost.locked) data.locked.push_back(name_of(i));
  for (const auto& [i, share] : lost.weaker) data.weaker.emplace_back(name_of(i), share);
  if (!robot.current.isZero(0)) data.current = robot.current;
  for (std::size_t group = 0; group < choice.cases.size(); ++group) {
    const LoadGroup& cases = list.loads[group];
    const LoadCase& load = cases[static_cast<std::size_t>(choice.cases[group])];
    data.deltas.insert(data.deltas.end(), load.deltas.begin(), load.deltas.end());
    if (has_current(cases)) data.current = load.current;
  }
  return data;
}

bool next(const ScenarioList& list, ScenarioChoice& choice) {
  for (std::size_t group = choice.cases.size(); group-- > 0;) {
    if (++choice.cases[group] < static_cast<int>(list.loads[group].size())) return true;
    choice.cases[group] = 0;
  }
  if (++choice.limits < static_cast<int>(list.limits.size())) return true;
  choice.limits = 0;
  return ++choice.wrench < static_cast<int>(list.wrenches.size());
}

std::vector<ScenarioChoice> all_scenarios(const ScenarioList& list) {
  std::vector<ScenarioChoice> all;
  if (list.empty()) return all;
  ScenarioChoice each;
  each.cases.resize(list.loads.size());
  do all.push_back(each);
  while (next(list, each));
  return all;
}

Problem nominal(Problem problem) {
  ScenarioList& list = problem.scenarios;
  if (list.empty()) return problem;
  problem.digest.clear();  // that of the file is of the whole list
  std::erase_if(list.loads, [](const LoadGroup& cases) {
    return cases.size() > 1 || !cases.front().name.empty();
  });
  list.limits.assign(1, {"", problem.robot.actuation});
  const bool plain = list.wrenches.size() == 1 && list.wrenches[0].c == problem.c && !list.ball &&
                     !list.payload && list.loads.empty();
  if (plain) list = {};
  return problem;
}

void require_no_scenarios(const Problem& problem, const std::string& what) {
  if (problem.scenarios.empty()) return;
  throw std::invalid_argument(what + ": got " + problem.name +
                              ", a task with a list of scenarios, expected one wrench of the "
                              "nominal robot");
}

}  // namespace maxwrench
