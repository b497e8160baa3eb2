#include "lib/posture/free_pose.h"

#include <stdexcept>
#include <string>

#include "lib/math/extended.h"
#include "lib/math/rotated.h"

namespace maxwrench {
namespace {

/// All six coordinates s; those that are not free are zero.
template <class T>
Vector6<T> coordinates_at(const Problem& problem, const VectorX<T>& theta_r) {
  Vector6<T> s = Vector6<T>::Zero();
  auto next = static_cast<Eigen::Index>(problem.redundant.size());
  for (const int axis : problem.free.axes) s[axis] = theta_r[next++];
  return s;
}

template <class T>
Matrix3<T> turned(const Vector6<T>& s) {
  using Turn = Eigen::AngleAxis<T>;
  return (Turn(s[5], Vector3<T>::UnitZ()) * Turn(s[4], Vector3<T>::UnitY()) *
          Turn(s[3], Vector3<T>::UnitX()))
      .toRotationMatrix();
}

}  // namespace

void require_theta_r(const Problem& problem, const Eigen::VectorXd& theta_r) {
  if (theta_r.size() != problem.redundancy()) {
    throw std::invalid_argument("theta_r: got " + std::to_string(theta_r.size()) +
                                " numbers, expected " + std::to_string(problem.redundancy()) +
                                " for " + problem.name);
  }
  if (!theta_r.allFinite()) {
    throw std::invalid_argument("theta_r: got a value that is not a finite number");
  }
}

template <class T>
Pose<T> free_pose(const Problem& problem, const VectorX<T>& theta_r) {
  Pose<T> pose{problem.pose.R.cast<T>(), problem.pose.p.cast<T>()};
  if (problem.free.axes.empty()) return pose;
  const Vector6<T> s = coordinates_at(problem, theta_r);
  const Matrix3<T> R = pose.R * turned(s);
  pose.p += (problem.free.along_end_effector ? R : pose.R) * s.template head<3>();
  pose.R = R;
  return pose;
}

template Pose<Extended> free_pose(const Problem&, const VectorX<Extended>&);

Pose<double> pose_at(const Problem& problem, const Eigen::VectorXd& theta_r) {
  return free_pose(problem, theta_r);
}

Vector6d free_twist(const Problem& problem, const Eigen::VectorXd& theta_r, int i) {
  const int axis = problem.free.axes[static_cast<std::size_t>(i)];
  const Vector6d s = coordinates_at(problem, theta_r);
  Vector6d twist = Vector6d::Zero();
  if (axis < 3) {
    const bool along_end_effector = problem.free.along_end_effector;
    const Eigen::Matrix3d& R_0 = problem.pose.R;
    twist.head<3>() =
        along_end_effector ? Eigen::Vector3d(R_0 * turned(s).col(axis)) : R_0.col(axis);
    return twist;
  }
  // The rotation axis: z, then y turned by the yaw, then x turned by yaw and pitch.
  Vector6d outer = Vector6d::Zero();
  for (int j = axis + 1; j < 6; ++j) outer[j] = s[j];
  const Eigen::Vector3d w = problem.pose.R * turned(outer).col(axis - 3);
  twist.tail<3>() = w;
  if (problem.free.along_end_effector) {
    twist.head<3>() = w.cross(Eigen::Vector3d(problem.pose.R * (turned(s) * s.head<3>())));
  }
  return twist;
}

Eigen::VectorXd held_theta_r(const Problem& problem, const Eigen::VectorXd& theta_r) {
  require_theta_r(problem, theta_r);
  const auto joints = static_cast<Eigen::Index>(problem.redundant.size());
  const Eigen::Index kept = theta_r.size() - problem.free.count();
  Eigen::VectorXd result(kept);
  result << theta_r.head(joints), theta_r.tail(kept - joints);
  return result;
}

void turn_wrenches(const Eigen::Matrix3d& turn, Problem& problem) {
  problem.c = rotated(turn, problem.c);
  problem.W_any = rotated(turn, problem.W_any);
  problem.wrench_axes = turn * problem.wrench_axes;
  ScenarioList& list = problem.scenarios;
  for (ScenarioWrench& wrench : list.wrenches) wrench.c = rotated(turn, wrench.c);
  if (list.ball) list.ball->E = rotated(turn, list.ball->E);
  list.F = rotated(turn, list.F);
}

Problem held_at(const Problem& problem, const Eigen::VectorXd& theta_r) {
  require_theta_r(problem, theta_r);
  Problem held = problem;
  if (problem.free.axes.empty()) return held;
  held.pose = pose_at(problem, theta_r);
  if (problem.free.wrench_turns) {
    const Eigen::Matrix3d turn = held.pose.R * problem.pose.R.transpose();
    turn_wrenches(turn, held);
  }
  held.free = {};
  for (Eigen::VectorXd* v : {&held.theta_r_min, &held.theta_r_max, &held.theta_r_default}) {
    *v = held_theta_r(problem, *v);
  }
  held.start_system.reset();
  return held;
}

}  // namespace maxwrench
