#include <algorithm>
#include <cmath>

#include "lib/robot/chain.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "maxwrench/version.h"
#include "solvers/solve/active_limits.h"
#include "solvers/solve/format.h"
#include "solvers/solve/near_singular.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const IkCounts& ik_solutions) {
  return {{"valid", ik_solutions.valid()},           {"most", ik_solutions.most},
          {"unreachable", ik_solutions.unreachable}, {"beyond_limit", ik_solutions.beyond_limit},
          {"singular", ik_solutions.singular},       {"collision", ik_solutions.collision},
          {"incomplete", ik_solutions.incomplete}};
}

bool is_turn_in_place(const Path& path) {
  const Eigen::Vector3d p = path.pose(0).p;
  for (const double s : {0.3, 0.5, 1.0}) {
    if ((path.pose(s * path.duration()).p - p).norm() > 1e-12) return false;
  }
  return path.angle() != 0;
}

ordered_json path_json(const Path& path) {
  return {{"start", to_json(path.pose(0))},
          {"end", to_json(path.pose(path.duration()))},
          {"angle", path.angle()}};
}

ordered_json payload_json(const CarriedBody& body) {
  return {{"com", array(body.com)},
          {"inertia_per_kg", rows(body.inertia)},
          {"volume_per_kg", body.volume},
          {"cob", array(body.cob)},
          {"added_mass_per_kg", array(body.added_mass)}};
}

ordered_json task_json(const Answer& answer) {
  const Problem& problem = *answer.task;
  const MotionTask& task = *problem.motion;
  const int t_h = task.t_h > 0 ? task.t_h : answer.trajectory.t_h;
  ordered_json object;
  object["kind"] = problem.type();
  object["scheme"] = to_string(task.scheme);
  object["k"] = task.k;
  object["T"] = task.T;
  object["c"] = array(problem.c);
  if (task.payload) object["payload"] = payload_json(*task.payload);
  if (task.table) object["wrench_file"] = task.table->file;
  object["rates"] = task.rates;
  if (task.thruster_lag > 0) object["thruster_lag"] = task.thruster_lag;
  object["wrench"] = to_string(answer.choice.wrench);
  object["t_h"] = known(task.impulse && t_h > 0, t_h);
  object["u0"] = known(task.impulse, to_string(task.start));
  object["theta0"] = known(task.impulse || task.transfer, array(task.theta_0));
  if (task.transfer) object["thetaT"] = array(task.theta_T);
  object["collision"] = answer.collision;
  if (is_turn_in_place(task.path)) {
    object["angle"] = task.path.angle();
  } else if (!task.transfer) {
    object["path"] = path_json(task.path);
  }
  object["sub"] = instants_per_interval(task);
  return object;
}

/// In the order of u; `rate` is null if there is no limit.
ordered_json actuators_json(const Robot& robot, const Zonotope& set) {
  ordered_json list = ordered_json::array();
  for (Eigen::Index i = 0; i < robot.actuators(); ++i) {
    const double rate = robot.u_rate_max[i];
    list.push_back({{"name", actuator_name(robot, i)},
                    {"min", set.u_min[i]},
                    {"max", set.u_max[i]},
                    {"rate", known(rate < kInfinity, rate)}});
  }
  return list;
}

ordered_json instant_json(const Robot& robot, const Instant& instant, bool solved) {
  ordered_json object;
  object["t"] = instant.t;
  object["theta"] = theta(robot, instant.base, instant.q);
  object["velocity"] = array(instant.v);
  object["acceleration"] = array(instant.v_dot);
  object["tau_d"] = array(instant.tau_d);
  object["c"] = array(instant.c);
  object["h"] = known(solved, array(instant.h));
  object["u"] = known(solved, array(instant.u));
  object["beta"] = known(solved, instant.beta());
  return object;
}

ordered_json clearance_json(const std::optional<Clearance>& clearance) {
  if (!clearance) return nullptr;
  return {{"least", clearance->least}, {"t", clearance->t}, {"pair", clearance->pair}};
}

