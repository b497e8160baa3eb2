#include "lib/tank/controller.h"

#include <algorithm>
#include <cmath>

#include "lib/redundancy.h"

namespace maxwrench {
namespace {

constexpr double kWrenchWeight = 1e-3;  // beside the posture, of what cannot be had

/// Of (u - u*)'Q(u - u*): an effort counts by its smaller limit, as in beta_1.
Eigen::VectorXd weights(const Zonotope& actuation) {
  const Eigen::ArrayXd limit =
      actuation.u_min.array().abs().min(actuation.u_max.array().abs()).max(1e-3);
  return limit.square().inverse();
}

}  // namespace

PostureController::PostureController(const Problem& problem, const Posture& posture,
                                     const TankOptions& options)
    : problem_(problem),
      tool_(problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)]),
      options_(options),
      dynamics_(problem.robot),
      tracker_(problem.robot.actuation.B, weights(problem.robot.actuation)),
      reference_(posture),
      now_(posture) {
  a_.resize(problem.robot.velocities());
}

double PostureController::joint_error(const Motion& motion) const {
  double worst = 0;
  for (const int joint : problem_.redundant) {
    worst = std::max(worst, std::abs(reference_.q[joint] - motion.q[joint]));
  }
  return worst;
}

/// a = A_r (k e_r - d theta_r_dot).
void PostureController::accelerate_posture(const Motion& motion) {
  const auto axes = static_cast<Eigen::Index>(problem_.robot.base_axes.size());
  null_motion(problem_, now_, A_r_);
  error_.resize(A_r_.cols());
  for (Eigen::Index k = 0; k < error_.size(); ++k) {
    const int joint = problem_.redundant[static_cast<std::size_t>(k)];
    error_[k] = options_.stiffness * (reference_.q[joint] - motion.q[joint]) -
                options_.damping * motion.v[axes + joint];
  }
  a_ = A_r_ * error_;
}

/// a = k e - d v, e the error of the pose in base axes and of the joints.
void PostureController::accelerate_all(const Motion& motion) {
  const Eigen::Matrix3d R = motion.base.R.transpose();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(R * reference_.base.R));
  Vector6d pose;
  pose << R * (reference_.base.p - motion.base.p), turn.angle() * turn.axis();
  const auto& axes = problem_.robot.base_axes;
  for (std::size_t i = 0; i < axes.size(); ++i) a_[static_cast<Eigen::Index>(i)] = pose[axes[i]];
  a_.tail(motion.q.size()) = reference_.q - motion.q;
  a_ = options_.stiffness * a_ - options_.damping * motion.v;
}

void PostureController::request(const Motion& motion, const Vector6d& h,
                                const Eigen::VectorXd& u_star, const Eigen::VectorXd& u_before,
                                double period, EffortRequest& request) {
  dynamics_.set_configuration(motion.base.R, motion.q);
  dynamics_.kinematics().jacobian(tool_, motion.base.R, now_.J);
  if (options_.release) {
    accelerate_all(motion);
  } else {
    accelerate_posture(motion);
  }
  request.tau_c.resize(a_.size());
  dynamics_.inverse(motion.v, a_, request.tau_c);
  request.tau_c += now_.J.transpose() * h;
  M_.resize(a_.size(), a_.size());
  dynamics_.mass_matrix(M_);
  request.P = M_.llt().solve(Eigen::MatrixXd::Identity(a_.size(), a_.size()));
  if (!options_.release) {
    // The cell takes what leaves the null space, so the posture comes before the wrench.
    const Eigen::MatrixXd M_r = A_r_.transpose() * M_ * A_r_;
    request.P = kWrenchWeight * request.P + A_r_ * M_r.llt().solve(A_r_.transpose());
  }
  const Robot& robot = problem_.robot;
  const Eigen::VectorXd reach = period * robot.u_rate_max;
  request.u_star = u_star;
  request.lower = robot.actuation.u_min.cwiseMax(u_before - reach);
  request.upper = robot.actuation.u_max.cwiseMin(u_before + reach);
}

}  // namespace maxwrench
