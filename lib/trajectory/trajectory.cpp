#include "maxwrench/trajectory.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lib/robot/gears.h"
#include "lib/scenario/scenario_list.h"
#include "lib/trajectory/clearance.h"
#include "lib/trajectory/limits.h"
#include "lib/trajectory/motion_evaluator.h"
#include "lib/trajectory/overshoot.h"
#include "lib/trajectory/program.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// [N, N m] The slack that `value_between_knots` tolerates.
constexpr double kSlackForgiven = 0.05;
/// Smaller values are rounding of an interior-point method.
constexpr double kNoPrice = 1e-7, kNoMultiplier = 1e-7;
/// A verdict counts if its residuals are within this share of 1 + |value|.
constexpr double kVerified = 1e-7;

/// The task in time. A static task holds its pose at one knot.
MotionTask task_of(const Problem& problem) {
  if (problem.contact) {
    throw std::invalid_argument(problem.name +
                                ": got a second contact, expected a task in time without one");
  }
  if (problem.motion) return *problem.motion;
  if (problem.free.count() > 0) {
    throw std::invalid_argument(problem.name +
                                ": got free pose coordinates, expected a pose that is fixed");
  }
  if (!gears_at(problem.robot, problem.end_effector).empty()) {
    throw std::invalid_argument(problem.name + ": got a gear, expected a chain without one");
  }
  MotionTask task;
  task.path = Path::constant(problem.pose, task.T);
  task.scheme = Scheme::kForward;
  return task;
}

}  // namespace

struct TrajectoryEvaluator::Workspace {
  Workspace(const Problem& p, Wrench w, const TrajectorySolverMaker& make, bool check)
      : problem(p),
        task(task_of(p)),
        wrench(w),
        check_collision(check && p.robot.collision != nullptr),
        motion(p, make_scheme(task)),
        program(make_trajectory_program(p, task, w, motion.maps())),
        elastic(program),
        solver(make()),
        elastic_solver(make()),
        links(p.robot),
        rows(knot_rows(p, task, motion.maps())) {
    elastic.rho = kElasticWeight;
    if (task.impulse && task.start == Start::kStatic) bound_start(make);
  }

  /// Limits w_0 to the static capability at theta_0.
  void bound_start(const TrajectorySolverMaker& make) {
    Q = all_knots(task, task.theta_0.transpose().replicate(task.k, 1));
    motion.evaluate(Q, trajectory.instants);
    set_instants(problem, task, wrench, motion.maps(), trajectory.instants, program);
    TrajectoryProgram start = program;
    start.instants.resize(1);
    start.instants[0].w_min.setConstant(-kInfinity);
    start.instants[0].w_max.setConstant(kInfinity);
    start.du_max.resize(start.du_max.rows(), 0);
    start.peak = 0;
    TrajectorySolution best;
    make()->solve(start, best);
    if (best.status != Status::kOptimal || !(best.value >= 0)) {
      throw std::invalid_argument(problem.name +
                                  ": start.theta_r: got a posture that cannot hold " +
                                  "itself, expected one with a static capability");
    }
    for (TrajectoryProgram* each : {&program, &elastic}) {
      each->instants[0].w_max.setConstant(best.value);
    }
  }

  void require_table(const Eigen::MatrixXd& knots) const {
    if (knots.rows() != motion.maps().rows() || knots.cols() != problem.redundancy()) {
      throw std::invalid_argument("theta_r: got a table of " + std::to_string(knots.rows()) +
                                  " x " + std::to_string(knots.cols()) + " numbers, expected " +
                                  std::to_string(motion.maps().rows()) + " x " +
                                  std::to_string(problem.redundancy()) + " for " + problem.name);
    }
    if (!knots.allFinite()) {
      throw std::invalid_argument("theta_r: got a value that is not a finite number");
    }
  }

  /// Why the knots or their motion are not feasible; empty if they are.
  std::string violation() const {
    const std::string of_knots = knots_violation(problem, motion.maps(), Q);
    return of_knots.empty() ? motion_violation(problem, motion, trajectory.instants) : of_knots;
  }

  /// Empty, or the first knot that collides.
  std::string collision() {
    return check_collision ? knot_collision(problem, motion, trajectory.instants, links) : "";
  }