/// The choice of the case, and how it ended.
ordered_json choice_json(const Answer& answer) {
  const Case& c = answer.choice;
  ordered_json object;
  object["problem"] = c.problem;
  object["measure"] = c.measure;
  object["wrench"] = to_string(c.wrench);
  const std::string& limits = answer.task->robot.limits;
  if (!limits.empty()) object["limits"] = limits;
  object["solver"] = known(c.solver != kNoSolver, c.solver);
  object["search"] = known(!c.search.empty(), c.search);
  object["seed"] = known(!c.search.empty(), c.seed);
  object["status"] = to_string(answer.status);
  object["reason"] = known(!answer.reason.empty(), answer.reason.str());
  object["beta"] = known(answer.has_value(), answer.beta());
  object["unit"] = answer.unit;
  return object;
}

ordered_json worst_json(const ScenarioData& data) {
  ordered_json deltas = ordered_json::object(), weaker = ordered_json::object();
  for (const auto& [key, change] : data.deltas) {
    deltas[key] = change.size() == 1 ? ordered_json(change[0]) : array(change);
  }
  for (const auto& [name, share] : data.weaker) weaker[name] = share;
  return {{"wrench", known(!data.wrench.empty(), data.wrench)},
          {"c", array(data.c)},
          {"deltas", deltas},
          {"current", data.current ? array(*data.current) : ordered_json(nullptr)},
          {"dead", data.dead},
          {"limp", data.limp},
          {"locked", data.locked},
          {"weaker", weaker}};
}

/// The posture and the efforts of a static task's value.
void add_posture(const Answer& answer, ordered_json& object) {
  const Problem& problem = *answer.task;
  const Posture& posture = answer.posture;
  const Capability& capability = answer.capability;
  const bool there = answer.has_posture(), solved = answer.has_value();
  const bool has_wrench = solved && capability.w.size() > 0;
  object["beta_linf"] = known(std::isfinite(answer.beta_linf), answer.beta_linf);
  object["beta_linf_unit"] = problem.unit();
  const std::optional<JointOff> off = find_joint_off(answer);
  object["near_singular"] =
      off ? ordered_json{{"joint", off->joint}, {"off", off->by}, {"beta", off->beta}}
          : ordered_json(nullptr);
  object["theta_r"] = known(there, array(posture.theta_r));
  object["theta"] = there ? theta(problem.robot, posture.base, posture.q) : ordered_json(nullptr);
  if (finds_pose(answer)) {
    object["pose"] = there ? to_json(pose_at(problem, posture.theta_r)) : ordered_json(nullptr);
  }
  object["w"] = known(has_wrench, array(capability.w));
  object["h"] = known(has_wrench, array(capability.h));
  if (problem.contact) object["h_2"] = known(has_wrench, array(capability.h_2));
  object["u"] = known(solved && capability.u.size() > 0, array(capability.u));
  object["lambda"] = known(solved, array(capability.lambda));
  if (!problem.scenarios.empty()) {
    const ScenarioChoice& decides = capability.decides;
    object["decides"] = known(solved, describe(problem.scenarios, decides));
    object["worst"] = solved ? worst_json(scenario_data(problem, decides)) : ordered_json(nullptr);
    object["critical"] = known(solved, array(capability.h));
  }
  const Eigen::MatrixXd& gradient = answer.trajectory.gradient;
  const bool has_gradient = solved && gradient.cols() == posture.theta_r.size();
  object["gradient"] = has_gradient ? array(gradient.transpose()) : ordered_json(nullptr);
}

/// The trajectory of a task in time. Its efforts and wrenches are listed by instant.
void add_trajectory(const Answer& answer, ordered_json& object) {
  const bool solved = answer.has_value();
  object["theta_r"] = known(answer.has_posture(), rows(answer.trajectory.knots));
  for (const char* key : {"theta", "w", "h", "u", "lambda"}) object[key] = nullptr;
  object["gradient"] = known(solved, rows(answer.trajectory.gradient));
}

