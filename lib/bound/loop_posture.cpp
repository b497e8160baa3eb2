#include "lib/bound/loop_posture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/bound/exact_posture.h"
#include "lib/robot/chain.h"

namespace maxwrench {
namespace {

bool is_free_axis(const Robot& robot, int axis) {
  return std::find(robot.base_axes.begin(), robot.base_axes.end(), axis) != robot.base_axes.end();
}

/// One turn is enough.
void limit_to_a_turn(double& lower, double& upper) {
  if (upper - lower <= 2 * std::numbers::pi) return;
  const double middle =
      std::isfinite(lower) && std::isfinite(upper)
          ? (lower + upper) / 2
          : (std::isfinite(lower) ? lower + std::numbers::pi
                                  : (std::isfinite(upper) ? upper - std::numbers::pi : 0));
  lower = middle - std::numbers::pi;
  upper = middle + std::numbers::pi;
}

}  // namespace

LoopCoordinates::LoopCoordinates(const Problem& problem) {
  const Robot& robot = problem.robot;
  const Eigen::Index own = problem.redundancy();
  const auto followers = static_cast<Eigen::Index>(problem.dependent.size());
  const bool yaws = is_free_axis(robot, 5);
  const Eigen::Index size = own + followers + (yaws ? 1 : 0);
  lower.setConstant(size, -std::numbers::pi);
  upper.setConstant(size, std::numbers::pi);
  lower.head(own) = problem.theta_r_min;
  upper.head(own) = problem.theta_r_max;
  const auto add = [&](Eigen::Index at, bool turns) {
    chain.index.push_back(static_cast<int>(at));
    chain.turns.push_back(turns);
    if (turns) limit_to_a_turn(lower[at], upper[at]);
  };
  if (yaws) add(size - 1, true);
  first = chain.count();
  joints = chain_to(robot, problem.end_effector);
  for (const int joint : joints) {
    const Joint& of = robot.joints[static_cast<std::size_t>(joint)];
    const auto place = [&](const std::vector<int>& list) {
      return std::find(list.begin(), list.end(), joint) - list.begin();
    };
    Eigen::Index at = place(problem.redundant);
    if (at == static_cast<Eigen::Index>(problem.redundant.size())) {
      at = own + place(problem.dependent);
      lower[at] = of.q_min;
      upper[at] = of.q_max;
    }
    add(at, of.type == JointType::kRevolute);
  }
  auto next = static_cast<Eigen::Index>(problem.redundant.size());
  for (const int axis : problem.free.axes) add(next++, axis >= 3);
}

LoopPosture::LoopPosture(const Problem& problem, const LoopCoordinates& coordinates)
    : problem_(problem),
      coordinates_(coordinates),
      tip_(problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)]),
      kinematics_(problem.robot),
      q_(resting_joints(problem.robot).cast<Extended>()) {}

void LoopPosture::set(const ExtendedVector& x) {
  using std::cos;
  using std::sin;
  const auto& chain = coordinates_.chain.index;
  for (std::size_t i = 0; i < coordinates_.joints.size(); ++i) {
    q_[coordinates_.joints[i]] = x[chain[static_cast<std::size_t>(coordinates_.first) + i]];
  }
  kinematics_.set_joints(q_);
  if (coordinates_.first > 0) {
    const Extended yaw = x[chain[0]];
    yaw_.R << cos(yaw), -sin(yaw), 0, sin(yaw), cos(yaw), 0, 0, 0, 1;
  }
  const Pose<Extended> pose = exact_pose(problem_, x);
  const Pose<Extended> mount{problem_.robot.mount.R.cast<Extended>(),
                             problem_.robot.mount.p.cast<Extended>()};
  target_ = mount.inverse() * pose;

  // From the pose for the joints of the chain, from the base for all others.
  const Vector6<Extended> c = exact_direction(problem_, pose);
  const Matrix3<Extended> from_base = mount.R * yaw_.R;
  const Matrix3<Extended> from_tip = pose.R * kinematics_.end_effector(tip_).R.transpose();
  const Eigen::Index n = problem_.robot.velocities();
  const auto axes = static_cast<Eigen::Index>(problem_.robot.base_axes.size());
  loads_.resize(2 * n);
  kinematics_.gravity_and_buoyancy(from_base, tau_);
  kinematics_.jacobian(tip_, from_base, J_);
  loads_.head(n) = tau_;
  loads_.tail(n) = J_.transpose() * c;
  kinematics_.gravity_and_buoyancy(from_tip, tau_);
  kinematics_.jacobian(tip_, from_tip, J_);
  for (const int joint : coordinates_.joints) {
    loads_[axes + joint] = tau_[axes + joint];
    loads_[n + axes + joint] = J_.col(axes + joint).dot(c);
  }
}

Pose<Extended> LoopPosture::link(int k) const {
  if (k == 0) return {};
  const int joint = coordinates_.joints[static_cast<std::size_t>(k - 1)];
  return kinematics_.links()[static_cast<std::size_t>(joint) + 1];
}

ExtendedVector LoopPosture::rows_of(const Pose<Extended>& pose) const {
  ExtendedVector rows(12);
  for (int i = 0; i < 3; ++i) rows.segment<3>(3 * i) = pose.R.col(i);
  Eigen::Index count = 9;
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_free_axis(problem_.robot, axis)) rows[count++] = pose.p[axis];
  }
  return rows.head(count);
}

ExtendedVector LoopPosture::left(int k) const { return rows_of(yaw_ * link(k)); }

ExtendedVector LoopPosture::right(int k) const {
  return rows_of(target_ * (link(k).inverse() * kinematics_.end_effector(tip_)).inverse());
}

}  // namespace maxwrench
