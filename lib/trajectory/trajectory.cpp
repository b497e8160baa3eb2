#include "maxwrench/trajectory.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lib/trajectory/clearance.h"
#include "lib/trajectory/limits.h"
#include "lib/trajectory/motion.h"
#include "lib/trajectory/program.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// The slack [N, N m] that `continuous` forgives.
constexpr double kSlackForgiven = 0.05;
/// Less is rounding of an interior point.
constexpr double kNoPrice = 1e-7, kNoMultiplier = 1e-7;
/// A verdict counts if its figures are within this part of 1 + |value|.
constexpr double kVerified = 1e-7;

/// The task in time; a static one holds its pose at one knot.
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
  MotionTask task;
  task.path = Path::constant(problem.pose, task.T);
  task.scheme = Scheme::kForward;
  return task;
}

}  // namespace

struct PlanEvaluator::Workspace {
  Workspace(const Problem& p, Wrench w, const PlanSolverMaker& make, bool check)
      : problem(p),
        task(task_of(p)),
        wrench(w),
        check_collision(check && p.robot.collision != nullptr),
        motion(p, make_scheme(task)),
        program(make_plan_program(p, task, w, motion.maps())),
        elastic(program),
        solver(make()),
        elastic_solver(make()),
        links(p.robot),
        rows(knot_rows(p, task, motion.maps())) {
    elastic.rho = kElasticWeight;
    if (task.impulse && task.start == Start::kStatic) bound_start(make);
  }

  /// w_0 is at most the static capability at theta_0.
  void bound_start(const PlanSolverMaker& make) {
    Q = all_knots(task, task.theta_0.transpose().replicate(task.k, 1));
    motion.evaluate(Q, plan.instants);
    set_instants(problem, task, wrench, motion.maps(), plan.instants, program);
    PlanProgram start = program;
    start.instants.resize(1);
    start.instants[0].w_min.setConstant(-kInfinity);
    start.instants[0].w_max.setConstant(kInfinity);
    start.du_max.resize(start.du_max.rows(), 0);
    start.peak = 0;
    PlanSolution best;
    make()->solve(start, best);
    if (best.status != Status::kOptimal || !(best.value >= 0)) {
      throw std::invalid_argument(problem.name +
                                  ": start.theta_r: got a posture that cannot hold " +
                                  "itself, expected one with a static capability");
    }
    for (PlanProgram* each : {&program, &elastic}) {
      each->instants[0].w_max.setConstant(best.value);
    }
  }

  void require_table(const Eigen::MatrixXd& knots) const {
    if (knots.rows() != task.k || knots.cols() != problem.redundancy()) {
      throw std::invalid_argument("theta_r: got a table of " + std::to_string(knots.rows()) +
                                  " x " + std::to_string(knots.cols()) + " numbers, expected " +
                                  std::to_string(task.k) + " x " +
                                  std::to_string(problem.redundancy()) + " for " + problem.name);
    }
    if (!knots.allFinite()) {
      throw std::invalid_argument("theta_r: got a value that is not a finite number");
    }
  }

  /// Empty, or why the knots or their motion are no answer.
  std::string violation() const {
    const std::string of_knots = knots_violation(problem, motion.maps(), Q);
    return of_knots.empty() ? motion_violation(problem, motion, plan.instants) : of_knots;
  }

  /// Empty, or the first knot that collides.
  std::string collision() {
    return check_collision ? knot_collision(problem, motion, plan.instants, links) : "";
  }

  /// On the clamped spline through the knots, of which there are at least two.
  MotionEvaluator& on_spline() {
    if (!fine) {
      fine.emplace(problem,
                   make_continuous(task, task.impulse ? kContinuousHeave : kContinuousPath));
    }
    return *fine;
  }

  /// The block of a knot of a heave.
  int block_of(const SchemeMaps& maps, int knot) const {
    const int instant = maps.smooth() ? knot * ((maps.instants() - 1) / task.k) : knot;
    return instant - (start_is_block(task, maps) ? 0 : 1);
  }

