#include "problems/make/scenarios.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "lib/math/decompositions.h"
#include "lib/math/rotated.h"
#include "lib/robot/chain.h"
#include "lib/scenario/current_load.h"
#include "problems/make/bad_value.h"
#include "problems/make/losses.h"
#include "problems/make/payload.h"
#include "problems/make/uncertain_loads.h"

namespace maxwrench {
namespace {

constexpr double kLargestWrench = 1e9;    // N or N m
constexpr double kShortestWrench = 1e-9;  // likewise
constexpr double kMostKnotsOfList = 5000;

const Eigen::Vector3d& current_of(const TaskSpec& task) {
  return task.current ? *task.current : task.robot.current;
}

/// The first key of a task that ordinary tasks do not have, with its value. Empty: there is none.
struct KeyOfLists {
  std::string key, got;
};

KeyOfLists key_of_lists(const TaskSpec& task) {
  if (!task.set.empty()) return {"wrench.set", fmt::format("{} wrenches", task.set.size())};
  if (!task.ball_axes.empty() || task.ball_radius != 0) return {"wrench.ball", "a table"};
  if (task.hold) return {"wrench.hold", "true"};
  if (!current_of(task).isZero(0)) return {"environment.current", shown(current_of(task))};
  if (task.uncertainty) return {"uncertainty", "a table"};
  if (task.loss) return {"loss", "a table"};
  if (task.payload) return {"payload", "a table"};
  return {};
}

std::string key_of_set(std::size_t i) { return fmt::format("wrench.set[{}]", i); }

/// Rejects a wrench without a direction, and one that is too large.
void require_wrench(const std::string& key, const Eigen::VectorXd& c) {
  require_numbers(key, c, 6);
  if (c.stableNorm() < kShortestWrench) throw BadValue(key, shown(c), "a wrench of nonzero length");
  if (c.stableNorm() > kLargestWrench) {
    throw BadValue(key, shown(c), fmt::format("a wrench of at most {:g} N or N m", kLargestWrench));
  }
}

WrenchBall ball_of(const TaskSpec& task, const Problem& problem) {
  const std::string expected = fmt::format("some of {}, each once: forces or torques, not both",
                                           fmt::join(kWrenchAxes, ", "));
  const std::vector<std::string>& axes = task.ball_axes;
  WrenchBall ball;
  ball.E.setZero(6, static_cast<Eigen::Index>(axes.size()));
  for (std::size_t column = 0; column < axes.size(); ++column) {
    const auto axis = std::find(kWrenchAxes.begin(), kWrenchAxes.end(), axes[column]);
    const auto here = axes.begin() + static_cast<std::ptrdiff_t>(column);
    if (axis == kWrenchAxes.end() || std::find(axes.begin(), here, axes[column]) != here) {
      throw BadValue("wrench.ball.axes", shown(axes), expected);
    }
    ball.E(axis - kWrenchAxes.begin(), static_cast<Eigen::Index>(column)) = 1;
  }
  const bool forces = ball.E.topRows<3>().any(), torques = ball.E.bottomRows<3>().any();
  if (forces == torques) throw BadValue("wrench.ball.axes", shown(axes), expected);
  ball.E = rotated(problem.wrench_axes, ball.E);
  ball.radius = task.ball_radius;
  if (!(ball.radius >= kShortestWrench && ball.radius <= kLargestWrench)) {
    throw BadValue("wrench.ball.radius", shown(ball.radius),
                   fmt::format("a number > 0, at most {:g} N or N m", kLargestWrench));
  }
  return ball;
}

/// "N" if all columns are forces, "N m" if all are torques, else `mixed`.
const char* unit_of(const Matrix6Xd& wrenches, const char* mixed) {
  if (wrenches.bottomRows<3>().isZero()) return "N";
  if (wrenches.topRows<3>().isZero()) return "N m";
  return mixed;
}

/// The unit of the value: of wrenches or a ball of length 1 theirs, else none.
const char* unit_of(const TaskSpec& task, const ScenarioList& list, const Vector6d& c) {
  constexpr const char* kFactor = "-";
  const auto is_one = [](double length) { return std::abs(length - 1) < 1e-9; };
  if (task.set.empty() && task.c.isZero(0)) {
    return is_one(list.ball->radius) ? unit_of(list.ball->E, kFactor) : kFactor;
  }
  if (task.set.empty() && !list.ball) return unit_of(c, "mixed");
  Matrix6Xd all = list.ball ? list.ball->E : Matrix6Xd(6, 0);
  for (const ScenarioWrench& wrench : list.wrenches) {
    if (!is_one(wrench.c.norm())) return kFactor;
    all.conservativeResize(Eigen::NoChange, all.cols() + 1);
    all.rightCols<1>() = wrench.c;
  }
  return unit_of(all, kFactor);
}

/// The load of the known current: a single case.
LoadGroup known_current(const TaskSpec& task, const Robot& robot) {
  const Eigen::Vector3d& current = current_of(task);
  require_numbers("environment.current", current, 3);
  require_current("environment.current", shown(current), current.stableNorm(), robot);
  if (task.uncertainty &&
      (task.uncertainty->current_speed != 0 || !task.uncertainty->current_vectors.empty())) {
    throw BadValue("environment.current", shown(current), "zero beside uncertainty.current");
  }
  return {{.name = "", .loads = {}, .current = current}};
}

/// Rejects a list that nobody could evaluate. `corners` is the number of cases of all loads.
void require_few(const TaskSpec& task, double wrenches, double limits, double corners) {
  const double count = wrenches * limits * corners;
  if (count <= static_cast<double>(kMostScenarios)) return;
  const char* key = corners > 1 ? "uncertainty" : limits > 1 && task.loss ? "loss" : "wrench.set";
  throw BadValue(key, fmt::format("{:g} scenarios", count),
                 fmt::format("at most {}, of all wrenches, losses and corners of loads together",
                             kMostScenarios));
}

/// Rejects uncertain loads in time, where they would change inertias as well.
void require_known_loads(const UncertaintySpec& uncertainty) {
  const auto require_none = [](bool given, const char* key) {
    if (!given) return;
    throw BadValue(fmt::format("uncertainty.{}", key), "a value",
                   "no such key except in static tasks; tasks in time have thrust and torque");
  };
  require_none(!uncertainty.mass.empty(), "mass");
  require_none(!uncertainty.com.empty(), "com");
  require_none(!uncertainty.volume.empty(), "volume");
  require_none(!uncertainty.cob.empty(), "cob");
  require_none(uncertainty.trim != 0, "trim");
  require_none(uncertainty.payload_mass != 0, "payload");
  require_none(uncertainty.current_speed != 0 || !uncertainty.current_vectors.empty(), "current");
}

/// Rejects currents beside a second contact.
void require_still_water(const TaskSpec& task) {
  if (!task.contact) return;
  const Eigen::Vector3d& current = current_of(task);
  if (!current.isZero(0)) {
    throw BadValue("environment.current", shown(current), "zero beside [contact]");
  }
  const UncertaintySpec* uncertainty = task.uncertainty ? &*task.uncertainty : nullptr;
  if (!uncertainty) return;
  if (uncertainty->current_speed == 0 && uncertainty->current_vectors.empty()) return;
  throw BadValue("uncertainty.current", "a value", "no such key beside [contact]");
}

/// Rejects a payload at rest on whose added mass A a current V exerts the moment V x (A V).
void require_no_moment_of_payload(const TaskSpec& task, const ScenarioList& list) {
  if (!list.payload || !has_current(list)) return;
  const Vector6d& A = task.payload->added_mass;
  if (A[0] == A[1] && A[1] == A[2]) return;
  throw BadValue("payload.added_mass_per_kg", shown(A),
                 "the same along all axes, in a static task in a current");
}

/// Rejects a list whose trajectory programs would be too large.
void require_few_knots(double scenarios, const MotionTask& motion) {
  if (scenarios == 1 || scenarios * motion.k <= kMostKnotsOfList) return;
  throw BadValue("motion.k", fmt::format("{} knots of {:g} scenarios", motion.k, scenarios),
                 fmt::format("at most {:g} knots of all scenarios together", kMostKnotsOfList));
}

}  // namespace

void set_wrenches(const TaskSpec& task, Problem& problem) {
  const KeyOfLists given = key_of_lists(task);
  if (problem.motion && given.key == "wrench.ball") {
    throw BadValue(given.key, given.got,
                   "no such key except in static tasks; wrench.set lists wrenches in time");
  }
  if (task.payload) return set_payload(task, problem);
  if (problem.motion && problem.motion->table) return set_table(task, problem);
  ScenarioList& list = problem.scenarios;
  const bool in_ball = !task.ball_axes.empty() || task.ball_radius != 0;
  if (in_ball) list.ball = ball_of(task, problem);
  list.non_negative = in_ball;
  const Eigen::VectorXd c = task.c;
  if (!task.set.empty()) {
    if (!c.isZero(0)) throw BadValue("wrench.c", shown(c), "no such key beside wrench.set");
    for (std::size_t i = 0; i < task.set.size(); ++i) {
      require_wrench(key_of_set(i), task.set[i]);
      list.wrenches.push_back({.name = fmt::format("wrench {}", i + 1),
                               .c = rotated(problem.wrench_axes, task.set[i])});
    }
    problem.c = rotated(problem.wrench_axes, task.set[0].stableNormalized());
  } else if (in_ball && c.isZero(0)) {
    list.wrenches = {{.name = "ball"}};
    problem.c = list.ball->E.col(0);
  } else {
    require_numbers("wrench.c", c, 6);
    if (c.stableNorm() < kShortestWrench) {
      throw BadValue("wrench.c", shown(c), "a direction of nonzero length");
    }
    problem.c = rotated(problem.wrench_axes, c.stableNormalized());
    list.wrenches = {{.name = "", .c = problem.c}};
  }
  list.unit = unit_of(task, list, problem.c);
  if (task.hold) list.wrenches.push_back({.name = "hold", .hold = true});
}

std::vector<StatedDirection> stated_directions(const TaskSpec& task, const Problem& problem) {
  const ScenarioList& list = problem.scenarios;
  std::vector<StatedDirection> stated;
  if (list.payload) stated.push_back({"payload.com", shown(task.payload->com), problem.c});
  for (std::size_t i = 0; i < task.set.size(); ++i) {
    stated.push_back({key_of_set(i), shown(task.set[i]), list.wrenches[i].c.stableNormalized()});
  }
  if (!task.c.isZero(0)) stated.push_back({"wrench.c", shown(task.c), problem.c});
  for (Eigen::Index i = 0; list.ball && i < list.ball->E.cols(); ++i) {
    stated.push_back({"wrench.ball.axes", shown(task.ball_axes), list.ball->E.col(i)});
  }
  return stated;
}

Matrix6Xd free_across(const std::vector<StatedDirection>& directions, const Matrix6Xd& Y) {
  Eigen::MatrixXd within(Y.cols(), static_cast<Eigen::Index>(directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    within.col(static_cast<Eigen::Index>(i)) = (Y.transpose() * directions[i].c).stableNormalized();
  }
  return Y * split(within, kRankTolerance).complement;
}

void set_scenarios(const TaskSpec& task, Problem& problem) {
  ScenarioList& list = problem.scenarios;
  const UncertaintySpec known;
  const UncertaintySpec& uncertainty = task.uncertainty ? *task.uncertainty : known;
  if (problem.motion) require_known_loads(uncertainty);
  if (problem.motion && task.loss && task.loss->joints_lock) {
    throw BadValue("loss.joints", "'locked'", "'limp' in tasks in time, where joints move");
  }
  if (problem.motion && task.loss && task.loss->friction != 0) {
    throw BadValue("loss.friction", shown(task.loss->friction),
                   "0 in tasks in time, where friction opposes the rate of a joint");
  }
  require_still_water(task);
  list.loads = uncertain_loads(uncertainty, problem);
  if (!current_of(task).isZero(0)) {
    LoadGroup single = known_current(task, problem.robot);
    problem.robot.current = single.front().current;
    if (!problem.motion) list.loads.push_back(std::move(single));
  } else {
    problem.robot.current.setZero();
  }
  require_no_moment_of_payload(task, list);
  const std::vector<ActuatorLimits> limits = actuator_limits(task.loss, uncertainty, problem.robot);
  double corners = 1;
  for (const LoadGroup& group : list.loads) corners *= static_cast<double>(group.size());
  require_few(task, static_cast<double>(list.wrenches.size()), static_cast<double>(limits.size()),
              corners);
  if (problem.motion) {
    require_few_knots(static_cast<double>(list.wrenches.size() * limits.size()), *problem.motion);
  }
  const Zonotope& actuation = problem.robot.actuation;
  const bool stated = !task.set.empty() || task.hold || list.ball || list.payload;
  const bool same_limits = limits.size() == 1 && limits[0].u_min == actuation.u_min &&
                           limits[0].u_max == actuation.u_max;
  if (!stated && list.loads.empty() && same_limits) {
    list = {};
    return;
  }
  for (const ActuatorLimits& each : limits) {
    list.limits.push_back(
        {each.name, with_limits(actuation, each.u_min, each.u_max), each.resists, each.lost});
  }
}

}  // namespace maxwrench
