#include "problems/make/losses.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/robot/chain.h"
#include "problems/make/bad_value.h"

namespace maxwrench {
namespace {

/// Actuators that are lost together, in increasing order.
using Lost = std::vector<int>;

int thrusters_of(const Robot& robot) { return static_cast<int>(robot.thrusters.size()); }

/// The joint of an actuator, or null for a thruster.
const Joint* joint_of(const Robot& robot, int actuator) {
  const int joint = actuator - thrusters_of(robot);
  return joint < 0 ? nullptr : &robot.joints[static_cast<std::size_t>(joint)];
}

/// Whether a gear connects the joint with another one, so that it cannot fail alone.
bool is_geared(const Robot& robot, int actuator) {
  const Joint* joint = joint_of(robot, actuator);
  if (!joint) return false;
  const int index = actuator - thrusters_of(robot);
  return joint->gear || std::any_of(robot.joints.begin(), robot.joints.end(), [&](const Joint& j) {
           return j.gear && j.gear->leader == index;
         });
}

/// The actuators of these names. "thrusters" and "joints" stand for all of them.
Lost actuators_named(const std::string& key, const std::vector<std::string>& names,
                     const Robot& robot) {
  const int thrusters = thrusters_of(robot), all = robot.actuators();
  Lost found;
  for (const std::string& name : names) {
    const std::size_t before = found.size();
    for (int i = 0; i < all; ++i) {
      const bool named =
          name == actuator_name(robot, i) || name == (i < thrusters ? "thrusters" : "joints");
      if (named) found.push_back(i);
    }
    if (found.size() == before) found.clear();
    if (found.empty()) break;
  }
  std::sort(found.begin(), found.end());
  if (found.empty() || std::adjacent_find(found.begin(), found.end()) != found.end()) {
    std::vector<std::string> known;
    for (int i = 0; i < all; ++i) known.push_back(actuator_name(robot, i));
    throw BadValue(key, shown(names),
                   fmt::format("{}'joints' or some of {}, each once",
                               thrusters > 0 ? "'thrusters', " : "", fmt::join(known, ", ")));
  }
  for (const int i : found) {
    if (!is_geared(robot, i)) continue;
    throw BadValue(key, shown(names),
                   fmt::format("actuators without a gear: a gear connects '{}' with another joint",
                               actuator_name(robot, i)));
  }
  return found;
}

void require_few_limits(const std::string& key, const std::string& got, double count) {
  if (count <= static_cast<double>(kMostScenarios)) return;
  throw BadValue(key, got, fmt::format("at most {} scenarios, not {:g}", kMostScenarios, count));
}

/// All sets of 1 to k of these actuators, smaller sets first.
std::vector<Lost> sets_of(const Lost& actuators, int k) {
  const int n = static_cast<int>(actuators.size());
  double count = 1, of_size = 1;
  for (int size = 1; size <= k; ++size)
    count += of_size *= static_cast<double>(n - size + 1) / size;
  require_few_limits("loss.any", fmt::format("{}", k), count);
  std::vector<Lost> sets;
  for (int size = 1; size <= k; ++size) {
    std::vector<bool> chosen(actuators.size(), false);
    std::fill_n(chosen.begin(), size, true);
    do {
      Lost& lost = sets.emplace_back();
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i]) lost.push_back(actuators[i]);
      }
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
  }
  return sets;
}

void check_loss(const LossSpec& loss) {
  require_non_negative("loss.friction", loss.friction);
  require_positive("loss.brake", loss.brake);
  if (loss.joints_lock && loss.friction != 0) {
    throw BadValue("loss.friction", shown(loss.friction), "no such key of joints that lock");
  }
  if (!loss.joints_lock && loss.brake != kInfinity) {
    throw BadValue("loss.brake", shown(loss.brake), "no such key of limp joints");
  }
  if (loss.any != 0 && !loss.cases.empty()) {
    throw BadValue("loss.cases", fmt::format("{} cases", loss.cases.size()),
                   "no such key beside loss.any");
  }
}

/// Whether a loss leaves none of several thrusters: nothing would move the robot. A single thruster
/// may be lost, to see what it is worth.
bool leaves_no_thruster(const Lost& lost, const Robot& robot) {
  const int thrusters = thrusters_of(robot);
  const auto dead =
      std::count_if(lost.begin(), lost.end(), [=](int actuator) { return actuator < thrusters; });
  return thrusters > 1 && dead == thrusters;
}

/// What is lost together, beginning with nothing. Sets that occur twice count once.
std::vector<Lost> lost_sets(const LossSpec& loss, const Robot& robot) {
  check_loss(loss);
  std::vector<Lost> sets = {{}};
  const auto add = [&sets](Lost lost) {
    if (std::find(sets.begin(), sets.end(), lost) == sets.end()) sets.push_back(std::move(lost));
  };
  for (std::size_t i = 0; i < loss.cases.size(); ++i) {
    const std::string key = fmt::format("loss.cases[{}]", i);
    Lost lost = actuators_named(key, loss.cases[i], robot);
    if (leaves_no_thruster(lost, robot)) {
      throw BadValue(key, shown(loss.cases[i]), "a loss that leaves a thruster alive");
    }
    add(std::move(lost));
  }
  if (!loss.cases.empty()) return sets;
  const Lost actuators = actuators_named("loss.actuators", loss.actuators, robot);
  const int n = static_cast<int>(actuators.size());
  if (loss.any < 1 || loss.any > n) {
    throw BadValue("loss.any", fmt::format("{}", loss.any),
                   fmt::format("a whole number from 1 to {}, the number of actuators", n));
  }
  for (Lost& lost : sets_of(actuators, loss.any)) {
    if (leaves_no_thruster(lost, robot)) {
      throw BadValue("loss.any", fmt::format("{}", loss.any),
                     fmt::format("less than {}, to leave a thruster alive", lost.size()));
    }
    sets.push_back(std::move(lost));
  }
  return sets;
}

