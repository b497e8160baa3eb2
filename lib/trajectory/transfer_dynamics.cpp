#include "lib/trajectory/transfer_dynamics.h"

#include <stdexcept>
#include <string>

#include "lib/trajectory/carried.h"

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

TransferDynamics::TransferDynamics(const Problem& problem)
    : problem_(require_transfer(problem)),
      motion_(problem, one_point()),
      Q_(3, problem.redundancy()) {}

void TransferDynamics::set(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           const Eigen::VectorXd& a, double m) {
  Q_.row(0) = q;
  Q_.row(1) = v;
  Q_.row(2) = a;
  motion_.evaluate(Q_, instants_);
  Instant& instant = instants_.front();
  const PathPoint& x = motion_.maps().x.front();
  instant.c = carried_wrench<double>(problem_.robot, *problem_.motion->payload,
                                     {x.pose.R, x.twist, x.acceleration});
  instant.h = m * instant.c;
  instant.factor = m;
  motion_.linearize(instants_, slopes_);
  g_.noalias() = instant.J.transpose() * instant.c;
  f_ = instant.tau_d + m * g_;
}

}  // namespace maxwrench
