#include "lib/robot/dynamics_slopes.h"

#include <cmath>

namespace maxwrench {
namespace {

Vector6d spatial_vector(const Eigen::Vector3d& linear, const Eigen::Vector3d& angular) {
  Vector6d screw;
  screw << linear, angular;
  return screw;
}

/// V x S: the rate of a twist S that moves with the twist V.
Vector6d crossed(const Vector6d& V, const Vector6d& S) {
  const Eigen::Vector3d v = V.head<3>(), w = V.tail<3>(), s = S.head<3>(), turn = S.tail<3>();
  return spatial_vector(w.cross(s) + v.cross(turn), w.cross(turn));
}

/// V x* F: the rate of a wrench or momentum F that moves with the twist V.
Vector6d crossed_force(const Vector6d& V, const Vector6d& F) {
  const Eigen::Vector3d v = V.head<3>(), w = V.tail<3>(), f = F.head<3>(), m = F.tail<3>();
  return spatial_vector(w.cross(f), w.cross(m) + v.cross(f));
}

Eigen::Matrix<double, 6, 6> full(const Inertia<double>& inertia) {
  Eigen::Matrix<double, 6, 6> I;
  I << inertia.A, inertia.B, inertia.B.transpose(), inertia.C;
  return I;
}

}  // namespace

DynamicsSlopes::DynamicsSlopes(const Robot& robot)
    : robot_(robot),
      kinematics_(robot),
      carries_(robot.links.size(), robot.links.size()),
      bodies_(robot.links.size()),
      axes_(static_cast<std::size_t>(robot.velocities())),
      weight_(robot.velocities()),
      by_turn_(robot.velocities(), 3),
      by_q_(robot.velocities(), robot.joints.size()),
      by_v_(robot.velocities(), robot.velocities()),
      by_v_dot_(by_v_) {
  for (const Link& link : robot.links) inertia_.push_back(link_inertia(link));
  carries_.setConstant(false);
  for (int link = 0; link < static_cast<int>(robot.links.size()); ++link) {
    int carrier = link;
    for (; carrier != 0; carrier = robot.joints[static_cast<std::size_t>(carrier - 1)].parent) {
      carries_(carrier, link) = true;
    }
    carries_(0, link) = true;
  }
  const std::size_t base = robot.base_axes.size();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].link = i < base ? 0 : i - base + 1;
    if (i < base) axes_[i].s = Vector6d::Unit(robot.base_axes[i]);
  }
}

void DynamicsSlopes::set(const Matrix3<double>& R_base, const Eigen::VectorXd& q,
                         const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration,
                         const EndEffector& end_effector, const Vector6d& h_e) {
  kinematics_.set_joints(q);
  kinematics_.gravity_and_buoyancy(R_base, weight_);
  pull_ = -robot_.gravity * R_base.row(2).transpose();
  current_ = R_base.transpose() * robot_.current;
  p_e_ = kinematics_.end_effector_position(end_effector);
  force_ = R_base.transpose() * h_e.head<3>();
  torque_ = R_base.transpose() * h_e.tail<3>();
  tool_link_ = static_cast<std::size_t>(end_effector.link);
  set_axes();
  set_motion(velocity, acceleration);
  for (std::size_t link = 0; link < bodies_.size(); ++link) set_body(link);
  carry();
  fill_velocities();
  fill_places();
  fill_turns();
}

void DynamicsSlopes::set_axes() {
  const std::size_t base = robot_.base_axes.size();
  for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
    const Eigen::Vector3d axis = kinematics_.joint_axis(i);
    const bool turns = robot_.joints[i].type == JointType::kRevolute;
    axes_[base + i].s = turns ? spatial_vector(kinematics_.links()[i + 1].p.cross(axis), axis)
                              : spatial_vector(axis, Eigen::Vector3d::Zero());
  }
}

