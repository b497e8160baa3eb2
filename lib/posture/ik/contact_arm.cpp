#include "lib/posture/ik/contact_arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/math/random.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;

/// Axes are parallel if the sine of their angle is below this.
constexpr double kParallel = 1e-9;
/// [m] The largest distance of a target from the plane of an arm that cannot leave this plane.
constexpr double kOffPlane = 1e-9;
/// [rad or m] Solutions closer than this are the same.
constexpr double kSame = 1e-5;
constexpr int kSeeds = 24;
constexpr int kMostSteps = 60;

/// An angle q with c = cos q and s = sin q.
struct Angle {
  double q = 0, c = 1, s = 0;
};

/// x, turned by q about a.
Vector3d rotate(const Vector3d& a, const Angle& q, const Vector3d& x) {
  return x * q.c + a.cross(x) * q.s + a * (a.dot(x) * (1 - q.c));
}

/// x without its part along n.
Vector3d flat(const Vector3d& n, const Vector3d& x) { return x - n * n.dot(x); }

/// The angle about a that turns x, without its part along a, towards y.
double angle_about(const Vector3d& a, const Vector3d& x, const Vector3d& y) {
  return std::atan2(a.dot(x.cross(y)), x.dot(y) - a.dot(x) * a.dot(y));
}

}  // namespace

ContactArm::Cosine::Cosine(double A, double B)
    : size(std::hypot(A, B)), middle(std::atan2(B, A)), c(A / size), s(B / size) {}

/// The solutions of A cos q + B sin q = C: q = middle -+ half.
template <class Use>
void ContactArm::Cosine::solve(double C, Use&& use) const {
  if (!(size > 0 && std::abs(C) <= size)) return;
  const double cos_half = C / size;
  const double half = std::acos(cos_half);
  const double sin_half = std::sqrt((1 - cos_half) * (1 + cos_half));
  use(Angle{middle - half, c * cos_half + s * sin_half, s * cos_half - c * sin_half});
  if (half == 0) return;
  use(Angle{middle + half, c * cos_half - s * sin_half, s * cos_half + c * sin_half});
}

ContactArm::ContactArm(const Problem& problem)
    : problem_(problem),
      contact_(*problem.contact),
      kinematics_(problem.robot),
      q_(contact_.q_rest),
      trial_(contact_.follow.size()),
      J_(6, problem.robot.velocities()) {
  for (Eigen::VectorXd& solution : solutions_) solution.resize(trial_.size());
  const auto d = static_cast<Eigen::Index>(contact_.follow.size());
  error_.resize(contact_.rows());
  J_f_.resize(contact_.rows(), d);
  read_axes();
}

void ContactArm::read_axes() {
  const Robot& robot = problem_.robot;
  for (const int joint : contact_.follow) q_[joint] = 0;
  kinematics_.set_joints(q_);
  q_ = contact_.q_rest;
  const std::size_t count = contact_.follow.size();
  if (contact_.holds_axes || count < 2 || count > 3) return;
  for (std::size_t i = 0; i < count; ++i) {
    const int joint = contact_.follow[i];
    if (robot.joints[static_cast<std::size_t>(joint)].type != JointType::kRevolute) return;
    axes_[i].a = kinematics_.joint_axis(static_cast<std::size_t>(joint));
    axes_[i].o = kinematics_.links()[static_cast<std::size_t>(joint) + 1].p;
  }
  p_0_ = kinematics_.end_effector_position(
      robot.end_effectors[static_cast<std::size_t>(contact_.end_effector)]);
  const Axis &inner = axes_[count - 2], &outer = axes_[count - 1];
  closed_form_ = inner.a.cross(outer.a).norm() < kParallel;
  const Vector3d& n = outer.a;
  fore_ = p_0_ - outer.o;
  upper_ = inner.o - outer.o;
  const Vector3d flat_fore = flat(n, fore_), flat_upper = flat(n, upper_);
  elbow_ = Cosine(flat_fore.dot(flat_upper), n.cross(flat_fore).dot(flat_upper));
  lengths_ = (flat_fore.squaredNorm() + flat_upper.squaredNorm()) / 2;
}

int ContactArm::solve(const Pose<double>& target) {
  count_ = 0;
  if (!closed_form_) {
    solve_by_newton(target);
  } else if (contact_.follow.size() == 3) {
    solve_shoulder(target.p);
  } else if (std::abs(axes_[0].a.dot(target.p - p_0_)) <= kOffPlane) {
    solve_plane(target.p, 0);
  }
  return count_;
}

/// The first joint brings the target to where the others can reach it.
void ContactArm::solve_shoulder(const Vector3d& p) {
  const Vector3d& a = axes_[0].a;
  const Vector3d& n = axes_[1].a;
  const Vector3d x = p - axes_[0].o;
  const double along = n.dot(a) * a.dot(x);
  const Cosine yaw(n.dot(x) - along, -n.dot(a.cross(x)));
  yaw.solve(n.dot(p_0_ - axes_[0].o) - along, [&](const Angle& q) {
    solve_plane(axes_[0].o + rotate(a, {-q.q, q.c, -q.s}, x), q.q);
  });
}

