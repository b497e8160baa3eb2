#include "lib/robot/kinematics.h"

#include <cmath>

#include "lib/math/dual.h"
#include "lib/math/extended.h"

namespace maxwrench {

template <class T>
Kinematics<T>::Kinematics(const Robot& robot) : robot_(&robot) {
  for (const Joint& joint : robot.joints) {
    const Matrix3<double> S = skew(joint.axis);
    const Matrix3<double>& R = joint.placement.R;
    all_joints_.push_back(static_cast<int>(constants_.size()));
    constants_.push_back({{R, R * S, R * S * S}, joint.axis});
  }
  links_.resize(robot.links.size());
  for (const Link& link : robot.links) {
    const double displaced_mass = robot.water_density * link.volume;
    own_mass_.push_back(link.mass - displaced_mass);
    own_moment_.push_back(link.mass * link.com - displaced_mass * link.cob);
  }
  own_mass_[0] -= robot.trim.buoyancy_mass;
  own_moment_[0] -= robot.trim.buoyancy_mass * robot.trim.position;
  carried_moment_.resize(robot.links.size());
  set_loads({});
}

template <class T>
void Kinematics<T>::set_loads(const std::vector<LinkLoad>& loads) {
  link_mass_ = own_mass_;
  link_moment_ = own_moment_;
  for (const LinkLoad& load : loads) {
    const auto link = static_cast<std::size_t>(load.link);
    link_mass_[link] += load.mass;
    link_moment_[link] += load.moment;
  }
  carried_mass_ = link_mass_;
  for (std::size_t i = robot_->joints.size(); i-- > 0;) {
    carried_mass_[robot_->joints[i].parent] += carried_mass_[i + 1];
  }
}

template <class T>
void Kinematics<T>::set_joints(const VectorX<T>& q, const std::vector<int>& changed) {
  using std::cos;
  using std::sin;
  for (const int i : changed) {
    const Joint& joint = robot_->joints[i];
    const auto& K = constants_[i].K;
    Pose<T> motion;
    if (joint.type == JointType::kRevolute) {
      const T s = sin(q[i]);
      const T v = 1.0 - cos(q[i]);
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) motion.R(r, c) = K[0](r, c) + s * K[1](r, c) + v * K[2](r, c);
        motion.p[r] = joint.placement.p[r];
      }
    } else {
      const Vector3<double> direction = joint.placement.R * joint.axis;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) motion.R(r, c) = K[0](r, c);
        motion.p[r] = joint.placement.p[r] + direction[r] * q[i];
      }
    }
    links_[i + 1] = joint.parent == 0 ? motion : links_[joint.parent] * motion;
  }
}

template <class T>
void Kinematics<T>::jacobian(const EndEffector& end_effector, const Matrix3<T>& R_base,
                             Matrix6X<T>& J) const {
  const Vector3<T> p = end_effector_position(end_effector);
  const Vector3<T> r = R_base * p;
  const T zero(0.0);
  J.resize(6, robot_->velocities());  // J is the caller's and may be empty
  J.setConstant(zero);
  int column = 0;
  for (const int axis : robot_->base_axes) {
    if (axis < 3) {
      J.col(column).template head<3>() = R_base.col(axis);
    } else {
      const Vector3<T> a = R_base.col(axis - 3);
      J.col(column).template head<3>() = a.cross(r);
      J.col(column).template tail<3>() = a;
    }
    ++column;
  }
  for (int link = end_effector.link; link != 0; link = robot_->joints[link - 1].parent) {
    const int joint = link - 1;
    const Vector3<T> axis = R_base * joint_axis(static_cast<std::size_t>(joint));
    auto target = J.col(column + joint);
    if (robot_->joints[joint].type == JointType::kRevolute) {
      const Vector3<T> lever = R_base * Vector3<T>(p - links_[link].p);
      target.template head<3>() = axis.cross(lever);
      target.template tail<3>() = axis;
    } else {
      target.template head<3>() = axis;
    }
  }
}

template <class T>
void Kinematics<T>::gravity_and_buoyancy(const Matrix3<T>& R_base, VectorX<T>& tau_d) {
  // In base axes, the weight of a body of wet mass m is m * pull, and its moment about the base
  // origin is moment x pull.
  const Vector3<T> pull = R_base.row(2).transpose() * T(-robot_->gravity);
  const int joints = static_cast<int>(constants_.size());
  for (int i = 0; i <= joints; ++i) {
    carried_moment_[i] = links_[i].R * link_moment_[i] + links_[i].p * link_mass_[i];
  }
  tau_d.resize(robot_->velocities());
  const int axes = static_cast<int>(robot_->base_axes.size());
  for (int i = joints; i-- > 0;) {
    const Joint& joint = robot_->joints[i];
    const Pose<T>& link = links_[i + 1];
    const Vector3<T> moment = carried_moment_[i + 1];
    const Vector3<T> axis = joint_axis(static_cast<std::size_t>(i));
    carried_moment_[joint.parent] += moment;
    if (joint.type == JointType::kRevolute) {
      const Vector3<T> arm = moment - link.p * carried_mass_[i + 1];
      tau_d[axes + i] = -axis.dot(Vector3<T>(arm.cross(pull)));
    } else {
      tau_d[axes + i] = -carried_mass_[i + 1] * axis.dot(pull);
    }
  }
  const Vector3<T> base_moment = carried_moment_[0].cross(pull);
  int row = 0;
  for (const int axis : robot_->base_axes) {
    tau_d[row++] = axis < 3 ? T(-carried_mass_[0] * pull[axis]) : T(-base_moment[axis - 3]);
  }
}

template class Kinematics<double>;
template class Kinematics<Dual<4>>;
template class Kinematics<Extended>;

}  // namespace maxwrench
