#include "lib/tank/ode.h"

#include <cmath>

#include "lib/tank/stopwatch.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

Vector6d six(double linear, double angular) {
  Vector6d values;
  values << Eigen::Vector3d::Constant(linear), Eigen::Vector3d::Constant(angular);
  return values;
}

}  // namespace

TankOde::TankOde(const Problem& problem, const Posture& posture, const TankOptions& options)
    : problem_(problem),
      tool_(problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)]),
      options_(options),
      dynamics_(problem.robot),
      stiffness_(six(options.cell.stiffness_linear, options.cell.stiffness_angular)),
      damping_(six(options.cell.damping_linear, options.cell.damping_angular)),
      rate_max_(
          problem.robot.u_rate_max.head(static_cast<Eigen::Index>(problem.robot.thrusters.size()))),
      noise_(Eigen::VectorXd::Zero(rate_max_.size())),
      v_d_(problem.robot.velocities()),
      tau_d_(problem.robot.velocities()),
      J_(6, problem.robot.velocities()) {
  motion_ = {posture.base, posture.q, Eigen::VectorXd::Zero(problem.robot.velocities())};
  dynamics_.set_configuration(posture.base.R, posture.q);
  anchor_.pose = posture.base * dynamics_.kinematics().end_effector(tool_);
}

void TankOde::start(const Motion& motion, const Eigen::VectorXd& u) {
  start_.resize(motion_size(problem_.robot) + rate_max_.size());
  write_motion(motion, start_);
  start_.tail(rate_max_.size()) = u.head(rate_max_.size());
  u_0_ = u_1_ = u;
}

void TankOde::command(double t_0, const Eigen::VectorXd& u_0, double t_1,
                      const Eigen::VectorXd& u_1, const Vector6d& h_0, const Vector6d& h_1) {
  t_0_ = t_0;
  t_1_ = t_1;
  u_0_ = u_0;
  u_1_ = u_1;
  exerted_0_ = h_0;
  exerted_1_ = h_1;
}

Eigen::VectorXd TankOde::efforts(double t) const {
  Eigen::VectorXd u = u_0_ + share(t) * (u_1_ - u_0_);
  u.head(rate_max_.size()) = start_.tail(rate_max_.size());
  return u;
}

Vector6d TankOde::displacement(double t, const Motion& motion) {
  return displacement(held(t).pose, motion);
}

Vector6d TankOde::displacement(const Pose<double>& from, const Motion& motion) {
  dynamics_.set_configuration(motion.base.R, motion.q);
  const Pose<double> tool = motion.base * dynamics_.kinematics().end_effector(tool_);
  Vector6d moved;
  moved << tool.p - from.p, logarithm(tool.R * from.R.transpose());
  return moved;
}

Vector6d TankOde::twist(const Motion& motion) {
  dynamics_.set_configuration(motion.base.R, motion.q);
  dynamics_.kinematics().jacobian(tool_, motion.base.R, J_);
  return J_ * motion.v;
}

Vector6d TankOde::wrench(double t, const Motion& motion) {
  const PathPoint at = held(t);
  const Vector6d moved = displacement(at.pose, motion);
  dynamics_.kinematics().jacobian(tool_, motion.base.R, J_);
  if (options_.load > 0) return exerted_0_ + share(t) * (exerted_1_ - exerted_0_);
  return stiffness_.cwiseProduct(moved) + damping_.cwiseProduct(J_ * motion.v - at.twist);
}

/// Reads y. Fills tau_, h_e_ and J_, and all rates except those of v.
void TankOde::prepare(double t, const Eigen::VectorXd& y, Eigen::VectorXd& rates) {
  const Eigen::Index thrusters = rate_max_.size();
  read_motion(y, motion_);
  h_e_ = wrench(t, motion_);
  rates.resize(y.size());
  configuration_rates(problem_.robot, motion_, y, rates);
  u_ = u_0_ + share(t) * (u_1_ - u_0_);
  u_.head(thrusters) += options_.thruster_lag / (t_1_ - t_0_) * (u_1_ - u_0_).head(thrusters);
  u_ = u_.cwiseMax(problem_.robot.actuation.u_min).cwiseMin(problem_.robot.actuation.u_max);
  const auto thrust = y.tail(thrusters);
  rates.tail(thrusters) = ((u_.head(thrusters) - thrust) / options_.thruster_lag)
                              .cwiseMax(-rate_max_)
                              .cwiseMin(rate_max_);
  u_.head(thrusters) = options_.imperfections.thrust_efficiency * thrust + noise_;
  tau_ = problem_.robot.actuation.B * u_;
}

bool TankOde::derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) {
  const Stopwatch watch(seconds_);
  ++evaluations_;
  prepare(t, y, y_dot);
  dynamics_.forward(motion_.v, tau_, tool_, h_e_, v_d_);
  y_dot.segment(motion_size(problem_.robot) - v_d_.size(), v_d_.size()) = v_d_;
  return y_dot.allFinite();
}

bool TankOde::residual(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                       Eigen::VectorXd& F) {
  const Stopwatch watch(seconds_);
  ++evaluations_;
  prepare(t, y, rates_);
  const Eigen::Index n = v_d_.size(), first = motion_size(problem_.robot) - n;
  v_d_ = y_dot.segment(first, n);
  dynamics_.inverse(motion_.v, v_d_, tau_d_);
  F = y_dot - rates_;
  F.segment(first, n) = tau_d_ + J_.transpose() * h_e_ - tau_;
  return F.allFinite();
}

/// A small change of the configuration moves the end effector by J dx, where dx are the velocities
/// that would make that change in unit time.
bool TankOde::residual_jacobian(double t, const Eigen::VectorXd& y,
                                const Eigen::VectorXd& /*y_dot*/, double alpha,
                                Eigen::MatrixXd& dF) {
  const Stopwatch watch(seconds_);
  ++evaluations_;
  prepare(t, y, rates_);
  const Robot& robot = problem_.robot;
  const Eigen::Index n = v_d_.size(), thrusters = rate_max_.size();
  const Eigen::Index v = motion_size(robot) - n, f = v + n;
  dF = alpha * Eigen::MatrixXd::Identity(y.size(), y.size());
  configuration_slopes(robot, motion_, y, shifts_);
  dF.block(0, v, v, n) -= shifts_;
  dynamics_.mass_matrix(M_);
  const bool held = options_.load == 0;
  if (held) pull_ = J_.transpose() * damping_.asDiagonal() * J_;
  dF.block(v, v, n, n) = alpha * M_;
  if (held) {
    dF.block(v, v, n, n) += pull_;
    configuration_shifts(robot, motion_, y, shifts_);
    pull_ = J_.transpose() * stiffness_.asDiagonal() * J_;
    dF.block(v, 0, n, v) = pull_ * shifts_;
  }
  dF.block(v, f, n, thrusters) =
      -options_.imperfections.thrust_efficiency * robot.actuation.B.leftCols(thrusters);
  for (Eigen::Index j = 0; j < thrusters; ++j) {
    if (std::abs(rates_[f + j]) < rate_max_[j]) dF(f + j, f + j) += 1 / options_.thruster_lag;
  }
  return dF.allFinite();
}

}  // namespace maxwrench
