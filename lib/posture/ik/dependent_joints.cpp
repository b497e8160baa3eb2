#include "lib/posture/ik/dependent_joints.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

/// The tolerance along the path to theta_r, where a rougher solution suffices.
constexpr double kOnTheWay = 1e-6;
/// [rad or m] The largest change of theta_r in one step, and the largest correction of y.
constexpr double kStep = 0.3;
constexpr double kCorrection = 0.2;
/// The path fails if a step must be shorter than this.
constexpr double kShortestStep = 1e-5;
constexpr int kMostPathSteps = 2000;

/// The index of a base axis [x y z roll pitch yaw] in [x, y, z, yaw].
int coordinate(int axis) { return std::min(axis, 3); }

/// The pose after a share of the motion `path` [m; rad] from `start`.
Pose<double> between(const Pose<double>& start, const Vector6d& path, double share) {
  const Eigen::Vector3d turn = share * path.tail<3>();
  const double angle = turn.norm();
  Pose<double> pose = start;
  pose.p += share * path.head<3>();
  if (angle > 0) pose.R = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * start.R;
  return pose;
}

}  // namespace

DependentJoints::DependentJoints(const Problem& problem)
    : problem_(problem),
      kinematics_(problem.robot),
      q_(problem.robot.joints.size()),
      start_z_(4 + q_.size()),
      from_(static_cast<Eigen::Index>(problem.redundant.size())),
      pose_(pose_at(problem, problem.theta_r_default)),
      J_(6, problem.robot.velocities()) {
  const Robot& robot = problem.robot;
  for (const int axis : robot.base_axes) {
    columns_.push_back(static_cast<int>(y_.size()));
    y_.push_back(coordinate(axis));
  }
  for (const int joint : problem.dependent) {
    columns_.push_back(static_cast<int>(robot.base_axes.size()) + joint);
    y_.push_back(4 + joint);
  }
  assert(y_.size() <= 6);
  const auto d = static_cast<Eigen::Index>(y_.size());
  J_d_.resize(6, d);
  start_z_ << problem.guess_base, problem.guess_q;
  for (std::size_t k = 0; k < problem.redundant.size(); ++k) {
    start_z_[4 + problem.redundant[k]] = problem.theta_r_default[static_cast<Eigen::Index>(k)];
  }
  trial_ = z_ = start_z_;
  slopes_.setZero(start_z_.size(), static_cast<Eigen::Index>(problem.redundant.size()));
  start();
  start_z_ = z_;
  start_slopes_ = slopes_;
}

/// Fills error_, J_ and J_d_. The translations in z are along the mount's axes; those of J_ are
/// along the base's.
void DependentJoints::linearise(const Eigen::VectorXd& z) {
  const Robot& robot = problem_.robot;
  const EndEffector& end_effector =
      robot.end_effectors[static_cast<std::size_t>(problem_.end_effector)];
  const Pose<double> base = base_pose(robot, z.head<4>());
  q_ = z.tail(q_.size());
  kinematics_.set_joints(q_);
  kinematics_.jacobian(end_effector, base.R, J_);
  for (std::size_t i = 0; i < robot.base_axes.size(); ++i) {
    const int axis = robot.base_axes[i];
    if (axis < 3) J_.col(static_cast<Eigen::Index>(i)).head<3>() = robot.mount.R.col(axis);
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    J_d_.col(static_cast<Eigen::Index>(i)) = J_.col(columns_[i]);
  }
  const Pose<double> pose = base * kinematics_.end_effector(end_effector);
  error_.head<3>() = pose_.p - pose.p;
  error_.tail<3>() = logarithm(pose_.R * pose.R.transpose());
}

/// Fills slopes_ at the point of J_ and qr_, including dtheta_r/dtheta_r.
void DependentJoints::differentiate() {
  const auto axes = static_cast<Eigen::Index>(problem_.robot.base_axes.size());
  for (Eigen::Index k = 0; k < slopes_.cols(); ++k) {
    const int joint = problem_.redundant[static_cast<std::size_t>(k)];
    const Vector6d twist = J_.col(axes + joint);
    const Vector6N dy = qr_.solve(twist);
    for (std::size_t i = 0; i < y_.size(); ++i) {
      slopes_(y_[i], k) = -dy[static_cast<Eigen::Index>(i)];
    }
    slopes_(4 + joint, k) = 1;
  }
}

/// One Levenberg-Marquardt step from z_. False if no step reduces the error.
bool DependentJoints::approach(double& damping) {
  constexpr double kMostDamping = 1e9;
  constexpr double kLongest = 0.5;
  const double error = error_.norm();
  while (damping < kMostDamping) {
    Vector6N dy = damped_step(J_d_, error_, damping);
    const double longest = dy.lpNorm<Eigen::Infinity>();
    if (longest > kLongest) dy *= kLongest / longest;
    trial_ = z_;
    for (std::size_t i = 0; i < y_.size(); ++i) trial_[y_[i]] += dy[static_cast<Eigen::Index>(i)];
    linearise(trial_);
    if (error_.norm() < error) {
      z_ = trial_;
      damping /= 8;
      return true;
    }
    linearise(z_);
    damping *= 4;
  }
  return false;
}