/// In fixed axes that coincide with the base's, as in `Dynamics`.
void DynamicsSlopes::set_motion(const Eigen::VectorXd& velocity,
                                const Eigen::VectorXd& acceleration) {
  const std::size_t base = robot_.base_axes.size();
  bodies_[0].V.setZero();
  bodies_[0].A.setZero();
  for (std::size_t i = 0; i < base; ++i) {
    bodies_[0].V[robot_.base_axes[i]] = velocity[static_cast<Eigen::Index>(i)];
    bodies_[0].A[robot_.base_axes[i]] = acceleration[static_cast<Eigen::Index>(i)];
  }
  if (!current_.isZero(0)) {
    const Eigen::Vector3d w = bodies_[0].V.tail<3>();
    bodies_[0].A.head<3>() += w.cross(current_);
    bodies_[0].V.head<3>() -= current_;
  }
  for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(base + i);
    const Body& parent = bodies_[static_cast<std::size_t>(robot_.joints[i].parent)];
    const Vector6d& s = axes_[base + i].s;
    bodies_[i + 1].V = parent.V + s * velocity[k];
    bodies_[i + 1].A = parent.A + s * acceleration[k] + crossed(parent.V, s) * velocity[k];
  }
}

/// A link's own I, B and F, without weight and h_e.
void DynamicsSlopes::set_body(std::size_t link) {
  Body& body = bodies_[link];
  body.I = full(moved<double>(kinematics_.links()[link], inertia_[link]));
  const Vector6d p = body.I * body.V;
  body.F = body.I * body.A + crossed_force(body.V, p);
  // V x as a matrix; V x* is its negative transpose.
  const Matrix3<double> v = skew<double>(body.V.head<3>()), w = skew<double>(body.V.tail<3>());
  Matrix6d V;
  V << w, v, Matrix3<double>::Zero(), w;
  const Matrix6d I_V = body.I * V;
  body.B = -I_V - I_V.transpose();
  // Y x* p
  const Matrix3<double> f = skew<double>(p.head<3>());
  body.B.topRightCorner<3, 3>() -= f;
  body.B.bottomLeftCorner<3, 3>() -= f;
  body.B.bottomRightCorner<3, 3>() -= skew<double>(p.tail<3>());
  add_drag(link);
}

void DynamicsSlopes::add_drag(std::size_t link) {
  Body& body = bodies_[link];
  const Screw<double> twist = {body.V.head<3>(), body.V.tail<3>()};
  for (const HydrodynamicBody& water : robot_.links[link].hydrodynamics) {
    const Pose<double> frame = kinematics_.links()[link] * water.frame;
    const Screw<double> seen = into(frame, twist);
    const Vector6d x = spatial_vector(seen.linear, seen.angular);
    const Vector6d slope =
        water.damping_linear + 2 * water.damping_quadratic.cwiseProduct(x.cwiseAbs());
    const Vector6d drag =
        (water.damping_linear + water.damping_quadratic.cwiseProduct(x.cwiseAbs())).cwiseProduct(x);
    const Eigen::Vector3d force = frame.R * drag.head<3>();
    body.F += spatial_vector(force, frame.R * drag.tail<3>() + frame.p.cross(force));
    body.B += full(moved<double>(frame, {slope.head<3>().asDiagonal(), Matrix3<double>::Zero(),
                                         slope.tail<3>().asDiagonal()}));
  }
}

/// Sums I, B and F over all links that a link carries, and adds weight and h_e to F.
void DynamicsSlopes::carry() {
  for (std::size_t i = robot_.joints.size(); i > 0; --i) {
    Body& parent = bodies_[static_cast<std::size_t>(robot_.joints[i - 1].parent)];
    parent.F += bodies_[i].F;
    parent.I += bodies_[i].I;
    parent.B += bodies_[i].B;
  }
  const Vector6d h = spatial_vector(force_, torque_ + p_e_.cross(force_));
  for (std::size_t link = 0; link < bodies_.size(); ++link) {
    bodies_[link].F -= spatial_vector(kinematics_.carried_mass(link) * pull_,
                                      kinematics_.carried_moment(link).cross(pull_));
    if (carries(link, tool_link_)) bodies_[link].F += h;
  }
  for (Axis& axis : axes_) {
    axis.I_s.noalias() = bodies_[axis.link].I * axis.s;
    axis.B_s.noalias() = bodies_[axis.link].B.transpose() * axis.s;
  }
}

