#include "view/scene/scene.h"

#include <array>

#include "lib/trajectory/scheme.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// The most instants of a trajectory whose sets of wrenches are in a scene.
constexpr std::size_t kMostSets = 50;

ordered_json coordinate_json(const Problem& problem, int i) {
  return {{"name", problem.theta_r_name(i)},
          {"unit", problem.theta_r_unit(i)},
          {"min", problem.theta_r_min[i]},
          {"max", problem.theta_r_max[i]},
          {"default", problem.theta_r_default[i]}};
}

/// The surface of the second contact, within the limits of the regrasp coordinates.
ordered_json contact_json(const Problem& problem) {
  static constexpr std::array kSurfaces = {"point", "line", "plane", "circle"};
  const Contact& contact = *problem.contact;
  const int s = contact.coordinates();
  return {{"surface", kSurfaces[static_cast<std::size_t>(contact.surface)]},
          {"frame", matrix_json(contact.frame)},
          {"radius", contact.radius},
          {"min", array(problem.theta_r_min.tail(s))},
          {"max", array(problem.theta_r_max.tail(s))}};
}

/// The times of the knots of a table [s]: of an impulse without its start, of a transfer without
/// both ends.
std::vector<double> knot_times(const Problem& problem) {
  const SchemeMaps maps = make_scheme(*problem.motion);
  std::vector<double> times;
  const bool transfer = problem.motion->transfer;
  const std::size_t end = maps.knot_at.size() - (transfer ? 1 : 0);
  for (std::size_t i = maps.starts || transfer ? 1 : 0; i < end; ++i) {
    const int instant = maps.knot_at[i];
    times.push_back(instant < 0 ? maps.dt * static_cast<double>(i)
                                : maps.t[static_cast<std::size_t>(instant)]);
  }
  return times;
}

ordered_json task_json(const Problem& problem) {
  ordered_json task;
  task["name"] = problem.name;
  task["label"] = problem.label;
  task["source"] = problem.source;
  task["type"] = problem.type();
  task["unit"] = problem.unit();
  task["end_effector"] = problem.end_effector;
  task["theta_r"] = ordered_json::array();
  for (int i = 0; i < problem.redundancy(); ++i) {
    task["theta_r"].push_back(coordinate_json(problem, i));
  }
  if (problem.motion) task["knot_times"] = knot_times(problem);
  task["contact"] = problem.contact ? contact_json(problem) : ordered_json(nullptr);
  return task;
}

}  // namespace

ordered_json scene_of(const Problem& problem, const std::vector<Visual>& visuals,
                      const std::vector<Shown>& shown) {
  ordered_json scene;
  scene["version"] = version();
  scene["task"] = task_json(problem);
  Robot robot = problem.robot;
  if (!problem.scenarios.empty()) robot.actuation = problem.scenarios.limits.front().actuation;
  scene["robot"] = robot_json(robot, visuals);
  scene["shown"] = ordered_json::array();
  for (const Shown& each : shown) {
    if (scene["measure"].is_null()) {
      scene["measure"] = each.answer.choice.measure;
      scene["wrench"] = to_string(each.answer.choice.wrench);
    }
    if (each.answer.trajectory.instants.empty()) continue;
    ordered_json entry = shown_json(each, kMostSets);
    if (problem.motion) entry["scenarios"] = scenarios_in_time_json(each.answer);
    if (each.tank) entry["tank"] = tank_json(each.answer);
    if (!entry["frames"].empty()) scene["shown"].push_back(std::move(entry));
  }
  return scene;
}

}  // namespace maxwrench