void add_instants(const Answer& answer, ordered_json& object) {
  const Trajectory& trajectory = answer.trajectory;
  const Robot& robot = answer.task->robot;
  object["task"] = task_json(answer);
  object["value"] = known(answer.has_value(), trajectory.value);
  object["value_between_knots"] = trajectory.value_between_knots;
  if (const ScenarioList& list = answer.task->scenarios; !list.empty()) {
    const bool decided = answer.has_value() && trajectory.decides_at >= 0;
    const auto at = static_cast<std::size_t>(std::max(0, trajectory.decides_at));
    object["decides"] = known(decided, describe(list, trajectory.decides));
    object["worst"] = decided ? worst_json(scenario_data(*answer.task, trajectory.decides))
                              : ordered_json(nullptr);
    object["decides_at"] = known(decided, decided ? trajectory.instants[at].t : 0.0);
  }
  if (answer.task->motion->transfer) {
    const auto number = [](double value) { return known(std::isfinite(value), value); };
    object["overshoot"] = number(trajectory.overshoot);
    object["speed_overshoot"] = number(trajectory.speed_overshoot);
    object["limit_overshoot"] = number(trajectory.limit_overshoot);
  }
  object["between_knots_reason"] =
      known(!trajectory.between_knots_reason.empty(), trajectory.between_knots_reason.str());
  object["collision"] = known(!trajectory.collision.empty(), trajectory.collision.str());
  object["clearance"] = clearance_json(answer.clearance);
  object["actuators"] = actuators_json(robot, reported_limits(answer));
  object["instants"] = ordered_json::array();
  for (const Instant& instant : trajectory.instants) {
    object["instants"].push_back(instant_json(robot, instant, answer.has_value()));
  }
}

ordered_json object_of(const Answer& answer) {
  const bool in_time = answer.task->motion.has_value();
  ordered_json object = choice_json(answer);
  (in_time ? add_trajectory : add_posture)(answer, object);
  object["residual"] = known(answer.has_value(), to_json(answer.residual()));
  object["evaluations"] = answer.evaluations;
  object["stopped"] = known(!answer.stopped.empty(), answer.stopped);
  object["calls"] = known(!answer.choice.search.empty(), to_json(answer.calls));
  if (!in_time) {
    object["undecided"] = answer.undecided;
    object["ik_solutions"] = to_json(answer.ik_solutions);
  }
  object["wall_s"] = answer.wall_s;
  object["task_digest"] = answer.task->digest;
  object["version"] = version();
  if (in_time) add_instants(answer, object);
  return object;
}

}  // namespace

std::string to_json(const Answer& answer) { return in_one_line(object_of(answer)); }

std::string to_json(const ScenarioData& data) { return in_one_line(worst_json(data)); }

std::string to_json(const Answer& answer, const std::vector<ScenarioEnds>& ends) {
  ordered_json object = object_of(answer);
  object["scenarios"] = ordered_json::array();
  for (const ScenarioEnds& each : ends) {
    object["scenarios"].push_back(
        {{"name", each.name},
         {"low", known(each.held && std::isfinite(each.low), each.low)},
         {"high", known(each.held && std::isfinite(each.high), each.high)},
         {"held", each.held}});
  }
  return in_one_line(object);
}

std::string to_json(const Answer& answer, const ScenarioSample& sample) {
  const auto number = [](double value) { return known(std::isfinite(value), value); };
  ordered_json object = object_of(answer);
  object["sample"] = {{"drawn", sample.drawn},         {"infeasible", sample.infeasible},
                      {"least", number(sample.least)}, {"q01", number(sample.q01)},
                      {"q05", number(sample.q05)},     {"median", number(sample.median)},
                      {"below", sample.below},         {"guaranteed", number(sample.guaranteed)}};
  return in_one_line(object);
}

}  // namespace maxwrench
