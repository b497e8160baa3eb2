#include "lib/robot/dynamics.h"

#include <cmath>

namespace maxwrench {
Dynamics::Dynamics(const Robot& robot)
    : robot_(&robot),
      kinematics_(robot),
      in_current_(!robot.current.isZero(0)),
      axes_(robot.joints.size()),
      twists_(robot.links.size()),
      twist_rates_(robot.links.size()),
      forces_(robot.links.size()),
      momenta_(robot.links.size()),
      carried_(robot.links.size()),
      zero_(Eigen::VectorXd::Zero(robot.velocities())),
      load_(robot.velocities()),
      tau_(robot.velocities()),
      M_(robot.velocities(), robot.velocities()),
      llt_(robot.velocities()),
      J_(6, robot.velocities()) {
  for (const Link& link : robot.links) inertia_.push_back(link_inertia(link));
}

void Dynamics::set_configuration(const Eigen::Matrix3d& R_base, const Eigen::VectorXd& q) {
  R_base_ = R_base;
  if (in_current_) current_.noalias() = R_base.transpose() * robot_->current;
  kinematics_.set_joints(q);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Pose<double>& link = kinematics_.links()[i + 1];
    const Eigen::Vector3d axis = link.R * robot_->joints[i].axis;
    if (robot_->joints[i].type == JointType::kRevolute) {
      axes_[i] = {link.p.cross(axis), axis};
    } else {
      axes_[i].linear = axis;
    }
  }
}

/// Composite bodies: a joint's column of M is the momentum that its unit rate gives to all links
/// that it carries, projected on the velocities of the base and of the joint's ancestors.
void Dynamics::mass_matrix(Eigen::MatrixXd& M) {
  const int base = static_cast<int>(robot_->base_axes.size());
  const int joints = static_cast<int>(axes_.size());
  for (int i = 0; i <= joints; ++i)
    carried_[i] = moved<double>(kinematics_.links()[i], inertia_[i]);
  for (int i = joints; i > 0; --i) {
    Inertia<double>& parent = carried_[robot_->joints[i - 1].parent];
    parent.A += carried_[i].A;
    parent.B += carried_[i].B;
    parent.C += carried_[i].C;
  }
  M.resize(base + joints, base + joints);
  M.setConstant(0.0);
  const auto base_rows = [&](int column, const Screw& p) {
    for (int row = 0; row < base; ++row) {
      M(row, column) = M(column, row) = component(p, robot_->base_axes[row]);
    }
  };
  for (int column = 0; column < base; ++column) {
    base_rows(column, momentum(carried_[0], base_unit(robot_->base_axes[column])));
  }
  for (int i = 0; i < joints; ++i) {
    const Screw p = momentum(carried_[i + 1], axes_[i]);
    base_rows(base + i, p);
    for (int link = i + 1; link != 0; link = robot_->joints[link - 1].parent) {
      const int row = base + link - 1;
      M(row, base + i) = M(base + i, row) = along(axes_[link - 1], p);
    }
  }
}

/// x'M y is the sum of V'I W over all links, with the twists V of x and W of y. In the axes of the
/// links that joint k carries, a turn of k leaves them at rest and turns their surroundings by
/// -s_k: it adds V_p x s_k to V and W_p x s_k to W, with p the parent. What they carry has the
/// momenta P and Q, so the slope is (V_p x s_k)'Q + (W_p x s_k)'P.
void Dynamics::mass_slopes(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                           Eigen::VectorXd& slopes) {
  set_momenta(x, twists_, momenta_);
  set_momenta(y, twist_rates_, forces_);
  slopes.resize(static_cast<Eigen::Index>(axes_.size()));
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const auto parent = static_cast<std::size_t>(robot_->joints[k].parent);
    slopes[static_cast<Eigen::Index>(k)] =
        along(crossed(twists_[parent], axes_[k]), forces_[k + 1]) +
        along(crossed(twist_rates_[parent], axes_[k]), momenta_[k + 1]);
  }
}

void Dynamics::coriolis(const Eigen::VectorXd& velocity, Eigen::VectorXd& C_v) {
  set_twists(velocity);
  set_twist_rates(velocity, zero_);
  clear_forces();
  add_inertial_forces();
  project_forces(C_v);
}

void Dynamics::damping(const Eigen::VectorXd& velocity, Eigen::VectorXd& D_v) {
  set_twists(velocity);
  clear_forces();
  add_drag();
  project_forces(D_v);
}

void Dynamics::inverse(const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration,
                       Eigen::VectorXd& tau_d) {
  set_twists(velocity);
  set_twist_rates(velocity, acceleration);
  clear_forces();
  add_inertial_forces();
  add_drag();
  project_forces(tau_d);
  gravity(load_);
  tau_d += load_;
}

void Dynamics::forward(const Eigen::VectorXd& velocity, const Eigen::VectorXd& tau,
                       Eigen::VectorXd& acceleration) {
  inverse(velocity, zero_, acceleration);
  acceleration = tau - acceleration;
  mass_matrix(M_);
  llt_.compute(M_);
  llt_.solveInPlace(acceleration);
}

void Dynamics::forward(const Eigen::VectorXd& velocity, const Eigen::VectorXd& tau,
                       const EndEffector& end_effector, const Vector6d& h_e,
                       Eigen::VectorXd& acceleration) {
  kinematics_.jacobian(end_effector, R_base_, J_);
  tau_.noalias() = tau - J_.transpose().lazyProduct(h_e);
  forward(velocity, tau_, acceleration);
}

/// The twist of the base at unit velocity along one of [x y z roll pitch yaw].
auto Dynamics::base_unit(int axis) -> Screw {
  Screw unit;
  (axis < 3 ? unit.linear : unit.angular)[axis % 3] = 1.0;
  return unit;
}