/// Takes an actuator from the limits.
void lose(const LossSpec& loss, const Robot& robot, int actuator, ActuatorLimits& limits) {
  const bool joint = joint_of(robot, actuator) != nullptr;
  const double left = !joint ? 0 : loss.joints_lock ? loss.brake : loss.friction;
  limits.u_min[actuator] = 0 - left;  // not -0
  limits.u_max[actuator] = left;
  limits.resists = limits.resists || left > 0;
  LostActuators& lost = limits.lost;
  std::vector<int>& such = !joint ? lost.dead : loss.joints_lock ? lost.locked : lost.limp;
  such.push_back(actuator);
}

/// What is lost, and what is weaker although not all of its kind are.
std::string words_of(const LostActuators& lost, const std::vector<int>& two_ends,
                     const Robot& robot) {
  std::vector<std::string> words;
  const auto add = [&](const std::vector<int>& actuators, const char* how) {
    for (const int i : actuators) {
      words.push_back(fmt::format("{} {}", actuator_name(robot, i), how));
    }
  };
  add(lost.dead, "dead");
  add(lost.limp, "limp");
  add(lost.locked, "locked");
  for (const int i : two_ends) {
    const auto found = lost.weaker.find(i);
    if (found == lost.weaker.end()) continue;
    words.push_back(fmt::format("{} {:g} % weaker", actuator_name(robot, i), 100 * found->second));
  }
  return fmt::format("{}", fmt::join(words, " and "));
}

/// The share by which an actuator may be weaker.
double weaker_by(const UncertaintySpec& uncertainty, const Robot& robot, int actuator) {
  const Joint* joint = joint_of(robot, actuator);
  if (joint && joint->gear) return 0;
  return joint ? uncertainty.torque : uncertainty.thrust;
}

/// Whether an actuator may be weaker although its limits exclude zero.
bool has_two_ends(const UncertaintySpec& uncertainty, const Robot& robot, int actuator) {
  const Zonotope& all = robot.actuation;
  return weaker_by(uncertainty, robot, actuator) > 0 &&
         (all.u_min[actuator] > 0 || all.u_max[actuator] < 0);
}

/// Adds the limits with these actuators lost.
void add_limits(const LossSpec& loss, const UncertaintySpec& uncertainty, const Robot& robot,
                const Lost& lost, std::vector<ActuatorLimits>& result) {
  ActuatorLimits limits{.name = "", .u_min = robot.actuation.u_min, .u_max = robot.actuation.u_max};
  std::vector<int> two_ends;
  const auto weaken = [&](int i, ActuatorLimits& weaker) {
    const double by = weaker_by(uncertainty, robot, i);
    if (by == 0) return;
    weaker.u_min[i] *= 1 - by;
    weaker.u_max[i] *= 1 - by;
    weaker.lost.weaker[i] = by;
  };
  for (int i = 0; i < robot.actuators(); ++i) {
    if (std::binary_search(lost.begin(), lost.end(), i)) {
      lose(loss, robot, i, limits);
    } else if (has_two_ends(uncertainty, robot, i)) {
      two_ends.push_back(i);
    } else {
      weaken(i, limits);
    }
  }
  for (long weak = 0; weak < 1L << two_ends.size(); ++weak) {
    ActuatorLimits one = limits;
    for (std::size_t k = 0; k < two_ends.size(); ++k) {
      if ((weak >> k & 1) != 0) weaken(two_ends[k], one);
    }
    one.name = words_of(one.lost, two_ends, robot);
    result.push_back(std::move(one));
  }
}

void check_shares(const UncertaintySpec& uncertainty, const Robot& robot) {
  for (const auto& [key, share] : {std::pair("uncertainty.thrust", uncertainty.thrust),
                                   std::pair("uncertainty.torque", uncertainty.torque)}) {
    if (share >= 0 && share < 1) continue;
    throw BadValue(key, shown(share), "a share from 0 to 1, below 1");
  }
  if (uncertainty.thrust > 0 && thrusters_of(robot) == 0) {
    throw BadValue("uncertainty.thrust", shown(uncertainty.thrust),
                   "no such key: the robot has no thrusters");
  }
}

}  // namespace

std::vector<ActuatorLimits> actuator_limits(const std::optional<LossSpec>& loss,
                                            const UncertaintySpec& uncertainty,
                                            const Robot& robot) {
  check_shares(uncertainty, robot);
  const std::vector<Lost> sets = loss ? lost_sets(*loss, robot) : std::vector<Lost>{{}};
  int two_ends = 0;
  for (int i = 0; i < robot.actuators(); ++i) two_ends += has_two_ends(uncertainty, robot, i);
  require_few_limits(uncertainty.thrust > 0 ? "uncertainty.thrust" : "uncertainty.torque",
                     fmt::format("{} actuators whose limits exclude zero", two_ends),
                     static_cast<double>(sets.size()) * std::exp2(two_ends));
  std::vector<ActuatorLimits> result;
  for (const Lost& lost : sets) {
    add_limits(loss.value_or(LossSpec()), uncertainty, robot, lost, result);
  }
  return result;
}

std::vector<ScenarioLimits> limits_of_each_loss(LossSpec loss, const Robot& robot) {
  loss.any = 1;
  std::vector<ScenarioLimits> limits;
  for (const ActuatorLimits& each : actuator_limits(loss, {}, robot)) {
    limits.push_back(
        {each.name, with_limits(robot.actuation, each.u_min, each.u_max), each.resists, each.lost});
  }
  return limits;
}

}  // namespace maxwrench
