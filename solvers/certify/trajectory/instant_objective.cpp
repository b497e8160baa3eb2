#include <cmath>

#include "lib/robot/dynamics.h"
#include "lib/trajectory/robot_motion.h"
#include "maxwrench/lp_solver.h"
#include "solvers/certify/trajectory/instant_bound.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

/// With tau(q_ddot) = tau_0 + sum_j q_ddot_j m_j, the program is
///
///     max t   subject to   B u - t J'c - sum_j q_ddot_j m_j = tau_0
///
/// over u and q_ddot within their limits. The base may lack axes along which the water moves, so
/// the motion is that in axes of the world.
class InstantObjective final : public Objective {
 public:
  explicit InstantObjective(const PlanInstant& at)
      : at_(at),
        lower_(at.lower()),
        upper_(at.upper()),
        task_(task_in_current(at)),
        x_(at.x),
        motion_(task_),
        dynamics_(task_.robot),
        solver_(make_simplex()) {
    x_.twist.head<3>() += at.current;
  }

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  const Verdict& verdict() const override { return verdict_; }
  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<InstantObjective>(at_);
  }

  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* /*gradient*/) override {
    const Problem& task = task_;
    const Zonotope& set = task.robot.actuation;
    const Eigen::Index r = task.redundancy(), n = task.robot.velocities(), m = set.actuators();
    const Eigen::VectorXd q = x.head(r);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(r);
    const Eigen::VectorXd rates = x.size() > r ? Eigen::VectorXd(x.tail(r)) : none;
    Eigen::VectorXd tau_0, tau;
    load(q, rates, none, tau_0);
    if (at_.knot && collides()) return end(Status::kInvalidPosture);
    Eigen::MatrixXd A(n, m + 1 + r);
    dynamics_.kinematics().jacobian(
        task.robot.end_effectors[static_cast<std::size_t>(task.end_effector)], motion_.base().R,
        J_);
    A.leftCols(m) = set.B;
    A.col(m) = -J_.transpose() * task.c;
    for (Eigen::Index j = 0; j < r; ++j) {
      load(q, rates, Eigen::VectorXd::Unit(r, j), tau);
      A.col(m + 1 + j) = tau_0 - tau;
    }
    LinearProgram program;
    program.A = A.sparseView();
    program.A.makeCompressed();
    program.b = tau_0;
    program.c = Eigen::VectorXd::Unit(m + 1 + r, m);
    program.l.resize(m + 1 + r);
    program.u.resize(m + 1 + r);
    program.l << set.u_min, -kInfinity, at_.ranges.bend.low;
    program.u << set.u_max, kInfinity, at_.ranges.bend.high;
    LpSolution solution;
    solver_->solve(program, solution);
    if (solution.status != Status::kOptimal || !verified(program, solution)) {
      return end(solution.status == Status::kOptimal ? Status::kNumericalError : solution.status);
    }
    verdict_.conclude(Status::kOptimal);
    return solution.objective;
  }

 private:
  static Problem task_in_current(const PlanInstant& at) {
    Problem task = at.task;
    task.robot.current = at.current;
    return task;
  }

  void load(const Eigen::VectorXd& q, const Eigen::VectorXd& rates, const Eigen::VectorXd& bends,
            Eigen::VectorXd& tau) {
    motion_.set(x_, q, rates, bends);
    dynamics_.set_configuration(motion_.base().R, motion_.q());
    dynamics_.inverse(motion_.v(), motion_.v_dot(), tau);
  }

  bool collides() const {
    const CollisionChecker* const checker = task_.robot.collision.get();
    return checker && checker->colliding_pair(dynamics_.kinematics().links()) >= 0;
  }

  double end(Status status) {
    verdict_.conclude(status);
    return -kInfinity;
  }

  const PlanInstant& at_;
  Eigen::VectorXd lower_, upper_;
  Problem task_;  ///< in axes of the world
  PathPoint x_;
  RobotMotion<double> motion_;
  Dynamics dynamics_;
  std::unique_ptr<LpSolver> solver_;
  Verdict verdict_;
  Matrix6Xd J_;
};

}  // namespace

std::unique_ptr<Objective> make_instant_objective(const PlanInstant& at) {
  return std::make_unique<InstantObjective>(at);
}

}  // namespace maxwrench
