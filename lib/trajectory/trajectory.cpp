#include "maxwrench/trajectory.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lib/scenario/scenario_list.h"
#include "lib/trajectory/clearance.h"
#include "lib/trajectory/limits.h"
#include "lib/trajectory/overshoot.h"
#include "lib/trajectory/workspace.h"

namespace maxwrench {
namespace {

/// [N, N m] The slack that `value_between_knots` tolerates.
constexpr double kSlackForgiven = 0.05;
/// Smaller values are rounding of an interior-point method.
constexpr double kNoPrice = 1e-7, kNoMultiplier = 1e-7;
/// A verdict counts if its residuals are within this share of 1 + |value|.
constexpr double kVerified = 1e-7;

}  // namespace

TrajectoryEvaluator::TrajectoryEvaluator(const Problem& problem, Wrench wrench,
                                         const TrajectorySolverMaker& make, bool check_collision)
    : workspace_(std::make_unique<Workspace>(problem, wrench, make, check_collision)) {}
TrajectoryEvaluator::~TrajectoryEvaluator() = default;

const std::vector<NearPair>& TrajectoryEvaluator::near_pairs(const Eigen::MatrixXd& knots,
                                                             double within) {
  Workspace& ws = *workspace_;
  ws.near.clear();
  if (!ws.check_collision) return ws.near;
  find_near_pairs(ws.problem, ws.motion, all_knots(ws.task, knots), within,
                  ws.task.clear_at_instants, ws.links, ws.near);
  return ws.near;
}

const Trajectory& TrajectoryEvaluator::trajectory() const { return workspace_->trajectory; }
const TrajectoryProgram& TrajectoryEvaluator::program() const { return workspace_->program; }
const KnotRows& TrajectoryEvaluator::rows() const { return workspace_->rows; }
const DependentRows& TrajectoryEvaluator::dependent_rows() const { return workspace_->following; }
int TrajectoryEvaluator::knots() const { return workspace_->motion.maps().rows(); }
bool TrajectoryEvaluator::smooth() const { return workspace_->motion.maps().smooth(); }
bool TrajectoryEvaluator::starts() const { return workspace_->motion.maps().before > 0; }

const Trajectory& TrajectoryEvaluator::evaluate(const Eigen::MatrixXd& knots) {
  Workspace& ws = *workspace_;
  Trajectory& trajectory = ws.trajectory;
  ws.require_table(knots);
  trajectory.knots = knots;
  trajectory.value = trajectory.value_between_knots = trajectory.overshoot =
      std::numeric_limits<double>::quiet_NaN();
  trajectory.speed_overshoot = trajectory.limit_overshoot = trajectory.overshoot;
  trajectory.decides_at = -1;
  trajectory.between_knots_reason = "";
  ws.Q = all_knots(ws.task, knots);
  ws.motion.evaluate(ws.Q, trajectory.instants);
  const std::string violation = ws.violation();
  set_instants(ws.problem, ws.task, ws.scenarios, ws.motion.maps(), trajectory.instants,
               ws.program);
  trajectory.collision = ws.collision();
  if (!violation.empty()) {
    trajectory.conclude(Status::kInvalidPosture, violation);
    return trajectory;
  }
  ws.solve_best(ws.program, *ws.solver, trajectory.solution, trajectory.t_h);
  trajectory.conclude(trajectory.solution.status, trajectory.solution.reason.c_str());
  if (trajectory.status == Status::kInfeasible) {
    const std::string name =
        infeasible_scenario(ws.problem, ws.scenarios, ws.program, trajectory.solution);
    if (!name.empty()) {
      trajectory.conclude(Status::kInfeasible, trajectory.solution.reason.str() + ": " + name);
    }
  }
  if (trajectory.status != Status::kOptimal) return trajectory;
  trajectory.value = trajectory.solution.value;
  trajectory.solution.residual = recheck(ws.program, trajectory.solution);
  if (!trajectory.solution.residual.within(kVerified * (1 + std::abs(trajectory.value)))) {
    trajectory.conclude(Status::kNumericalError, "the answer does not satisfy its program");
    return trajectory;
  }
  ws.read_deciding(ws.program, trajectory.solution);
  ws.pull_back(ws.program, trajectory.solution, trajectory.gradient);
  return trajectory;
}

void TrajectoryEvaluator::evaluate_between_knots(TrajectorySolver* by) {
  Workspace& ws = *workspace_;
  TrajectorySolver& solver = by ? *by : *ws.elastic_solver;
  Trajectory& trajectory = ws.trajectory;
  const MotionTask& task = ws.task;
  if (ws.Q.rows() < 2) {
    trajectory.value_between_knots = trajectory.value;
    trajectory.between_knots_reason = trajectory.reason;
    return;
  }
  if (task.transfer && trajectory.status == Status::kOptimal) {
    trajectory.overshoot = overshoot_of(ws.problem, ws.Q, trajectory.value);
    const JointOvershoot joints = joint_overshoot_of(ws.problem, ws.Q, task.T);
    trajectory.speed_overshoot = joints.speed;
    trajectory.limit_overshoot = joints.place;
  }
  MotionEvaluator& fine = ws.on_spline();
  const SchemeMaps& maps = fine.maps();
  TrajectoryProgram program = make_trajectory_program(ws.problem, task, ws.scenarios, maps);
  std::vector<Instant> instants;
  fine.evaluate(ws.Q, instants);
  if (fine.lost() >= 0) {
    trajectory.between_knots_reason = motion_violation(ws.problem, fine, instants);
    return;
  }
  set_instants(ws.problem, ws.task, ws.scenarios, maps, instants, program);
  program.rho = kElasticWeight;
  for (int s = 0; task.impulse && task.start == Start::kStatic && s < program.scenarios; ++s) {
    program.instants[static_cast<std::size_t>(s * program.length())].w_max =
        ws.program.instants[static_cast<std::size_t>(s * ws.program.length())].w_max;
  }
  if (task.impulse) set_peak(ws.scenarios, ws.block_of(maps, trajectory.t_h), program);
  TrajectorySolution solution;
  solver.solve(program, solution);
  if (solution.status != Status::kOptimal) {  // slack may cost less than a wrench
    program.rho = kInfinity;
    solver.solve(program, solution);
  }
  if (solution.status != Status::kOptimal) {
    trajectory.between_knots_reason = solution.reason;
    return;
  }
  const double slack = solution.s.size() == 0 ? 0 : solution.s.cwiseAbs().maxCoeff();
  if (!(slack <= kSlackForgiven)) {
    trajectory.between_knots_reason = "a balance on the spline through the knots is violated by " +
                                      std::to_string(slack) + " N or N m";
    return;
  }
  trajectory.value_between_knots = solution.value;
}

std::optional<Clearance> TrajectoryEvaluator::least_clearance() {
  Workspace& ws = *workspace_;
  if (!ws.check_collision) return {};
  MotionEvaluator& motion = ws.Q.rows() < 2 ? ws.motion : ws.on_spline();
  return find_least_clearance(ws.problem, motion, ws.Q, ws.links);
}

double TrajectoryEvaluator::evaluate_elastic(const Eigen::MatrixXd& knots,
                                             Eigen::MatrixXd* gradient) {
  Workspace& ws = *workspace_;
  Trajectory& trajectory = ws.trajectory;
  ws.require_table(knots);
  trajectory.knots = knots;
  ws.Q = all_knots(ws.task, knots);
  ws.motion.evaluate(ws.Q, trajectory.instants);
  std::string violation = ws.violation();
  if (violation.empty()) violation = ws.collision();
  if (!violation.empty()) {
    trajectory.conclude(Status::kInvalidPosture, violation);
    return -kInfinity;
  }
  set_instants(ws.problem, ws.task, ws.scenarios, ws.motion.maps(), trajectory.instants,
               ws.elastic);
  ws.solve_elastic();
  const TrajectorySolution& solution = ws.elastic_solution;
  trajectory.conclude(solution.status, solution.reason.c_str());
  if (solution.status != Status::kOptimal) return -kInfinity;
  ws.read_deciding(ws.elastic, solution);
  ws.about = &solution;
  if (gradient) ws.pull_back(ws.elastic, solution, *gradient);
  return solution.value - solution.price;
}

bool TrajectoryEvaluator::coupled() const {
  const TrajectorySolution& solution = workspace_->elastic_solution;
  return solution.price > kNoPrice || (solution.mu.array().abs() > kNoMultiplier).any() ||
         (solution.kappa.array().abs() > kNoMultiplier).any();
}

const TrajectorySolution& TrajectoryEvaluator::elastic_solution() const {
  return workspace_->elastic_solution;
}

TrajectoryProgram& TrajectoryEvaluator::linearize(const Eigen::MatrixXd& knots,
                                                  const std::vector<Eigen::VectorXd>& w) {
  Workspace& ws = *workspace_;
  ws.require_table(knots);
  ws.Q = all_knots(ws.task, knots);
  ws.motion.evaluate(ws.Q, ws.trajectory.instants);
  set_instants(ws.problem, ws.task, ws.scenarios, ws.motion.maps(), ws.trajectory.instants,
               ws.elastic);
  ws.other.u.setZero(ws.problem.robot.actuators(), ws.elastic.size());
  ws.other.w = w;
  ws.about = &ws.other;
  return linearize();
}

TrajectoryProgram& TrajectoryEvaluator::linearize() {
  Workspace& ws = *workspace_;
  if (ws.about == nullptr) {
    throw std::logic_error("linearize: got no trajectory, expected one that was evaluated");
  }
  TrajectoryProgram& program = ws.bordered;
  program = ws.elastic;
  const int length = program.length();
  const auto skipped = static_cast<int>(ws.trajectory.instants.size()) - length;
  program.G.resize(program.instants.size());
  const Eigen::Index r = ws.problem.redundancy();
  const SchemeMaps& maps = ws.motion.maps();
  for (int s = 0; s < program.scenarios; ++s) {
    ws.read(ws.elastic, *ws.about, s);
    ws.motion.linearize(ws.trajectory.instants, ws.slopes);
    for (int i = 0; i < length; ++i) {
      ws.motion.push_forward(ws.slopes, i + skipped, ws.G);
      program.G[static_cast<std::size_t>(s * length + i)] =
          -ws.G.middleCols(maps.before * r, maps.rows() * r);
    }
  }
  ws.following = make_dependent_rows(ws.problem, ws.motion, ws.trajectory.instants, ws.slopes);
  return program;
}

}  // namespace maxwrench
