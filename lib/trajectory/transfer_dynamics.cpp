#include "lib/trajectory/transfer_dynamics.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "lib/trajectory/carried.h"
#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

const Problem& require_transfer(const Problem& problem) {
  if (!problem.motion || !problem.motion->transfer) {
    throw std::invalid_argument("task: got " + problem.name + ", a " + problem.type() +
                                " task, expected a transfer");
  }
  if (problem.robot.velocities() != problem.redundancy()) {
    throw std::invalid_argument("robot: got " + std::to_string(problem.robot.velocities()) +
                                " velocities, expected those of the " +
                                std::to_string(problem.redundancy()) +
                                " joints that the transfer moves: " + problem.name);
  }
  return problem;
}

/// One instant, whose three "knots" are theta_r and its two derivatives.
SchemeMaps one_point() {
  SchemeMaps maps;
  maps.t = {0};
  maps.x.resize(1);
  maps.knot_at = {-1, -1, -1};
  maps.P = Eigen::RowVector3d::UnitX();
  maps.V = Eigen::RowVector3d::UnitY();
  maps.A = Eigen::RowVector3d::UnitZ();
  maps.moves = Eigen::VectorXd::Ones(1);
  return maps;
}

}  // namespace

struct TransferDynamics::Workspace {
  explicit Workspace(const Problem& task)
      : problem(task), motion(task, one_point()), Q(3, task.redundancy()) {}

  const Problem& problem;
  MotionEvaluator motion;
  std::vector<Instant> instants;
  std::vector<MotionSlopes> slopes;
  Eigen::MatrixXd Q;  ///< 3×n: the rows q, v and a
};

TransferDynamics::TransferDynamics(const Problem& problem)
    : workspace_(std::make_unique<Workspace>(require_transfer(problem))),
      f_(Eigen::VectorXd::Zero(problem.redundancy())),
      g_(f_) {}
TransferDynamics::~TransferDynamics() = default;

const Eigen::MatrixXd& TransferDynamics::by_q() const { return workspace_->slopes.front().place; }
const Eigen::MatrixXd& TransferDynamics::by_v() const { return workspace_->slopes.front().rate; }
const Eigen::MatrixXd& TransferDynamics::M() const { return workspace_->slopes.front().bend; }

void TransferDynamics::set(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           const Eigen::VectorXd& a, double m) {
  Workspace& ws = *workspace_;
  ws.Q.row(0) = q;
  ws.Q.row(1) = v;
  ws.Q.row(2) = a;
  ws.motion.evaluate(ws.Q, ws.instants);
  Instant& instant = ws.instants.front();
  const PathPoint& x = ws.motion.maps().x.front();
  instant.c = carried_wrench<double>(ws.problem.robot, *ws.problem.motion->payload,
                                     {x.pose.R, x.twist, x.acceleration});
  instant.h = m * instant.c;
  instant.factor = m;
  ws.motion.linearize(ws.instants, ws.slopes);
  g_.noalias() = instant.J.transpose() * instant.c;
  f_ = instant.tau_d + m * g_;
}

}  // namespace maxwrench
