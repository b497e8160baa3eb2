#include "lib/posture/pull_back.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;

/// G × x for G = [0, 0, -g].
Vector3d field_cross(double g, const Vector3d& x) { return {g * x.y(), -g * x.x(), 0}; }

}  // namespace

PullBack::PullBack(const Robot& robot, int end_effector, int second)
    : robot_(&robot),
      end_effector_(&robot.end_effectors[static_cast<std::size_t>(end_effector)]),
      nodes_(robot.links.size()) {
  for (int link = end_effector_->link; link > 0;
       link = robot.joints[static_cast<std::size_t>(link - 1)].parent) {
    nodes_[static_cast<std::size_t>(link)].on_chain = true;
    nodes_[static_cast<std::size_t>(link)].seeded = true;
  }
  int link = second < 0 ? 0 : robot.end_effectors[static_cast<std::size_t>(second)].link;
  for (; link > 0; link = robot.joints[static_cast<std::size_t>(link - 1)].parent) {
    nodes_[static_cast<std::size_t>(link)].seeded = true;
  }
}

/// Adds the part of tau_d to y and to the load.
void PullBack::collect_load(double t, Node& node) const {
  node.y_w -= t * field_cross(robot_->gravity, node.p);
  node.load += t * field_cross(robot_->gravity, node.w);
}

/// Adds the part of J to y.
void PullBack::collect_seed(const Matrix6Xd& J_seed, Eigen::Index column, Node& node) {
  const Vector3d a = J_seed.col(column).head<3>();
  const Vector3d b = J_seed.col(column).tail<3>();
  node.y_v -= node.w.cross(a);
  node.y_w -= node.v.cross(a) + node.w.cross(b);
}

/// Sets y and load of the base's own velocities.
void PullBack::set_base(const Kinematics<double>& kinematics, const Eigen::Matrix3d& R_base,
                        const Matrix6Xd& J, const Eigen::VectorXd& t, const Matrix6Xd& J_seed) {
  Node& base = nodes_[0];
  const double m = kinematics.carried_mass(0);
  const Vector3d c = R_base * (kinematics.carried_moment(0) - m * p_e_);
  base.y_v = base.y_w = base.load = Vector3d::Zero();
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(robot_->base_axes.size()); ++i) {
    base.v = J.col(i).head<3>();
    base.w = J.col(i).tail<3>();
    base.p = m * base.v + base.w.cross(c);
    collect_load(t[i], base);
    collect_seed(J_seed, i, base);
  }
}

/// Sets the screw of a joint, and p. Joints outside the chain have no column in J.
void PullBack::set_joint(const Kinematics<double>& kinematics, const Eigen::Matrix3d& R_base,
                         const Matrix6Xd& J, std::size_t joint) {
  Node& node = nodes_[joint + 1];
  if (node.on_chain) {
    const auto column = static_cast<Eigen::Index>(robot_->base_axes.size() + joint);
    node.v = J.col(column).head<3>();
    node.w = J.col(column).tail<3>();
  } else {
    const Vector3d axis = R_base * kinematics.joint_axis(joint);
    const bool turns = robot_->joints[joint].type == JointType::kRevolute;
    const Vector3d lever = R_base * (p_e_ - kinematics.links()[joint + 1].p);
    node.v = turns ? Vector3d(axis.cross(lever)) : axis;
    node.w = turns ? axis : Vector3d::Zero();
  }
  const double m = kinematics.carried_mass(joint + 1);
  const Vector3d c = R_base * (kinematics.carried_moment(joint + 1) - m * p_e_);
  node.p = m * node.v + node.w.cross(c);
}

void PullBack::evaluate(const Kinematics<double>& kinematics, const Eigen::Matrix3d& R_base,
                        const Matrix6Xd& J, const Eigen::VectorXd& t, const Matrix6Xd& J_seed,
                        Eigen::VectorXd& gradient) {
  p_e_ = kinematics.end_effector_position(*end_effector_);
  set_base(kinematics, R_base, J, t, J_seed);
  const std::size_t joints = robot_->joints.size();
  const auto axes = static_cast<Eigen::Index>(robot_->base_axes.size());
  const auto parent_of = [&](std::size_t k) -> Node& {
    return nodes_[static_cast<std::size_t>(robot_->joints[k].parent)];
  };
  for (std::size_t k = 0; k < joints; ++k) {
    Node& node = nodes_[k + 1];
    set_joint(kinematics, R_base, J, k);
    node.y_v = node.y_w = Vector3d::Zero();
    node.load = parent_of(k).load;
    const Eigen::Index column = axes + static_cast<Eigen::Index>(k);
    collect_load(t[column], node);
    if (node.seeded) collect_seed(J_seed, column, node);
  }
  for (std::size_t k = joints; k-- > 0;) {
    parent_of(k).y_v += nodes_[k + 1].y_v;
    parent_of(k).y_w += nodes_[k + 1].y_w;
  }
  const Node& base = nodes_[0];
  gradient.resize(static_cast<Eigen::Index>(joints));
  for (std::size_t k = 0; k < joints; ++k) {
    const Node& node = nodes_[k + 1];
    double slope = -node.v.dot(node.y_v) - node.w.dot(node.y_w) - node.p.dot(parent_of(k).load);
    if (node.on_chain) slope += node.v.dot(base.y_v) + node.w.dot(base.y_w);
    gradient[static_cast<Eigen::Index>(k)] = slope;
  }
}

}  // namespace maxwrench