/// The base's entries of a velocity vector, as a twist.
auto Dynamics::base_twist(const Eigen::VectorXd& velocity) const -> Screw {
  Screw twist;
  for (std::size_t i = 0; i < robot_->base_axes.size(); ++i) {
    const int axis = robot_->base_axes[i];
    (axis < 3 ? twist.linear : twist.angular)[axis % 3] = velocity[static_cast<Eigen::Index>(i)];
  }
  return twist;
}

void Dynamics::set_twists(const Eigen::VectorXd& velocity) {
  twists_[0] = base_twist(velocity);
  if (in_current_) twists_[0].linear -= current_;
  spread(velocity, twists_);
}

/// Fills the twists of all links from that of the base.
void Dynamics::spread(const Eigen::VectorXd& velocity, std::vector<Screw>& twists) const {
  const auto base = static_cast<Eigen::Index>(robot_->base_axes.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Screw& parent = twists[robot_->joints[i].parent];
    const double& rate = velocity[base + static_cast<Eigen::Index>(i)];
    twists[i + 1] = {parent.linear + axes_[i].linear * rate,
                     parent.angular + axes_[i].angular * rate};
  }
}

/// The twists of all links in the world, and the momenta of each link with all that it carries.
void Dynamics::set_momenta(const Eigen::VectorXd& velocity, std::vector<Screw>& twists,
                           std::vector<Screw>& momenta) const {
  twists[0] = base_twist(velocity);
  spread(velocity, twists);
  for (int i = 0; i < static_cast<int>(inertia_.size()); ++i) {
    const Pose<double>& frame = kinematics_.links()[i];
    momenta[i] = in_base_axes(frame, momentum(inertia_[i], into(frame, twists[i])));
  }
  gather(momenta);
}

/// The rates are in fixed axes that coincide with the base's, in which a joint's axis moves with
/// its parent. For the base's own components, moving and fixed axes give the same rates.
void Dynamics::set_twist_rates(const Eigen::VectorXd& velocity,
                               const Eigen::VectorXd& acceleration) {
  const auto base = static_cast<Eigen::Index>(robot_->base_axes.size());
  twist_rates_[0] = base_twist(acceleration);
  if (in_current_) twist_rates_[0].linear += twists_[0].angular.cross(current_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto k = base + static_cast<Eigen::Index>(i);
    const Screw& carrier = twists_[robot_->joints[i].parent];
    const Screw& parent = twist_rates_[robot_->joints[i].parent];
    const Screw& axis = axes_[i];
    const Screw swept = crossed(carrier, axis);
    twist_rates_[i + 1] = {
        parent.linear + axis.linear * acceleration[k] + swept.linear * velocity[k],
        parent.angular + axis.angular * acceleration[k] + swept.angular * velocity[k]};
  }
}

void Dynamics::clear_forces() {
  for (Screw& force : forces_) force = Screw();
}

/// A wrench or momentum that is given at `frame`'s origin in its axes, at the base origin.
auto Dynamics::in_base_axes(const Pose<double>& frame, const Screw& wrench) -> Screw {
  const Eigen::Vector3d force = frame.R * wrench.linear;
  return {force, frame.R * wrench.angular + frame.p.cross(force)};
}

/// Adds a wrench that is given at `frame`'s origin in its axes.
void Dynamics::add_force(int link, const Pose<double>& frame, const Screw& wrench) {
  const Screw force = in_base_axes(frame, wrench);
  forces_[link].linear += force.linear;
  forces_[link].angular += force.angular;
}

/// The rate of each link's momentum, in the link's own axes, where its inertia is constant. For
/// momentum (p, L) and twist (v, w) it is p_d + w x p and L_d + w x L + v x p.
void Dynamics::add_inertial_forces() {
  for (int i = 0; i < static_cast<int>(inertia_.size()); ++i) {
    const Pose<double>& frame = kinematics_.links()[i];
    const Screw twist = into(frame, twists_[i]);
    const Screw p = momentum(inertia_[i], twist);
    Screw rate = momentum(inertia_[i], into(frame, twist_rates_[i]));
    rate.linear += twist.angular.cross(p.linear);
    rate.angular += twist.angular.cross(p.angular) + twist.linear.cross(p.linear);
    add_force(i, frame, rate);
  }
}

void Dynamics::add_drag() {
  using std::abs;
  for (int i = 0; i < static_cast<int>(inertia_.size()); ++i) {
    for (const HydrodynamicBody& body : robot_->links[i].hydrodynamics) {
      const Pose<double> frame = kinematics_.links()[i] * body.frame;
      Screw screw = into(frame, twists_[i]);
      for (int axis = 0; axis < 6; ++axis) {
        double& x = (axis < 3 ? screw.linear : screw.angular)[axis % 3];
        x *= body.damping_linear[axis] + body.damping_quadratic[axis] * abs(x);
      }
      add_force(i, frame, screw);
    }
  }
}

/// Adds to each link's force those of all links that it carries.
void Dynamics::gather(std::vector<Screw>& forces) const {
  for (std::size_t i = axes_.size(); i > 0; --i) {
    Screw& parent = forces[robot_->joints[i - 1].parent];
    parent.linear += forces[i].linear;
    parent.angular += forces[i].angular;
  }
}

/// Each force loads all joints between it and the base. Overwrites the forces.
void Dynamics::project_forces(Eigen::VectorXd& tau) {
  tau.resize(robot_->velocities());
  gather(forces_);
  Eigen::Index row = 0;
  for (const int axis : robot_->base_axes) tau[row++] = component(forces_[0], axis);
  for (std::size_t i = 0; i < axes_.size(); ++i) tau[row++] = along(axes_[i], forces_[i + 1]);
}

}  // namespace maxwrench
