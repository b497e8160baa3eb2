#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/scenario/scenario_list.h"
#include "lib/trajectory/motion_evaluator.h"
#include "lib/trajectory/program.h"
#include "maxwrench/problem.h"
#include "maxwrench/tank.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

SchemeMaps maps_of(const MotionTask& task, Interpolation interpolation) {
  const bool rests = task.k == 1 && !task.impulse;
  if (rests || interpolation == Interpolation::kLinear) return make_scheme(task);
  return make_dense_spline(task, task.impulse ? kDenseImpulse : kDensePath);
}

/// Fixes c'h of a block. Turns the columns so that the first one is c, which lies in the span of W.
void fix_wrench(double asked, WrenchProgram& block) {
  const Eigen::VectorXd along = block.c_w.normalized();
  Eigen::MatrixXd Z = along.householderQr().householderQ();
  Z.col(0) = along;
  block.W = block.W * Z;
  block.JtW = block.JtW * Z;
  block.c_w = Z.transpose() * block.c_w;
  block.w_min[0] = block.w_max[0] = asked / block.c_w[0];
}

/// Spaces the knots along a path T/(k-1) apart, for schemes that space them T/k apart.
void stretch(const MotionTask& task, std::vector<Instant>& instants) {
  const double f = task.T / instants.back().t;
  for (Instant& instant : instants) {
    instant.t *= f;
    instant.v /= f;
    instant.v_dot /= f * f;
  }
  instants.back().t = task.T;
}

/// Adds a second instant, so that the robot rests for the whole duration.
void rest(const MotionTask& task, std::vector<Instant>& instants) {
  instants.push_back(instants.front());
  instants.back().t = task.T;
}

/// Whether the trajectory has a wrench to request. If not, concludes with the reason.
bool askable(const Trajectory& trajectory, TankScript& script) {
  if (trajectory.status == Status::kInvalidPosture) {
    script.conclude(trajectory.status, trajectory.reason.c_str());
  } else if (!std::isfinite(script.planned)) {
    const bool spline = trajectory.status == Status::kOptimal;
    script.conclude(spline ? Status::kInfeasible : trajectory.status,
                    (spline ? trajectory.between_knots_reason : trajectory.reason).c_str());
  } else if (!(script.planned > 0)) {
    script.conclude(Status::kInfeasible, "no wrench > 0 along c is possible");
  } else {
    return true;
  }
  return false;
}

/// The program of the instants with the requested wrench.
TrajectoryProgram asking(const Problem& problem, const MotionTask& task,
                         const std::vector<MotionScenario>& scenarios, const SchemeMaps& maps,
                         int t_h, TankScript& script) {
  TrajectoryProgram program = make_trajectory_program(problem, task, scenarios, maps);
  set_instants(problem, task, scenarios, maps, script.instants, program);
  program.rho = kElasticWeight;
  const double asked = (1 - script.margin) * script.planned;
  if (!task.impulse) {
    for (WrenchProgram& block : program.instants) fix_wrench(asked, block);
    return program;
  }
  const bool block = start_is_block(task, maps);
  // The wrench that balances at theta_0 is at most the static capability.
  if (block && task.start == Start::kStatic) program.instants[0].w_max.setConstant(kInfinity);
  const int peak = maps.knot_at[static_cast<std::size_t>(t_h)];
  program.peak = peak - (block ? 0 : 1);
  fix_wrench(asked, program.instants[static_cast<std::size_t>(program.peak)]);
  script.t_h = script.instants[static_cast<std::size_t>(peak)].t;
  return program;
}

}  // namespace

const char* to_string(Interpolation interpolation) {
  return interpolation == Interpolation::kLinear ? "linear" : "spline";
}

Interpolation parse_interpolation(const std::string& name) {
  for (const Interpolation each : {Interpolation::kLinear, Interpolation::kSpline}) {
    if (name == to_string(each)) return each;
  }
  throw std::invalid_argument("interpolation: got " + name + ", expected linear or spline");
}

double planned_wrench(const Trajectory& trajectory, const ScriptOptions& options) {
  if (options.planned > 0) return options.planned;
  return options.interpolation == Interpolation::kSpline ? trajectory.value_between_knots
                                                         : trajectory.value;
}

TankScript make_script(const Problem& problem, const Trajectory& trajectory, Wrench wrench,
                       TrajectorySolver& solver, const ScriptOptions& options) {
  check(options);
  require_no_scenarios(problem, "virtual tank");
  MotionTask task = *problem.motion;
  task.thruster_lag = std::max(task.thruster_lag, options.thruster_lag);
  if (task.has_factor()) {
    throw std::invalid_argument(problem.name + ": got " +
                                (task.payload ? "a payload" : "a table of wrenches") +
                                ", expected one wrench along c for the virtual tank");
  }
  TankScript script;
  script.interpolation = options.interpolation;
  script.wrench = wrench;
  script.margin = options.margin;
  script.planned = planned_wrench(trajectory, options);
  if (!askable(trajectory, script)) return script;
  script.path = task.impulse || task.k == 1 ? Path::constant(task.path.pose(0), task.T) : task.path;
  MotionEvaluator motion(problem, maps_of(task, options.interpolation));
  const SchemeMaps& maps = motion.maps();
  motion.evaluate(all_knots(task, trajectory.knots), script.instants);
  if (motion.lost() >= 0) {
    script.conclude(Status::kInvalidPosture, motion.lost_reason());
    return script;
  }
  const std::vector<MotionScenario> scenarios = motion_scenarios(problem, wrench);
  const TrajectoryProgram program = asking(problem, task, scenarios, maps, trajectory.t_h, script);
  TrajectorySolution solution;
  solver.solve(program, solution);
  script.conclude(solution.status, solution.reason.c_str());
  if (script.status != Status::kOptimal) return script;
  script.slack = solution.s.cwiseAbs().maxCoeff();
  read_efforts(problem, task, program, solution, scenarios.front(), 0, script.instants);
  if (script.instants.size() == 1) rest(task, script.instants);
  if (!task.impulse) stretch(task, script.instants);
  return script;
}

}  // namespace maxwrench