void DependentJoints::start() {
  constexpr int kMostDampedSteps = 500;
  double damping = 0.01;
  linearise(z_);
  for (int i = 0; i < kMostDampedSteps && error_.norm() > kArrived; ++i) {
    if (!approach(damping)) break;
  }
  start_error_ = error_;
  qr_.compute(J_d_);
  start_is_singular_ = qr_.is_singular(kSingularShare);
  differentiate();
}

/// Newton's method from trial_; false if a step does not halve the error or is too long.
bool DependentJoints::contract(double tolerance) {
  double error = kInfinity;
  while (true) {
    linearise(trial_);
    const double now = error_.norm();
    if (now <= tolerance) return true;
    if (!(now <= error / 2)) return false;
    error = now;
    qr_.compute(J_d_);
    const Vector6N dy = qr_.solve(error_);
    if (!(dy.lpNorm<Eigen::Infinity>() <= kCorrection)) return false;
    for (std::size_t i = 0; i < y_.size(); ++i) trial_[y_[i]] += dy[static_cast<Eigen::Index>(i)];
  }
}

/// Sets trial_ along the tangent from one share of the path to another, with theta_r and X at the
/// second.
void DependentJoints::predict(double from, double to, const Eigen::VectorXd& theta_r) {
  trial_ = z_;
  for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
    trial_ += (to - from) * (theta_r[k] - from_[k]) * slopes_.col(k);
  }
  for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
    trial_[4 + problem_.redundant[static_cast<std::size_t>(k)]] =
        to < 1 ? from_[k] + to * (theta_r[k] - from_[k]) : theta_r[k];
  }
  if (twist_.isZero(0)) return;
  for (std::size_t i = 0; i < y_.size(); ++i) {
    trial_[y_[i]] += (to - from) * drift_[static_cast<Eigen::Index>(i)];
  }
}

/// Tracks from from_ and pose_ to theta_r and `pose`. z_ and slopes_ are those of the last point
/// that was reached.
const char* DependentJoints::carry(const Eigen::VectorXd& theta_r, const Pose<double>& pose) {
  const Pose<double> start = pose_;
  const Eigen::Vector3d turn = logarithm(pose.R * start.R.transpose());
  twist_ << pose.p - start.p, turn;
  if (pose.R == start.R) twist_.tail<3>().setZero();
  const double joints = theta_r.size() == 0 ? 0 : (theta_r - from_).lpNorm<Eigen::Infinity>();
  const double length = std::max(joints, twist_.lpNorm<Eigen::Infinity>());
  const double longest = length > kStep ? kStep / length : 1;
  drift_ = qr_.solve(twist_);
  double done = 0, step = longest;
  const char* reason = nullptr;
  for (int i = 0; done < 1 && reason == nullptr; ++i) {
    const double next = std::min(1.0, done + step);
    predict(done, next, theta_r);
    pose_ = next < 1 ? between(start, twist_, next) : pose;
    const bool arrived = contract(next < 1 ? kOnTheWay : kArrived);
    if (arrived) qr_.compute(J_d_);
    if (arrived && !qr_.is_singular(kSingularShare)) {
      differentiate();
      drift_ = qr_.solve(twist_);
      z_ = trial_;
      done = next;
      step = std::min(2 * step, longest);
    } else {
      step = (next - done) / 2;
      if (step * length < kShortestStep) reason = arrived ? kSingularReason : kUnreachableReason;
    }
    if (i + 1 == kMostPathSteps && done < 1) reason = kUnreachableReason;
  }
  if (done < 1) pose_ = between(start, twist_, done);
  return reason;
}

/// A last step to the pose, from close to it.
const char* DependentJoints::arrive() {
  const Vector6N dy = qr_.solve(error_);
  for (std::size_t i = 0; i < y_.size(); ++i) z_[y_[i]] += dy[static_cast<Eigen::Index>(i)];
  linearise(z_);
  qr_.compute(J_d_);
  differentiate();
  return error_.norm() <= kExact ? nullptr : kUnreachableReason;
}

/// Sets from_ from z_.
void DependentJoints::read_theta_r() {
  for (Eigen::Index k = 0; k < from_.size(); ++k) {
    from_[k] = z_[4 + problem_.redundant[static_cast<std::size_t>(k)]];
  }
}

bool DependentJoints::has_start() const { return start_error() <= kArrived; }

const char* DependentJoints::follow(const Eigen::VectorXd& theta_r) {
  // The answer depends on theta_r alone, so the last one is still valid.
  if (followed_ && theta_r_ == theta_r) return reason_;
  followed_ = true;
  theta_r_ = theta_r;
  z_ = start_z_;
  slopes_ = start_slopes_;
  read_theta_r();
  pose_ = pose_at(problem_, problem_.theta_r_default);
  reason_ = has_start() ? carry(theta_r, pose_) : kUnreachableReason;
  if (reason_ == nullptr) reason_ = arrive();
  for (const int i : problem_.dependent) {
    z_[4 + i] = turned_into_limits(problem_.robot.joints[static_cast<std::size_t>(i)], z_[4 + i]);
  }
  read_theta_r();
  return reason_;
}

const char* DependentJoints::go_on(const Eigen::VectorXd& theta_r, const Pose<double>& pose) {
  followed_ = false;
  if (reason_ != nullptr) {
    linearise(z_);
    qr_.compute(J_d_);
    differentiate();
  }
  reason_ = carry(theta_r, pose);
  if (reason_ == nullptr) reason_ = arrive();
  read_theta_r();
  return reason_;
}

}  // namespace maxwrench
