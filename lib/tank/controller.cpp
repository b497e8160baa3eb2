#include "lib/tank/controller.h"

#include <algorithm>
#include <cmath>

#include "lib/math/decompositions.h"
#include "lib/posture/redundancy.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// Directions that differ by less than this share count as one.
constexpr double kSameDirection = 1e-9;

/// The diagonal of Q in (u - u*)'Q(u - u*). An effort is weighted by its smaller limit, as in
/// beta_1.
Eigen::VectorXd weights(const Zonotope& actuation) {
  const Eigen::ArrayXd limit =
      actuation.u_min.array().abs().min(actuation.u_max.array().abs()).max(1e-3);
  return limit.square().inverse();
}

}  // namespace

PostureController::PostureController(const Problem& problem, const Posture& posture, Wrench wrench,
                                     const TankOptions& options)
    : problem_(problem),
      tool_(problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)]),
      options_(options),
      dynamics_(problem.robot),
      tracker_(weights(problem.robot.actuation)),
      reference_(posture),
      now_(posture),
      a_(problem.robot.velocities()) {
  if (wrench == Wrench::kAny && options.load == 0) {
    across_ =
        split(problem.W_any - problem.c * (problem.c.transpose() * problem.W_any), kSameDirection)
            .range;
  }
}

double PostureController::theta_r_error(const Motion& motion) const {
  double worst = 0;
  for (const int joint : problem_.redundant) {
    worst = std::max(worst, std::abs(reference_.q[joint] - motion.q[joint]));
  }
  return worst;
}

double PostureController::moved(const Motion& motion) const {
  const Vector6d base = offset(motion.base);
  const double joints =
      motion.q.size() > 0 ? (reference_.q - motion.q).lpNorm<Eigen::Infinity>() : 0;
  return std::max({joints, base.head<3>().norm(), base.tail<3>().norm()});
}

/// The pose of the reference relative to the base, in base axes: [m; rotation vector].
Vector6d PostureController::offset(const Pose<double>& base) const {
  const Eigen::Matrix3d R = base.R.transpose();
  Vector6d pose;
  pose << R * (reference_.base.p - base.p), logarithm(R * reference_.base.R);
  return pose;
}

/// a = A_r (omega^2 e_r - 2 omega theta_r_dot).
void PostureController::accelerate_posture(const Motion& motion) {
  const auto axes = static_cast<Eigen::Index>(problem_.robot.base_axes.size());
  const double omega = options_.bandwidth;
  null_motion(problem_, now_, A_r_);
  error_.resize(A_r_.cols());
  for (Eigen::Index k = 0; k < error_.size(); ++k) {
    const int joint = problem_.redundant[static_cast<std::size_t>(k)];
    error_[k] = omega * omega * (reference_.q[joint] - motion.q[joint]) -
                2 * omega * motion.v[axes + joint];
  }
  a_ = A_r_ * error_;
}

/// a = omega^2 e - 2 omega v, where e is the error of the pose in base axes and of the joints.
void PostureController::accelerate_all(const Motion& motion) {
  const Vector6d pose = offset(motion.base);
  const auto& axes = problem_.robot.base_axes;
  for (std::size_t i = 0; i < axes.size(); ++i) a_[static_cast<Eigen::Index>(i)] = pose[axes[i]];
  a_.tail(motion.q.size()) = reference_.q - motion.q;
  a_ = options_.bandwidth * options_.bandwidth * a_ - 2 * options_.bandwidth * motion.v;
}

/// Keeps only those combinations of the balance's rows on which the wrenches `across_` have no
/// effect.
void PostureController::leave_free(EffortRequest& request) const {
  if (across_.cols() == 0) return;
  Matrix6Xd across(6, across_.cols());
  across << turn_ * across_.topRows<3>(), turn_ * across_.bottomRows<3>();
  const Eigen::MatrixXd N = split(now_.J.transpose() * across, kSameDirection).complement;
  request.B = N.transpose() * request.B;
  request.tau_c = N.transpose() * request.tau_c;
}

void PostureController::set_motion(const Motion& motion) {
  dynamics_.set_configuration(motion.base.R, motion.q);
  dynamics_.kinematics().jacobian(tool_, motion.base.R, now_.J);
}

void PostureController::request(const Motion& motion, const Vector6d& h,
                                const Eigen::VectorXd& u_star, const Eigen::VectorXd& u_before,
                                double period, EffortRequest& request) {
  set_motion(motion);
  if (options_.load > 0) {
    accelerate_all(motion);
  } else {
    accelerate_posture(motion);
  }
  fill(motion, h, u_star, u_before, period, request);
}

void PostureController::request(const Motion& motion, const Eigen::VectorXd& acceleration,
                                const Vector6d& h, const Eigen::Matrix3d& turn,
                                const Eigen::VectorXd& u_star, const Eigen::VectorXd& u_before,
                                double period, EffortRequest& request) {
  set_motion(motion);
  a_ = acceleration;
  turn_ = turn;
  fill(motion, h, u_star, u_before, period, request);
}

/// Fills `request` from a_, J and the dynamics at the motion.
void PostureController::fill(const Motion& motion, const Vector6d& h, const Eigen::VectorXd& u_star,
                             const Eigen::VectorXd& u_before, double period,
                             EffortRequest& request) {
  const Robot& robot = problem_.robot;
  request.tau_c.resize(a_.size());
  dynamics_.inverse(motion.v, a_, request.tau_c);
  request.tau_c += now_.J.transpose() * h;
  request.B = robot.actuation.B;
  leave_free(request);
  const Eigen::VectorXd reach = period * robot.u_rate_max;
  request.u_star = u_star;
  request.lower = robot.actuation.u_min.cwiseMax(u_before - reach);
  request.upper = robot.actuation.u_max.cwiseMin(u_before + reach);
  if (!options_.invert_lag) return;
  // The command at the end of the period, u + lag/period (u - u_before), is within the limits.
  const auto thrusters = static_cast<Eigen::Index>(robot.thrusters.size());
  const double lag = options_.thruster_lag / period;
  const auto reached = [&](const Eigen::VectorXd& limit) -> Eigen::VectorXd {
    return (limit + lag * u_before).head(thrusters) / (1 + lag);
  };
  auto lower = request.lower.head(thrusters), upper = request.upper.head(thrusters);
  lower = lower.cwiseMax(reached(robot.actuation.u_min));
  upper = upper.cwiseMin(reached(robot.actuation.u_max));
}

}  // namespace maxwrench
