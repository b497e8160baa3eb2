#include "verify/trajectory/provable.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "verify/coordinates.h"

namespace maxwrench {
namespace {

/// The number of equations of the dependent joints: one for each axis of the base that is not free.
int dependent_equations(const Problem& problem) {
  const Robot& robot = problem.robot;
  // A base that turns about another axis would have other equations.
  if (is_free(robot, 3) || is_free(robot, 4)) return 0;
  int count = is_free(robot, 5) ? 2 : 3;
  for (int axis = 0; axis < 3; ++axis) count += is_free(robot, axis) ? 0 : 1;
  return count;
}

/// Whether a joint that moves has a gear, or moves another joint by one.
bool gear_moves(const Problem& problem) {
  const auto moves = [&](int joint) {
    return std::count(problem.redundant.begin(), problem.redundant.end(), joint) > 0 ||
           std::count(problem.dependent.begin(), problem.dependent.end(), joint) > 0;
  };
  const std::vector<Joint>& joints = problem.robot.joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::optional<Gear>& gear = joints[i].gear;
    if (gear && (moves(static_cast<int>(i)) || moves(gear->leader))) return true;
  }
  return false;
}

std::string unprovable(const Problem& problem, const char* got, const char* expected) {
  return problem.name + ": got " + got + ", expected " + expected + " for a proof in time";
}

}  // namespace

std::string why_unprovable(const Problem& problem) {
  if (!problem.motion) return unprovable(problem, "a static task", "a trajectory or an impulse");
  const MotionTask& task = *problem.motion;
  const bool open_start = task.impulse && task.start == Start::kZero;
  const bool moves = task.k + (task.impulse ? 1 : 0) >= 2;
  const std::vector<std::pair<bool, std::array<const char*, 2>>> cases = {
      {problem.contact.has_value(), {"a second contact", "one contact"}},
      {!problem.dependent.empty() &&
           dependent_equations(problem) != static_cast<int>(problem.dependent.size()),
       {"dependent joints that the base's axes do not determine", "as many as axes that it lacks"}},
      {problem.free.count() > 0, {"free pose coordinates", "a path"}},
      {gear_moves(problem), {"a gear at a joint that moves", "none"}},
      {!problem.scenarios.empty(), {"a list of scenarios", "one wrench of the nominal robot"}},
      {!task.path.as_screw(),
       {"a path through given poses", "one that rotates about an axis and translates"}},
      {task.transfer, {"a transfer", "a trajectory or an impulse"}},
      {!(task.thruster_lag >= 0 && task.thruster_lag < kInfinity),
       {"motion.thruster_lag that is no time constant", "0 or more"}},
      {task.has_factor(), {"a payload or a table of wrenches", "one wrench along a path"}},
      {!moves, {"k = 1", "k >= 2"}},
      {open_start, {"start.kind = \"zero\"", "a start in balance"}},
      {!problem.robot.no_dynamics.empty(), {"a robot without dynamics", "complete inertias"}},
      {!problem.robot.actuation.full_row_rank(),
       {"actuators that do not reach all generalised forces", "B of full row rank"}},
  };
  for (const auto& [refused, words] : cases) {
    if (refused) return unprovable(problem, words[0], words[1]);
  }
  return {};
}

void require_provable(const Problem& problem) {
  const std::string why = why_unprovable(problem);
  if (!why.empty()) throw std::invalid_argument(why);
}

void require_provable_task(const Problem& problem) {
  const ScenarioList& list = problem.scenarios;
  if (list.empty()) return require_provable(problem);
  for (const ScenarioWrench& wrench : list.wrenches) {
    if (!wrench.hold) continue;
    throw std::invalid_argument(unprovable(problem, "wrench.hold", "a wrench in each scenario"));
  }
  if (list.ball || list.payload || !list.loads.empty()) {
    throw std::invalid_argument(
        unprovable(problem, "a ball, a payload or uncertain loads", "wrenches and limits"));
  }
  Problem alone = problem;
  alone.scenarios = {};
  require_provable(alone);
}

}  // namespace maxwrench
