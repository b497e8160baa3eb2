#include "lib/posture/ik/tool_chain.h"

#include <algorithm>
#include <cmath>

#include "lib/math/complex.h"
#include "lib/robot/chain.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

/// A rotation as a unit quaternion. Those of complex angles are unbounded, but only as the square
/// root of rotation matrices: products that cancel leave a rounding error of the square root, too.
template <class T>
struct Rotor {
  T w = T(1.0), x = T(0.0), y = T(0.0), z = T(0.0);

  void turn(const Eigen::Quaterniond& by) {
    const T w0 = w, x0 = x, y0 = y;
    w = w0 * by.w() - x0 * by.x() - y0 * by.y() - z * by.z();
    x = w0 * by.x() + x0 * by.w() + y0 * by.z() - z * by.y();
    y = w0 * by.y() + y0 * by.w() + z * by.x() - x0 * by.z();
    z = w0 * by.z() + z * by.w() + x0 * by.y() - y0 * by.x();
  }
  /// By the angle whose half has this cosine and sine.
  void turn_about_z(const T& c, const T& s) {
    const T w0 = w, x0 = x;
    w = w0 * c - z * s;
    z = z * c + w0 * s;
    x = x0 * c + y * s;
    y = y * c - x0 * s;
  }
  Vector3<T> z_axis() const {
    return {(x * z + w * y) * 2.0, (y * z - w * x) * 2.0, T(1.0) - (x * x + y * y) * 2.0};
  }
  Matrix3<T> matrix() const {
    const T x2 = x * 2.0, y2 = y * 2.0, z2 = z * 2.0;
    const T xx = x * x2, yy = y * y2, zz = z * z2, xy = x * y2, xz = x * z2, yz = y * z2;
    const T wx = w * x2, wy = w * y2, wz = w * z2;
    Matrix3<T> R;
    R.col(0) = Vector3<T>(T(1.0) - (yy + zz), xy + wz, xz - wy);
    R.col(1) = Vector3<T>(xy - wz, T(1.0) - (xx + zz), yz + wx);
    R.col(2) = Vector3<T>(xz + wy, yz - wx, T(1.0) - (xx + yy));
    return R;
  }
  /// Adds the turned vector to p.
  void carry(const Eigen::Vector3d& vector, Vector3<T>& p) const {
    if (vector.isZero(0)) return;
    const Eigen::Vector3d v = 2 * vector;
    const T a = y * v.z() - z * v.y(), b = z * v.x() - x * v.z(), c = x * v.y() - y * v.x();
    p[0] += vector.x() + w * a + (y * c - z * b);
    p[1] += vector.y() + w * b + (z * a - x * c);
    p[2] += vector.z() + w * c + (x * b - y * a);
  }
};

}  // namespace

ToolChain::ToolChain(const Problem& problem) : behind_(problem.robot.mount) {
  const Robot& robot = problem.robot;
  for (const int axis : robot.base_axes) {
    add({}, Eigen::Vector3d::Unit(axis % 3), axis >= 3);
    follows(std::min(axis, 3));
  }
  for (const int i : chain_to(robot, problem.end_effector)) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    add(joint.placement, joint.axis, joint.type == JointType::kRevolute);
    const int motor = joint.gear ? joint.gear->leader : i;
    const auto redundant = std::find(problem.redundant.begin(), problem.redundant.end(), motor);
    if (redundant != problem.redundant.end()) {
      coordinates_.back().parameter = static_cast<int>(redundant - problem.redundant.begin());
      if (joint.gear) {
        coordinates_.back().ratio = joint.gear->ratio;
        coordinates_.back().offset = joint.gear->offset;
      }
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
  coordinate.turn = Eigen::Quaterniond(coordinate.placement.R).normalized();
  coordinate.is_turned = !coordinate.placement.R.isIdentity(0);
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

/// Appends a coordinate that is the next parameter.
void ToolChain::add_parameter(const Pose<double>& placement, const Eigen::Vector3d& axis,
                              bool turns) {
  add(placement, axis, turns);
  coordinates_.back().parameter = parameters_++;
}

ToolChain ToolChain::deformable() const {
  ToolChain wide = *this;
  wide.coordinates_.clear();
  wide.places_.clear();
  wide.behind_ = {};
  const Eigen::Vector3d skew(std::cos(0.6), std::sin(0.6), 0);
  for (const Coordinate& at : coordinates_) {
    const bool moves = at.unknown > 0;
    if (moves) {
      wide.add_parameter(at.placement, skew, true);
      wide.add_parameter({}, skew, false);
    }
    wide.add(moves ? Pose<double>() : at.placement, Eigen::Vector3d::UnitZ(), at.turns);
    wide.coordinates_.back().unknown = at.unknown;
    wide.coordinates_.back().parameter = at.parameter;
    wide.coordinates_.back().ratio = at.ratio;
    wide.coordinates_.back().offset = at.offset;
    if (at.unknown >= 0) wide.places_.push_back(static_cast<int>(wide.coordinates_.size()) - 1);
  }
  wide.behind_ = behind_;
  return wide;
}

bool ToolChain::operator==(const ToolChain& other) const {
  const auto same_pose = [](const Pose<double>& a, const Pose<double>& b) {
    return a.R == b.R && a.p == b.p;
  };
  const auto same = [&](const Coordinate& a, const Coordinate& b) {
    return a.turns == b.turns && a.unknown == b.unknown && a.parameter == b.parameter &&
           a.ratio == b.ratio && a.offset == b.offset && same_pose(a.placement, b.placement);
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
  Rotor<T> rotor;
  Vector3<T> p;
  p.setConstant(T(0.0));
  for (std::size_t i = 0; i < n; ++i) {
    const Coordinate& at = coordinates_[i];
    const T value =
        at.unknown >= 0 ? y[at.unknown] : theta_r[at.parameter] * at.ratio + T(at.offset);
    rotor.carry(at.placement.p, p);
    if (at.is_turned) rotor.turn(at.turn);
    state.axes[i] = rotor.z_axis();
    if (at.turns) {
      rotor.turn_about_z(cos(value * 0.5), sin(value * 0.5));
    } else {
      p += state.axes[i] * value;
    }
    state.origins[i] = p;
  }
  rotor.carry(behind_.p, p);
  state.pose.p = p;
  state.pose.R = rotor.matrix() * behind_.R;
  state.J_r.resize(static_cast<std::size_t>(parameters_));
  for (Vector6<T>& column : state.J_r) column.setConstant(T(0.0));
  state.twist.setConstant(T(0.0));
  Vector6<T> column;
  for (std::size_t i = 0; i < n; ++i) {
    const Coordinate& at = coordinates_[i];
    if (at.turns) {
      column.template head<3>() = state.axes[i].cross(state.pose.p - state.origins[i]);
      column.template tail<3>() = state.axes[i];
    } else {
      column.template head<3>() = state.axes[i];
      column.template tail<3>().setConstant(T(0.0));
    }
    if (at.unknown >= 0) {
      state.J[static_cast<std::size_t>(at.unknown)] = column;
    } else {
      column = column * at.ratio;
      state.J_r[static_cast<std::size_t>(at.parameter)] += column;
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