/// The change of weight and h_e on all links that `link` carries, in the axes of these links, when
/// they turn by `turn`.
Vector6d DynamicsSlopes::turned_loads(std::size_t link, const Eigen::Vector3d& turn) const {
  const Eigen::Vector3d pull = pull_.cross(turn);
  Vector6d gained = spatial_vector(-kinematics_.carried_mass(link) * pull,
                                   pull.cross(kinematics_.carried_moment(link)));
  if (carries(link, tool_link_)) {
    const Eigen::Vector3d force = force_.cross(turn);
    gained += spatial_vector(force, torque_.cross(turn) + p_e_.cross(force));
  }
  return gained;
}

/// Fills by_v_ and by_v_dot_.
void DynamicsSlopes::fill_velocities() {
  const auto n = static_cast<Eigen::Index>(axes_.size());
  by_v_.setZero();
  by_v_dot_.setZero();
  for (Eigen::Index j = 0; j < n; ++j) {
    const Axis& moves = axes_[static_cast<std::size_t>(j)];
    // For the base, s is an axis of V_0 and turns with it.
    const bool joint = moves.link != 0;
    const std::size_t parent =
        joint ? static_cast<std::size_t>(robot_.joints[moves.link - 1].parent) : 0;
    Vector6d X = (joint ? 2 : 1) * crossed(bodies_[parent].V, moves.s);
    if (!joint && !current_.isZero(0)) {
      const Eigen::Vector3d turn = moves.s.tail<3>();
      X.head<3>() += turn.cross(current_);
    }
    const Body& carried = bodies_[moves.link];
    const Vector6d wrench = carried.I * X + carried.B * moves.s;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Axis& row = axes_[static_cast<std::size_t>(i)];
      if (carries(row.link, moves.link)) {
        by_v_(i, j) = row.s.dot(wrench);
        by_v_dot_(i, j) = row.s.dot(moves.I_s);
      } else if (carries(moves.link, row.link)) {
        by_v_(i, j) = row.I_s.dot(X) + row.B_s.dot(moves.s);
        by_v_dot_(i, j) = row.I_s.dot(moves.s);
      }
    }
  }
}

void DynamicsSlopes::fill_places() {
  const std::size_t base = robot_.base_axes.size();
  const auto n = static_cast<Eigen::Index>(axes_.size());
  by_q_.setZero();
  for (std::size_t j = base; j < axes_.size(); ++j) {
    const Axis& moves = axes_[j];
    const Body& parent = bodies_[static_cast<std::size_t>(robot_.joints[moves.link - 1].parent)];
    const Body& carried = bodies_[moves.link];
    const Eigen::Vector3d turn = moves.s.tail<3>();
    const Vector6d psi = crossed(parent.V, moves.s);
    const Vector6d X = crossed(parent.A, moves.s) + crossed(parent.V, psi);
    const Vector6d wrench = carried.I * X + carried.B * psi + crossed_force(moves.s, carried.F) +
                            turned_loads(moves.link, turn);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Axis& row = axes_[static_cast<std::size_t>(i)];
      double& slope = by_q_(i, static_cast<Eigen::Index>(j - base));
      if (carries(row.link, moves.link)) {
        slope = row.s.dot(wrench);
      } else if (carries(moves.link, row.link)) {
        slope = row.I_s.dot(X) + row.B_s.dot(psi) + row.s.dot(turned_loads(row.link, turn));
      }
    }
  }
}

void DynamicsSlopes::fill_turns() {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Vector6d gained = Vector6d::Zero();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const std::size_t link = axes_[i].link;
      if (i == 0 || link != axes_[i - 1].link)
        gained = turned_loads(link, Eigen::Vector3d::Unit(axis));
      double& slope = by_turn_(static_cast<Eigen::Index>(i), axis);
      slope = axes_[i].s.dot(gained);
      if (current_.isZero(0)) continue;
      const Eigen::Vector3d swept = Eigen::Vector3d::Unit(axis).cross(current_);
      slope += axes_[i].B_s.head<3>().dot(swept);
    }
  }
}

}  // namespace maxwrench
