#include "lib/trajectory/workspace.h"

#include <stdexcept>

#include "lib/robot/gears.h"
#include "lib/scenario/scenario_list.h"
#include "lib/trajectory/clearance.h"
#include "lib/trajectory/limits.h"

namespace maxwrench {

MotionTask task_of(const Problem& problem) {
  if (problem.contact) {
    throw std::invalid_argument(problem.name +
                                ": got a second contact, expected a task in time without one");
  }
  if (problem.motion) {
    const bool open = problem.motion->impulse && problem.motion->start == Start::kZero;
    if (open && problem.motion->thruster_lag > 0 && !problem.scenarios.empty()) {
      throw std::invalid_argument(problem.name +
                                  ": start.kind: got zero, expected another start for a list of "
                                  "scenarios with motion.thruster_lag");
    }
    return *problem.motion;
  }
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

TrajectoryEvaluator::Workspace::Workspace(const Problem& p, Wrench w,
                                          const TrajectorySolverMaker& make, bool check)
    : problem(p),
      task(task_of(p)),
      scenarios(motion_scenarios(p, w)),
      check_collision(check && p.robot.collision != nullptr),
      motion(p, make_scheme(task)),
      program(make_trajectory_program(p, task, scenarios, motion.maps())),
      elastic(program),
      solver(make()),
      elastic_solver(make()),
      links(p.robot),
      rows(knot_rows(p, task, motion.maps())) {
  elastic.rho = kElasticWeight;
  if (task.impulse && task.start == Start::kStatic) bound_start(make);
}

void TrajectoryEvaluator::Workspace::bound_start(const TrajectorySolverMaker& make) {
  Q = all_knots(task, task.theta_0.transpose().replicate(task.k, 1));
  motion.evaluate(Q, trajectory.instants);
  set_instants(problem, task, scenarios, motion.maps(), trajectory.instants, program);
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const std::size_t first = s * static_cast<std::size_t>(program.length());
    if (program.instants[first].columns() == 0) continue;
    TrajectoryProgram start = program;
    start.scenarios = 1;
    start.instants.assign(1, program.instants[first]);
    start.instants[0].w_min.setConstant(-kInfinity);
    start.instants[0].w_max.setConstant(kInfinity);
    start.first_min = start.instants[0].actuation->u_min;
    start.first_max = start.instants[0].actuation->u_max;
    start.du_max.resize(start.du_max.rows(), 0);
    start.lag.resize(0, 0);
    start.peak = 0;
    TrajectorySolution best;
    make()->solve(start, best);
    if (best.status != Status::kOptimal || !(best.value >= 0)) {
      const bool list = !problem.scenarios.empty();
      throw std::invalid_argument(
          problem.name + ": start.theta_r: got a posture that cannot hold itself" +
          (list ? " (" + describe(problem.scenarios, scenarios[s].choice) + ")" : "") +
          ", expected one with a static capability");
    }
    for (TrajectoryProgram* each : {&program, &elastic}) {
      each->instants[first].w_max.setConstant(best.value);
    }
  }
}

void TrajectoryEvaluator::Workspace::require_table(const Eigen::MatrixXd& knots) const {
  if (knots.rows() != motion.maps().rows() || knots.cols() != problem.redundancy()) {
    throw std::invalid_argument("theta_r: got a table of " + std::to_string(knots.rows()) + " x " +
                                std::to_string(knots.cols()) + " numbers, expected " +
                                std::to_string(motion.maps().rows()) + " x " +
                                std::to_string(problem.redundancy()) + " for " + problem.name);
  }
  if (!knots.allFinite()) {
    throw std::invalid_argument("theta_r: got a value that is not a finite number");
  }
}

std::string TrajectoryEvaluator::Workspace::violation() const {
  const std::string of_knots = knots_violation(problem, motion.maps(), Q);
  return of_knots.empty() ? motion_violation(problem, motion, trajectory.instants) : of_knots;
}

std::string TrajectoryEvaluator::Workspace::collision() {
  if (!check_collision) return "";
  return first_collision(problem, motion, trajectory.instants, task.clear_at_instants, links);
}

MotionEvaluator& TrajectoryEvaluator::Workspace::on_spline() {
  if (!fine) {
    fine.emplace(problem, make_dense_spline(task, task.impulse ? kDenseImpulse : kDensePath));
  }
  return *fine;
}

int TrajectoryEvaluator::Workspace::block_of(const SchemeMaps& maps, int knot) const {
  const int instant = maps.smooth() ? knot * ((maps.instants() - 1) / task.k) : knot;
  return instant - (start_is_block(task, maps) ? 0 : 1);
}

void TrajectoryEvaluator::Workspace::solve_best(TrajectoryProgram& p, TrajectorySolver& with,
                                                TrajectorySolution& best, int& t_h) {
  if (!task.impulse) {
    with.solve(p, best);
    return;
  }
  const int from = task.t_h > 0 ? task.t_h : 1, to = task.t_h > 0 ? task.t_h : task.k;
  for (int knot = from; knot <= to; ++knot) {
    set_peak(scenarios, block_of(motion.maps(), knot), p);
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
  set_peak(scenarios, block_of(motion.maps(), t_h), p);
}

void TrajectoryEvaluator::Workspace::solve_elastic() {
  const bool several = task.impulse && task.t_h == 0;
  if (!several && solve_hard()) return;
  solve_best(elastic, *elastic_solver, elastic_solution, trajectory.t_h);
  if (several && elastic_solution.status != Status::kOptimal) solve_hard();
}

bool TrajectoryEvaluator::Workspace::solve_hard() {
  elastic.rho = kInfinity;
  solve_best(elastic, *solver, elastic_solution, trajectory.t_h);
  elastic.rho = kElasticWeight;
  return elastic_solution.status == Status::kOptimal;
}

void TrajectoryEvaluator::Workspace::read(const TrajectoryProgram& p,
                                          const TrajectorySolution& solution, int scenario) {
  read_efforts(problem, task, p, solution, scenarios[static_cast<std::size_t>(scenario)], scenario,
               trajectory.instants);
}

void TrajectoryEvaluator::Workspace::read_deciding(const TrajectoryProgram& p,
                                                   const TrajectorySolution& solution) {
  const DecidingBlock decides = deciding_block(p, solution.pi);
  const auto skipped = static_cast<int>(trajectory.instants.size()) - p.length();
  trajectory.decides = scenarios[static_cast<std::size_t>(decides.scenario)].choice;
  trajectory.decides_at = decides.block + skipped;
  read(p, solution, decides.scenario);
  trajectory.decides.c = trajectory.instants[static_cast<std::size_t>(trajectory.decides_at)].c;
}

void TrajectoryEvaluator::Workspace::pull_back(const TrajectoryProgram& p,
                                               const TrajectorySolution& solution,
                                               Eigen::MatrixXd& gradient) {
  const Eigen::Index length = p.length();
  const int decides = deciding_block(p, solution.pi).scenario;
  lambda.setZero(problem.robot.velocities(), motion.maps().instants());
  const auto add = [&](int scenario) {
    motion.linearize(trajectory.instants, slopes);
    lambda.rightCols(length) = solution.lambda.middleCols(scenario * length, length);
    motion.pull_back(slopes, lambda, all_gradient);
    gradient += all_gradient.middleRows(motion.maps().before, motion.maps().rows());
  };
  gradient.setZero(motion.maps().rows(), problem.redundancy());
  // The slopes are those of the wrenches of the scenario that is read. The last one stays.
  for (int s = 0; s < p.scenarios; ++s) {
    if (s == decides || solution.lambda.middleCols(s * length, length).isZero(0)) continue;
    read(p, solution, s);
    add(s);
  }
  if (p.scenarios > 1) read(p, solution, decides);
  add(decides);
}

}  // namespace maxwrench