  /// Solves for the task's t_h, or for each one and keeps the best.
  void solve_best(PlanProgram& p, PlanSolver& with, PlanSolution& best, int& t_h) {
    if (!task.impulse) {
      with.solve(p, best);
      return;
    }
    const int from = task.t_h > 0 ? task.t_h : 1, to = task.t_h > 0 ? task.t_h : task.k;
    for (int knot = from; knot <= to; ++knot) {
      p.peak = block_of(motion.maps(), knot);
      PlanSolution& each = knot == from ? best : other;
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

  /// The hard program's answer where it has one: it is cheaper, and that of the elastic one too but
  /// where a multiplier exceeds the weight of the slack, so that slack is cheaper than a wrench.
  /// The best t_h of several may be one that needs slack, and is sought with it first.
  void solve_elastic() {
    const bool several = task.impulse && task.t_h == 0;
    if (!several && solve_hard()) return;
    solve_best(elastic, *elastic_solver, elastic_solution, plan.t_h);
    if (several && elastic_solution.status != Status::kOptimal) solve_hard();
  }

  bool solve_hard() {
    elastic.rho = kInfinity;
    solve_best(elastic, *solver, elastic_solution, plan.t_h);
    elastic.rho = kElasticWeight;
    return elastic_solution.status == Status::kOptimal;
  }

  void pull_back(const PlanProgram& p, const PlanSolution& solution, Eigen::MatrixXd& gradient) {
    motion.linearize(plan.instants, slopes);
    const Eigen::Index skipped =
        static_cast<Eigen::Index>(plan.instants.size()) - static_cast<Eigen::Index>(p.size());
    lambda.setZero(problem.robot.velocities(), motion.maps().instants());
    lambda.rightCols(lambda.cols() - skipped) = solution.lambda;
    motion.pull_back(slopes, lambda, all_gradient);
    gradient = all_gradient.bottomRows(task.k);
  }

  const Problem& problem;
  const MotionTask task;
  const Wrench wrench;
  const bool check_collision;
  MotionEvaluator motion;
  PlanProgram program, elastic, bordered;
  std::unique_ptr<PlanSolver> solver, elastic_solver;
  Kinematics<double> links;
  std::vector<NearPair> near;
  KnotRows rows;
  FollowingRows following;
  std::vector<MotionSlopes> slopes;
  PlanSolution elastic_solution, other;
  Eigen::MatrixXd Q, lambda, all_gradient, G;
  std::optional<MotionEvaluator> fine;
  Plan plan;
};

PlanEvaluator::PlanEvaluator(const Problem& problem, Wrench wrench, const PlanSolverMaker& make,
                             bool check_collision)
    : workspace_(std::make_unique<Workspace>(problem, wrench, make, check_collision)) {}
PlanEvaluator::~PlanEvaluator() = default;

const std::vector<NearPair>& PlanEvaluator::near_pairs(const Eigen::MatrixXd& knots,
                                                       double within) {
  Workspace& ws = *workspace_;
  ws.near.clear();
  if (!ws.check_collision) return ws.near;
  find_near_pairs(ws.problem, ws.motion, all_knots(ws.task, knots), within, ws.links, ws.near);
  return ws.near;
}

const Plan& PlanEvaluator::plan() const { return workspace_->plan; }
const PlanProgram& PlanEvaluator::program() const { return workspace_->program; }
const KnotRows& PlanEvaluator::rows() const { return workspace_->rows; }
const FollowingRows& PlanEvaluator::following_rows() const { return workspace_->following; }
int PlanEvaluator::knots() const { return workspace_->task.k; }
bool PlanEvaluator::smooth() const { return workspace_->motion.maps().smooth(); }
bool PlanEvaluator::starts() const { return workspace_->motion.maps().starts; }

const Plan& PlanEvaluator::evaluate(const Eigen::MatrixXd& knots) {
  Workspace& ws = *workspace_;
  Plan& plan = ws.plan;
  ws.require_table(knots);
  plan.knots = knots;
  plan.value = plan.continuous = std::numeric_limits<double>::quiet_NaN();
  plan.continuous_reason = "";
  ws.Q = all_knots(ws.task, knots);
  ws.motion.evaluate(ws.Q, plan.instants);
  const std::string violation = ws.violation();
  set_instants(ws.problem, ws.task, ws.wrench, ws.motion.maps(), plan.instants, ws.program);
  plan.collision = ws.collision();
  if (!violation.empty()) {
    plan.conclude(Status::kInvalidPosture, violation);
    return plan;
  }
  ws.solve_best(ws.program, *ws.solver, plan.solution, plan.t_h);
  plan.conclude(plan.solution.status, plan.solution.reason.c_str());
  if (plan.status != Status::kOptimal) return plan;
  plan.value = plan.solution.value;
  plan.solution.residual = recheck(ws.program, plan.solution);
  if (!plan.solution.residual.within(kVerified * (1 + std::abs(plan.value)))) {
    plan.conclude(Status::kNumericalError, "the answer does not satisfy its program");
    return plan;
  }
  read_efforts(ws.problem, ws.task, ws.program, plan.solution, plan.instants);
  ws.pull_back(ws.program, plan.solution, plan.gradient);
  return plan;
}

void PlanEvaluator::evaluate_continuous(PlanSolver* by) {
  Workspace& ws = *workspace_;
  PlanSolver& solver = by ? *by : *ws.elastic_solver;
  Plan& plan = ws.plan;
  const MotionTask& task = ws.task;
  if (ws.Q.rows() < 2) {
    plan.continuous = plan.value;
    plan.continuous_reason = plan.reason;
    return;
  }
  MotionEvaluator& fine = ws.on_spline();
  const SchemeMaps& maps = fine.maps();
  PlanProgram program = make_plan_program(ws.problem, task, ws.wrench, maps);
  std::vector<Instant> instants;
  fine.evaluate(ws.Q, instants);
  if (fine.lost() >= 0) {
    plan.continuous_reason = motion_violation(ws.problem, fine, instants);
    return;
  }
  set_instants(ws.problem, ws.task, ws.wrench, maps, instants, program);
  program.rho = kElasticWeight;
  if (task.impulse && task.start == Start::kStatic) {
    program.instants[0].w_max = ws.program.instants[0].w_max;
  }
  if (task.impulse) program.peak = ws.block_of(maps, plan.t_h);
  PlanSolution solution;
  solver.solve(program, solution);
  if (solution.status != Status::kOptimal) {  // perhaps slack is cheaper than a wrench
    program.rho = kInfinity;
    solver.solve(program, solution);
  }
  if (solution.status != Status::kOptimal) {
    plan.continuous_reason = solution.reason;
    return;
  }
  const double slack = solution.s.size() == 0 ? 0 : solution.s.cwiseAbs().maxCoeff();
  if (!(slack <= kSlackForgiven)) {
    plan.continuous_reason =
        "a balance on the spline through the knots lacks " + std::to_string(slack) + " N or N m";
    return;
  }
  plan.continuous = solution.value;
}

std::optional<Clearance> PlanEvaluator::least_clearance() {
  Workspace& ws = *workspace_;
  if (!ws.check_collision) return {};
  MotionEvaluator& motion = ws.Q.rows() < 2 ? ws.motion : ws.on_spline();
  return find_least_clearance(ws.problem, motion, ws.Q, ws.links);
}

double PlanEvaluator::evaluate_elastic(const Eigen::MatrixXd& knots, Eigen::MatrixXd* gradient) {
  Workspace& ws = *workspace_;
  Plan& plan = ws.plan;
  ws.require_table(knots);
  plan.knots = knots;
  ws.Q = all_knots(ws.task, knots);
  ws.motion.evaluate(ws.Q, plan.instants);
  std::string violation = ws.violation();
  if (violation.empty()) violation = ws.collision();
  if (!violation.empty()) {
    plan.conclude(Status::kInvalidPosture, violation);
    return -kInfinity;
  }
  set_instants(ws.problem, ws.task, ws.wrench, ws.motion.maps(), plan.instants, ws.elastic);
  ws.solve_elastic();
  const PlanSolution& solution = ws.elastic_solution;
  plan.conclude(solution.status, solution.reason.c_str());
  if (solution.status != Status::kOptimal) return -kInfinity;
  read_efforts(ws.problem, ws.task, ws.elastic, solution, plan.instants);
  if (gradient) ws.pull_back(ws.elastic, solution, *gradient);
  return solution.value - solution.price;
}

bool PlanEvaluator::coupled() const {
  const PlanSolution& solution = workspace_->elastic_solution;
  return solution.price > kNoPrice || (solution.mu.array().abs() > kNoMultiplier).any();
}

const PlanSolution& PlanEvaluator::elastic_solution() const { return workspace_->elastic_solution; }

PlanProgram& PlanEvaluator::linearize(const Eigen::MatrixXd& knots,
                                      const std::vector<Eigen::VectorXd>& w) {
  Workspace& ws = *workspace_;
  ws.require_table(knots);
  ws.Q = all_knots(ws.task, knots);
  ws.motion.evaluate(ws.Q, ws.plan.instants);
  set_instants(ws.problem, ws.task, ws.wrench, ws.motion.maps(), ws.plan.instants, ws.elastic);
  ws.other.u.setZero(ws.problem.robot.actuators(), ws.elastic.size());
  ws.other.w = w;
  read_efforts(ws.problem, ws.task, ws.elastic, ws.other, ws.plan.instants);
  return linearize();
}

PlanProgram& PlanEvaluator::linearize() {
  Workspace& ws = *workspace_;
  if (ws.plan.instants.size() < ws.elastic.instants.size()) {
    throw std::logic_error("linearize: got no plan, expected one that was evaluated");
  }
  PlanProgram& program = ws.bordered;
  program = ws.elastic;
  const std::size_t skipped = ws.plan.instants.size() - program.instants.size();
  ws.motion.linearize(ws.plan.instants, ws.slopes);
  ws.following = make_following_rows(ws.problem, ws.motion, ws.plan.instants, ws.slopes);
  program.G.resize(program.instants.size());
  const Eigen::Index r = ws.problem.redundancy();
  for (std::size_t i = 0; i < program.instants.size(); ++i) {
    ws.motion.push_forward(ws.slopes, static_cast<int>(i + skipped), ws.G);
    program.G[i] = -ws.G.rightCols(ws.task.k * r);
  }
  return program;
}

}  // namespace maxwrench