  /// The motion on the clamped spline through the knots, of which there must be at least two.
  MotionEvaluator& on_spline() {
    if (!fine) {
      fine.emplace(problem, make_dense_spline(task, task.impulse ? kDenseImpulse : kDensePath));
    }
    return *fine;
  }

  /// The block of a knot of an impulse.
  int block_of(const SchemeMaps& maps, int knot) const {
    const int instant = maps.smooth() ? knot * ((maps.instants() - 1) / task.k) : knot;
    return instant - (start_is_block(task, maps) ? 0 : 1);
  }

  /// Solves for the task's t_h, or for every t_h, and keeps the best.
  void solve_best(TrajectoryProgram& p, TrajectorySolver& with, TrajectorySolution& best,
                  int& t_h) {
    if (!task.impulse) {
      with.solve(p, best);
      return;
    }
    const int from = task.t_h > 0 ? task.t_h : 1, to = task.t_h > 0 ? task.t_h : task.k;
    for (int knot = from; knot <= to; ++knot) {
      p.peak = block_of(motion.maps(), knot);
      TrajectorySolution& each = knot == from ? best : other;
      with.solve(p, each);
      if (knot == from) {
        t_h = knot;
        continue;
      }
      const bool better =
          each.status == Status::kOptimal &&
          (best.status != Status::kOptimal || each.value - each.price > best.value - best.price);
      if (!better) continue;
      std::swap(best, other);
      t_h = knot;
    }
    p.peak = block_of(motion.maps(), t_h);
  }

  /// Uses the hard program's answer if there is one, because that program is cheaper to solve. Its
  /// answer is also that of the elastic program unless a multiplier exceeds the weight of the
  /// slack; then slack costs less than a smaller wrench. If t_h is free, the best t_h may need
  /// slack, so the elastic program is solved first.
  void solve_elastic() {
    const bool several = task.impulse && task.t_h == 0;
    if (!several && solve_hard()) return;
    solve_best(elastic, *elastic_solver, elastic_solution, trajectory.t_h);
    if (several && elastic_solution.status != Status::kOptimal) solve_hard();
  }

  bool solve_hard() {
    elastic.rho = kInfinity;
    solve_best(elastic, *solver, elastic_solution, trajectory.t_h);
    elastic.rho = kElasticWeight;
    return elastic_solution.status == Status::kOptimal;
  }

  void pull_back(const TrajectoryProgram& p, const TrajectorySolution& solution,
                 Eigen::MatrixXd& gradient) {
    motion.linearize(trajectory.instants, slopes);
    const Eigen::Index skipped =
        static_cast<Eigen::Index>(trajectory.instants.size()) - static_cast<Eigen::Index>(p.size());
    lambda.setZero(problem.robot.velocities(), motion.maps().instants());
    lambda.rightCols(lambda.cols() - skipped) = solution.lambda;
    motion.pull_back(slopes, lambda, all_gradient);
    gradient = all_gradient.middleRows(motion.maps().before, motion.maps().rows());
  }

  const Problem& problem;
  const MotionTask task;
  const Wrench wrench;
  const bool check_collision;
  MotionEvaluator motion;
  TrajectoryProgram program, elastic, bordered;
  std::unique_ptr<TrajectorySolver> solver, elastic_solver;
  Kinematics<double> links;
  std::vector<NearPair> near;
  KnotRows rows;
  DependentRows following;
  std::vector<MotionSlopes> slopes;
  TrajectorySolution elastic_solution, other;
  Eigen::MatrixXd Q, lambda, all_gradient, G;
  std::optional<MotionEvaluator> fine;
  Trajectory trajectory;
};

TrajectoryEvaluator::TrajectoryEvaluator(const Problem& problem, Wrench wrench,
                                         const TrajectorySolverMaker& make, bool check_collision)
    : workspace_(std::make_unique<Workspace>(problem, wrench, make, check_collision)) {
  require_no_scenarios(problem, "trajectory");
}
TrajectoryEvaluator::~TrajectoryEvaluator() = default;