/// Solves the last two joints, about parallel axes; `first` is the position of the joint before
/// them.
void ContactArm::solve_plane(const Vector3d& p, double first) {
  const bool shoulder = contact_.follow.size() == 3;
  const Axis& inner = axes_[shoulder ? 1 : 0];
  const Vector3d& n = axes_[shoulder ? 2 : 1].a;
  const Vector3d target = p - inner.o;
  elbow_.solve(lengths_ - flat(n, target).squaredNorm() / 2, [&](const Angle& q) {
    trial_[trial_.size() - 1] = q.q;
    trial_[trial_.size() - 2] = angle_about(inner.a, rotate(n, q, fore_) - upper_, target);
    if (shoulder) trial_[0] = first;
    keep();
  });
}

/// Whether `found` and `trial_` are the same posture up to whole turns.
bool ContactArm::same(const Eigen::VectorXd& found) const {
  for (Eigen::Index i = 0; i < trial_.size(); ++i) {
    const auto joint = static_cast<std::size_t>(contact_.follow[static_cast<std::size_t>(i)]);
    double apart = found[i] - trial_[i];
    if (problem_.robot.joints[joint].type == JointType::kRevolute) {
      apart = std::remainder(apart, 2 * std::numbers::pi);
    }
    if (std::abs(apart) >= kSame) return false;
  }
  return true;
}

/// Adds `trial_` to the solutions, unless it is one of them.
void ContactArm::keep() {
  for (Eigen::Index i = 0; i < trial_.size(); ++i) {
    const int joint = contact_.follow[static_cast<std::size_t>(i)];
    trial_[i] =
        turned_into_limits(problem_.robot.joints[static_cast<std::size_t>(joint)], trial_[i]);
  }
  if (count_ == kMostSolutions) return;
  if (!closed_form_) {
    for (int i = 0; i < count_; ++i) {
      if (same(solution(i))) return;
    }
  }
  solutions_[static_cast<std::size_t>(count_++)] = trial_;
}

/// Fills error_ and J_f_ at trial_, in base axes.
void ContactArm::linearise(const Pose<double>& target) {
  const Robot& robot = problem_.robot;
  const EndEffector& tip = robot.end_effectors[static_cast<std::size_t>(contact_.end_effector)];
  for (Eigen::Index i = 0; i < trial_.size(); ++i) {
    q_[contact_.follow[static_cast<std::size_t>(i)]] = trial_[i];
  }
  kinematics_.set_joints(q_);
  kinematics_.jacobian(tip, Eigen::Matrix3d::Identity(), J_);
  const auto axes = static_cast<Eigen::Index>(robot.base_axes.size());
  for (Eigen::Index i = 0; i < trial_.size(); ++i) {
    J_f_.col(i) = J_.col(axes + contact_.follow[static_cast<std::size_t>(i)]).head(J_f_.rows());
  }
  const Pose<double> pose = kinematics_.end_effector(tip);
  error_.head<3>() = target.p - pose.p;
  if (!contact_.holds_axes) return;
  error_.tail<3>() = logarithm(target.R * pose.R.transpose());
}

/// The Levenberg-Marquardt method from trial_, then a plain Newton step. Returns whether it
/// converges.
bool ContactArm::newton(const Pose<double>& target) {
  constexpr double kMostDamping = 1e6;
  double damping = 1e-3;
  linearise(target);
  for (int step = 0; step < kMostSteps && error_.norm() > kArrived; ++step) {
    const double before = error_.norm();
    const Vector6N dq = damped_step(J_f_, error_, damping * before);
    trial_ += dq;
    linearise(target);
    if (error_.norm() < before) {
      damping /= 8;
      continue;
    }
    trial_ -= dq;
    linearise(target);
    damping *= 8;
    if (damping > kMostDamping) return false;
  }
  if (error_.norm() > kArrived) return false;
  const LeastSquares6 qr(J_f_);
  for (int step = 0; step < 2; ++step) {
    const Vector6N dq = qr.solve(error_);
    trial_ += dq;
    linearise(target);
  }
  return error_.norm() <= kExact;
}

void ContactArm::solve_by_newton(const Pose<double>& target) {
  Random random(1);  // the same seeds for each target: a solution depends on the target alone
  for (int seed = 0; seed < kSeeds; ++seed) {
    for (Eigen::Index i = 0; i < trial_.size(); ++i) {
      const Joint& joint =
          problem_.robot
              .joints[static_cast<std::size_t>(contact_.follow[static_cast<std::size_t>(i)])];
      trial_[i] = random.uniform(std::max(joint.q_min, -std::numbers::pi),
                                 std::min(joint.q_max, 2 * std::numbers::pi));
    }
    if (newton(target)) keep();
  }
}

}  // namespace maxwrench
