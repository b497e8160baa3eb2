#include "lib/posture/ik/dependent_joints.h"

#include "lib/posture/ik/damped_newton.h"
#include "lib/robot/chain.h"

namespace maxwrench {

DependentJoints::DependentJoints(const Problem& problem)
    : problem_(problem), chain_(problem), continuation_(chain_) {
  path_.from = path_.to = problem.theta_r_default.head(chain_.parameters());
  path_.bend.setZero(chain_.parameters());
  path_.pose = problem.pose;
  z_.resize(4 + problem.guess_q.size());
  z_ << problem.guess_base, problem.guess_q;
  for (int i = 0; i < chain_.unknowns(); ++i) {
    start_y_[static_cast<std::size_t>(i)] = z_[chain_.place_in_z(i)];
  }
  DampedNewton newton(chain_, path_.pose);
  newton.run(path_.from, start_y_);
  start_error_ = newton.error();
  slopes_.setZero(z_.size(), static_cast<Eigen::Index>(problem.redundant.size()));
  start_is_singular_ = !differentiate(newton.state());
  start_slopes_ = slopes_;
  y_ = start_y_;
  write_z();
}

/// Fills slopes_ at this point, including dtheta_r/dtheta_r. False if J_d is singular.
bool DependentJoints::differentiate(const ToolState<double>& state) {
  qr_.compute(chain_.J_d(state));
  if (qr_.is_singular(kSingularShare)) return false;
  for (Eigen::Index k = 0; k < slopes_.cols(); ++k) {
    const Vector6N dy = qr_.solve(state.J_r[static_cast<std::size_t>(k)]);
    for (int i = 0; i < chain_.unknowns(); ++i) slopes_(chain_.place_in_z(i), k) = -dy[i];
    slopes_(4 + problem_.redundant[static_cast<std::size_t>(k)], k) = 1;
  }
  return true;
}

void DependentJoints::write_z() {
  for (int i = 0; i < chain_.unknowns(); ++i) {
    z_[chain_.place_in_z(i)] = y_[static_cast<std::size_t>(i)];
  }
  for (std::size_t k = 0; k < problem_.redundant.size(); ++k) {
    z_[4 + problem_.redundant[k]] = path_.from[static_cast<Eigen::Index>(k)];
  }
}

/// Tracks y from the start of path_ to theta_r and a pose.
const char* DependentJoints::carry(const Eigen::VectorXd& theta_r, const Pose<double>& pose) {
  path_.to.head(theta_r.size()) = theta_r;
  path_.twist << pose.p - path_.pose.p, logarithm(pose.R * path_.pose.R.transpose());
  if (pose.R == path_.pose.R) path_.twist.tail<3>().setZero();
  Six<double> y = y_;
  if (!continuation_.track(path_, y)) return kUnreachableReason;
  if (!differentiate(continuation_.state())) return kSingularReason;
  y_ = y;
  path_.from = path_.to;
  path_.pose = pose;
  return nullptr;
}

const char* DependentJoints::follow(const Eigen::VectorXd& theta_r) {
  // The answer depends on theta_r alone, so the last one is still valid.
  if (followed_ && theta_r_ == theta_r) return reason_;
  followed_ = true;
  theta_r_ = theta_r;
  y_ = start_y_;
  slopes_ = start_slopes_;
  path_.from = problem_.theta_r_default.head(chain_.parameters());
  path_.pose = problem_.pose;
  reason_ = has_start() ? carry(theta_r, path_.pose) : kUnreachableReason;
  for (int i = 0; i < chain_.unknowns(); ++i) {
    const int joint = chain_.place_in_z(i) - 4;
    double& y = y_[static_cast<std::size_t>(i)];
    if (joint >= 0) {
      y = turned_into_limits(problem_.robot.joints[static_cast<std::size_t>(joint)], y);
    }
  }
  write_z();
  return reason_;
}

const char* DependentJoints::go_on(const Eigen::VectorXd& theta_r, const Pose<double>& pose) {
  followed_ = false;
  reason_ = carry(theta_r, pose);
  write_z();
  return reason_;
}

}  // namespace maxwrench