const std::vector<NearPair>& TrajectoryEvaluator::near_pairs(const Eigen::MatrixXd& knots,
                                                             double within) {
  Workspace& ws = *workspace_;
  ws.near.clear();
  if (!ws.check_collision) return ws.near;
  find_near_pairs(ws.problem, ws.motion, all_knots(ws.task, knots), within, ws.links, ws.near);
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
  trajectory.between_knots_reason = "";
  ws.Q = all_knots(ws.task, knots);
  ws.motion.evaluate(ws.Q, trajectory.instants);
  const std::string violation = ws.violation();
  set_instants(ws.problem, ws.task, ws.wrench, ws.motion.maps(), trajectory.instants, ws.program);
  trajectory.collision = ws.collision();
  if (!violation.empty()) {
    trajectory.conclude(Status::kInvalidPosture, violation);
    return trajectory;
  }
  ws.solve_best(ws.program, *ws.solver, trajectory.solution, trajectory.t_h);
  trajectory.conclude(trajectory.solution.status, trajectory.solution.reason.c_str());
  if (trajectory.status != Status::kOptimal) return trajectory;
  trajectory.value = trajectory.solution.value;
  trajectory.solution.residual = recheck(ws.program, trajectory.solution);
  if (!trajectory.solution.residual.within(kVerified * (1 + std::abs(trajectory.value)))) {
    trajectory.conclude(Status::kNumericalError, "the answer does not satisfy its program");
    return trajectory;
  }
  read_efforts(ws.problem, ws.task, ws.program, trajectory.solution, trajectory.instants);
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
  }
  MotionEvaluator& fine = ws.on_spline();
  const SchemeMaps& maps = fine.maps();
  TrajectoryProgram program = make_trajectory_program(ws.problem, task, ws.wrench, maps);
  std::vector<Instant> instants;
  fine.evaluate(ws.Q, instants);
  if (fine.lost() >= 0) {
    trajectory.between_knots_reason = motion_violation(ws.problem, fine, instants);
    return;
  }
  set_instants(ws.problem, ws.task, ws.wrench, maps, instants, program);
  program.rho = kElasticWeight;
  if (task.impulse && task.start == Start::kStatic) {
    program.instants[0].w_max = ws.program.instants[0].w_max;
  }
  if (task.impulse) program.peak = ws.block_of(maps, trajectory.t_h);
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
  set_instants(ws.problem, ws.task, ws.wrench, ws.motion.maps(), trajectory.instants, ws.elastic);
  ws.solve_elastic();
  const TrajectorySolution& solution = ws.elastic_solution;
  trajectory.conclude(solution.status, solution.reason.c_str());
  if (solution.status != Status::kOptimal) return -kInfinity;
  read_efforts(ws.problem, ws.task, ws.elastic, solution, trajectory.instants);
  if (gradient) ws.pull_back(ws.elastic, solution, *gradient);
  return solution.value - solution.price;
}

bool TrajectoryEvaluator::coupled() const {
  const TrajectorySolution& solution = workspace_->elastic_solution;
  return solution.price > kNoPrice || (solution.mu.array().abs() > kNoMultiplier).any();
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
  set_instants(ws.problem, ws.task, ws.wrench, ws.motion.maps(), ws.trajectory.instants,
               ws.elastic);
  ws.other.u.setZero(ws.problem.robot.actuators(), ws.elastic.size());
  ws.other.w = w;
  read_efforts(ws.problem, ws.task, ws.elastic, ws.other, ws.trajectory.instants);
  return linearize();
}

TrajectoryProgram& TrajectoryEvaluator::linearize() {
  Workspace& ws = *workspace_;
  if (ws.trajectory.instants.size() < ws.elastic.instants.size()) {
    throw std::logic_error("linearize: got no trajectory, expected one that was evaluated");
  }
  TrajectoryProgram& program = ws.bordered;
  program = ws.elastic;
  const std::size_t skipped = ws.trajectory.instants.size() - program.instants.size();
  ws.motion.linearize(ws.trajectory.instants, ws.slopes);
  ws.following = make_dependent_rows(ws.problem, ws.motion, ws.trajectory.instants, ws.slopes);
  program.G.resize(program.instants.size());
  const Eigen::Index r = ws.problem.redundancy();
  const SchemeMaps& maps = ws.motion.maps();
  for (std::size_t i = 0; i < program.instants.size(); ++i) {
    ws.motion.push_forward(ws.slopes, static_cast<int>(i + skipped), ws.G);
    program.G[i] = -ws.G.middleCols(maps.before * r, maps.rows() * r);
  }
  return program;
}

}  // namespace maxwrench
