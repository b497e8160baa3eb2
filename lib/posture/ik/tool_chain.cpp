#include "lib/posture/ik/tool_chain.h"

#include <algorithm>
#include <cmath>

#include "lib/math/complex.h"
#include "lib/robot/chain.h"
#include "maxwrench/problem.h"

namespace maxwrench {

ToolChain::ToolChain(const Problem& problem) : behind_(problem.robot.mount) {
  const Robot& robot = problem.robot;
  for (const int axis : robot.base_axes) {
    add({}, Eigen::Vector3d::Unit(axis % 3), axis >= 3);
    follows(std::min(axis, 3));
  }
  for (const int i : chain_to(robot, problem.end_effector)) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    add(joint.placement, joint.axis, joint.type == JointType::kRevolute);
    const auto redundant = std::find(problem.redundant.begin(), problem.redundant.end(), i);
    if (redundant != problem.redundant.end()) {
      coordinates_.back().parameter = static_cast<int>(redundant - problem.redundant.begin());
      continue;
    }
    follows(4 + i);
  }
  parameters_ = static_cast<int>(problem.redundant.size());
  behind_ = behind_ * robot.end_effectors[static_cast<std::size_t>(problem.end_effector)].placement;
  add_free(problem.free);
}

void ToolChain::add(const Pose<double>& placement, const Eigen::Vector3d& axis, bool turns) {
  const Eigen::Matrix3d R =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  const Pose<double> onto_axis{R, Eigen::Vector3d::Zero()};
  Coordinate coordinate;
  coordinate.placement = behind_ * placement * onto_axis;
  coordinate.turns = turns;
  coordinates_.push_back(coordinate);
  behind_ = onto_axis.inverse();
}

/// Appends D(s)^-1 after the end effector, so that the chain ends at X_0: X_e(theta_r, y) D(s)^-1 =
/// X_0.
void ToolChain::add_free(const FreePose& free) {
  const auto add_axis = [&](int axis) {
    const auto found = std::find(free.axes.begin(), free.axes.end(), axis);
    if (found == free.axes.end()) return;
    add({}, -Eigen::Vector3d::Unit(axis % 3), axis >= 3);
    coordinates_.back().parameter = parameters_ + static_cast<int>(found - free.axes.begin());
  };
  const auto add_axes = [&](int first) {
    for (int axis = first; axis < first + 3; ++axis) add_axis(axis);
  };
  add_axes(free.along_end_effector ? 0 : 3);
  add_axes(free.along_end_effector ? 3 : 0);
  parameters_ += free.count();
}

/// Makes the last coordinate the next y.
void ToolChain::follows(int place_in_z) {
  coordinates_.back().unknown = unknowns();
  places_.push_back(static_cast<int>(coordinates_.size()) - 1);
  in_z_.push_back(place_in_z);
}

bool ToolChain::operator==(const ToolChain& other) const {
  const auto same_pose = [](const Pose<double>& a, const Pose<double>& b) {
    return a.R == b.R && a.p == b.p;
  };
  const auto same = [&](const Coordinate& a, const Coordinate& b) {
    return a.turns == b.turns && a.unknown == b.unknown && a.parameter == b.parameter &&
           same_pose(a.placement, b.placement);
  };
  return in_z_ == other.in_z_ && same_pose(behind_, other.behind_) &&
         std::equal(coordinates_.begin(), coordinates_.end(), other.coordinates_.begin(),
                    other.coordinates_.end(), same);
}

template <class T>
void ToolChain::evaluate(const T* theta_r, const T* y, const T* theta_r_rate, const T* y_rate,
                         ToolState<T>& state) const {
  using std::cos;
  using std::sin;
  const std::size_t n = coordinates_.size();
  state.axes.resize(n);
  state.origins.resize(n);
  Pose<T> frame;
  for (std::size_t i = 0; i < n; ++i) {
    const Coordinate& at = coordinates_[i];
    const T value = at.unknown >= 0 ? y[at.unknown] : theta_r[at.parameter];
    frame.p += frame.R * at.placement.p;
    frame.R = (frame.R * at.placement.R).eval();
    state.axes[i] = frame.R.col(2);
    if (at.turns) {
      const T c = cos(value), s = sin(value);
      const Vector3<T> e_x = frame.R.col(0), e_y = frame.R.col(1);
      frame.R.col(0) = e_x * c + e_y * s;
      frame.R.col(1) = e_y * c - e_x * s;
    } else {
      frame.p += state.axes[i] * value;
    }
    state.origins[i] = frame.p;
  }
  state.pose.p = frame.p + frame.R * behind_.p;
  state.pose.R = frame.R * behind_.R;
  state.J_r.resize(static_cast<std::size_t>(parameters_));
  state.twist.setConstant(T(0.0));
  for (std::size_t i = 0; i < n; ++i) {
    const Coordinate& at = coordinates_[i];
    Vector6<T>& column = at.unknown >= 0 ? state.J[static_cast<std::size_t>(at.unknown)]
                                         : state.J_r[static_cast<std::size_t>(at.parameter)];
    if (at.turns) {
      column.template head<3>() = state.axes[i].cross(state.pose.p - state.origins[i]);
      column.template tail<3>() = state.axes[i];
    } else {
      column.template head<3>() = state.axes[i];
      column.template tail<3>().setConstant(T(0.0));
    }
    const T* const rate = at.unknown >= 0 ? y_rate : theta_r_rate;
    if (rate) state.twist += column * rate[std::max(at.unknown, at.parameter)];
  }
}

template void ToolChain::evaluate(const double*, const double*, const double*, const double*,
                                  ToolState<double>&) const;
template void ToolChain::evaluate(const Complex*, const Complex*, const Complex*, const Complex*,
                                  ToolState<Complex>&) const;

}  // namespace maxwrench
