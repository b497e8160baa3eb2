#include "lib/trajectory/instant_evaluator.h"

#include <algorithm>

#include "lib/robot/chain.h"
#include "lib/trajectory/limits.h"
#include "lib/trajectory/motion_evaluator.h"
#include "lib/trajectory/program.h"
#include "lib/trajectory/workspace.h"

namespace maxwrench {
namespace {

/// With one knot the robot rests; a spline needs two.
SchemeMaps spline_of(const MotionTask& task, int per_interval) {
  const bool one = task.k + (task.impulse ? 1 : 0) < 2;
  return one ? make_scheme(task) : make_dense_spline(task, per_interval);
}

/// The maps of the first instant, without a start that is a block of its own.
SchemeMaps first_instant_of(const SchemeMaps& maps) {
  SchemeMaps one;
  one.t.assign(1, 0);
  one.x.assign(1, maps.x.front());
  one.P.setZero(1, maps.knots());
  return one;
}

}  // namespace

InstantEvaluator::InstantEvaluator(const Problem& problem, Wrench wrench, const SolverMaker& make,
                                   bool check_collision)
    : problem_(problem),
      task_(task_of(problem)),
      check_collision_(check_collision && problem.robot.collision != nullptr),
      per_interval_(task_.instants_per_interval),
      maps_(spline_of(task_, per_interval_)),
      scenarios_(motion_scenarios(problem, wrench)),
      one_(first_instant_of(maps_)),
      program_(make_trajectory_program(problem, task_, scenarios_, one_)),
      tracker_(problem),
      dynamics_(problem.robot),
      links_(problem.robot),
      instants_(1) {
  for (const WrenchProgram& block : program_.instants) {
    const bool free = block.columns() == 1 && block.actuation->has_facets;
    solvers_.push_back(make(free));
  }
  instants_[0].q.setZero(static_cast<Eigen::Index>(problem.robot.joints.size()));
}

void InstantEvaluator::restart() {
  tracker_.restart();
  fresh_ = true;
}

/// Where the straight line from the last instant has no solution, one from the guess may.
const char* InstantEvaluator::move_to(const PathPoint& x, const Eigen::VectorXd& theta_r,
                                      const Eigen::VectorXd& rate,
                                      const Eigen::VectorXd& acceleration) {
  const char* reason = tracker_.set(x, theta_r, rate, acceleration);
  if (reason && !fresh_) {
    tracker_.restart();
    reason = tracker_.set(x, theta_r, rate, acceleration);
  }
  fresh_ = false;
  if (reason) restart();
  return reason;
}

double InstantEvaluator::value(int instant, const Eigen::VectorXd& theta_r,
                               const Eigen::VectorXd& rate, const Eigen::VectorXd& acceleration) {
  const PathPoint& x = maps_.x[static_cast<std::size_t>(instant)];
  if (move_to(x, theta_r, rate, acceleration)) return -kInfinity;
  const RobotMotion<double>& motion = tracker_.motion();
  Instant& at = instants_[0];
  at.t = maps_.t[static_cast<std::size_t>(instant)];
  at.end_effector = x.pose;
  at.base = motion.base();
  at.q = motion.q();
  at.v = maps_.moves[instant] * motion.v();
  at.v_dot = maps_.moves[instant] * motion.v_dot();
  if (maps_.moves[instant] != 0 && leaves_path(motion, x, maps_.smooth())) return -kInfinity;
  if (!base_reaches(problem_.robot, at.base)) return -kInfinity;
  if (!dependent_joints_hold(problem_, at.q, at.v)) return -kInfinity;
  dynamics_.set_configuration(at.base.R, at.q);
  dynamics_.inverse(at.v, at.v_dot, at.tau_d);
  const auto tool = static_cast<std::size_t>(problem_.end_effector);
  dynamics_.kinematics().jacobian(problem_.robot.end_effectors[tool], at.base.R, at.J);
  if (task_.has_factor()) one_.x[0] = x;  // the wrench depends on the motion of the end effector
  set_instants(problem_, task_, scenarios_, one_, instants_, program_);
  return least_of_scenarios();
}

double InstantEvaluator::least_of_scenarios() {
  double least = kInfinity;
  for (std::size_t s = 0; s < program_.instants.size(); ++s) {
    solvers_[s]->solve(program_.instants[s], false, capability_);
    if (capability_.status == Status::kUnbounded) continue;
    if (capability_.status != Status::kOptimal) return -kInfinity;
    const bool counts = program_.common || (program_.instants[s].c_w.array() != 0).any();
    if (counts) least = std::min(least, capability_.beta);
  }
  return least;
}

bool InstantEvaluator::collides() {
  if (!check_collision_) return false;
  links_.set_joints(q());
  return problem_.robot.collision->colliding_pair(links_.links()) >= 0;
}

}  // namespace maxwrench
