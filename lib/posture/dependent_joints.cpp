#include "lib/posture/dependent_joints.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

/// On the way to theta_r a rougher solution is enough.
constexpr double kOnTheWay = 1e-6;
/// theta_r moves this far in one step [rad or m], and y is corrected by this at most.
constexpr double kStep = 0.3;
constexpr double kCorrection = 0.2;
/// A step that must be shorter than this fails.
constexpr double kShortestStep = 1e-5;
constexpr int kMostPathSteps = 2000;
/// J_d is singular if the smallest pivot of its QR decomposition is below this part of the largest.
constexpr double kSingular = 1e-4;

constexpr const char* kUnreachable = "unreachable pose: the dependent joints do not get there";
constexpr const char* kSingularReason = "singular: the dependent joints do not fix the pose";

/// The place of a base axis [x y z roll pitch yaw] in [x, y, z, yaw].
int coordinate(int axis) { return std::min(axis, 3); }

}  // namespace

DependentJoints::DependentJoints(const Problem& problem)
    : problem_(problem),
      kinematics_(problem.robot),
      q_(problem.robot.joints.size()),
      start_z_(4 + q_.size()),
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

/// Fills error_, J_ and J_d_. The translations are coordinates along the mount's axes; those of J_
/// are along the base's.
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
  error_.head<3>() = problem_.pose.p - pose.p;
  error_.tail<3>() = logarithm(problem_.pose.R * pose.R.transpose());
}

/// slopes_ where J_ and qr_ are, dtheta_r/dtheta_r included.
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

/// One step of Levenberg and Marquardt from z_, kept if it leads closer; false if none does.
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
  start_is_singular_ = qr_.is_singular(kSingular);
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

/// From the start to theta_r; z_ and slopes_ are those of the last point that was reached.
const char* DependentJoints::carry(const Eigen::VectorXd& theta_r) {
  const auto from = problem_.theta_r_default.head(theta_r.size());
  const double length = theta_r.size() == 0 ? 0 : (theta_r - from).lpNorm<Eigen::Infinity>();
  const double longest = length > kStep ? kStep / length : 1;
  double done = 0;
  double step = longest;
  for (int i = 0; i < kMostPathSteps && done < 1; ++i) {
    const double next = std::min(1.0, done + step);
    trial_ = z_;
    for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
      trial_ += (next - done) * (theta_r[k] - from[k]) * slopes_.col(k);
    }
    for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
      trial_[4 + problem_.redundant[static_cast<std::size_t>(k)]] =
          next < 1 ? from[k] + next * (theta_r[k] - from[k]) : theta_r[k];
    }
    const bool arrived = contract(next < 1 ? kOnTheWay : kArrived);
    if (arrived) qr_.compute(J_d_);
    if (arrived && !qr_.is_singular(kSingular)) {
      differentiate();
      z_ = trial_;
      done = next;
      step = std::min(2 * step, longest);
    } else {
      step = (next - done) / 2;
      if (step * length < kShortestStep) return arrived ? kSingularReason : kUnreachable;
    }
  }
  return done < 1 ? kUnreachable : nullptr;
}

bool DependentJoints::has_start() const { return start_error() <= kArrived; }

const char* DependentJoints::follow(const Eigen::VectorXd& theta_r) {
  // The answer depends on theta_r alone, so the last one may be kept.
  if (followed_ && theta_r_ == theta_r) return reason_;
  followed_ = true;
  theta_r_ = theta_r;
  z_ = start_z_;
  slopes_ = start_slopes_;
  reason_ = has_start() ? carry(theta_r) : kUnreachable;
  if (reason_ == nullptr) {
    const Vector6N dy = qr_.solve(error_);
    for (std::size_t i = 0; i < y_.size(); ++i) z_[y_[i]] += dy[static_cast<Eigen::Index>(i)];
    linearise(z_);
    if (!(error_.norm() <= kExact)) reason_ = kUnreachable;
    qr_.compute(J_d_);
    differentiate();
  }
  for (const int i : problem_.dependent) {
    z_[4 + i] = turned_into_limits(problem_.robot.joints[static_cast<std::size_t>(i)], z_[4 + i]);
  }
  return reason_;
}

}  // namespace maxwrench
