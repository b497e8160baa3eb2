#include "solvers/certify/bound/loop_posture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "lib/math/rotated.h"
#include "lib/posture/free_pose.h"
#include "lib/robot/brakes.h"
#include "lib/robot/chain.h"
#include "solvers/certify/bound/exact_posture.h"

namespace maxwrench {
namespace {

bool is_free_axis(const Robot& robot, int axis) {
  return std::find(robot.base_axes.begin(), robot.base_axes.end(), axis) != robot.base_axes.end();
}

/// Limits an angle to one turn, about the middle of its limits if they are finite.
void limit_to_a_turn(double& lower, double& upper) {
  if (upper - lower <= 2 * std::numbers::pi) return;
  double middle = 0;
  if (std::isfinite(lower)) middle = lower + std::numbers::pi;
  if (std::isfinite(upper)) middle = upper - std::numbers::pi;
  if (std::isfinite(lower) && std::isfinite(upper)) middle = (lower + upper) / 2;
  lower = middle - std::numbers::pi;
  upper = middle + std::numbers::pi;
}

/// The index of a joint in a list, or the list's size.
int place_in(const std::vector<int>& list, int joint) {
  return static_cast<int>(std::find(list.begin(), list.end(), joint) - list.begin());
}

Pose<Extended> exact_contact(const Contact& contact, const Extended* s) {
  using std::cos;
  using std::sin;
  Pose<Extended> pose{contact.frame.R.cast<Extended>(), contact.frame.p.cast<Extended>()};
  if (contact.surface == Surface::kCircle) {
    Matrix3<Extended> turn;
    turn << cos(s[0]), 0, sin(s[0]), 0, 1, 0, -sin(s[0]), 0, cos(s[0]);
    pose.R = pose.R * turn;
    pose.p -= pose.R.col(2) * contact.radius;
    return pose;
  }
  for (int i = 0; i < contact.coordinates(); ++i) pose.p += pose.R.col(i) * s[i];
  return pose;
}

/// [N] The most that the base's linear axes bear in addition to the weight and the first end
/// effector's force.
double most_force(const Problem& problem) {
  const Robot& robot = problem.robot;
  const Zonotope& set = robot.actuation;
  std::vector<int> linear;
  for (std::size_t i = 0; i < robot.base_axes.size(); ++i) {
    if (robot.base_axes[i] < 3) linear.push_back(static_cast<int>(i));
  }
  double weight = -robot.trim.buoyancy_mass;
  for (const Link& link : robot.links) weight += link.mass - robot.water_density * link.volume;
  double most = std::abs(weight) * robot.gravity;
  for (Eigen::Index k = 0; k < set.actuators(); ++k) {
    most += std::max(std::abs(set.u_min[k]), std::abs(set.u_max[k])) * set.B.col(k)(linear).norm();
  }
  return most * (1 + 1e-9);
}

/// A number that |force on the base's free linear axes| exceeds for any w with a component of size
/// 1; zero if none is known. It is the smallest singular value of the forces. If no component is
/// negative, it may also be the least component of the forces along the middle of their cone.
double least_force(const Problem& problem) {
  const Contact& contact = *problem.contact;
  const auto moves = [&](int axis) { return is_free_axis(problem.robot, axis); };
  if (!moves(0) || !moves(1)) return 0;
  Eigen::MatrixXd forces =
      problem.robot.mount.R.transpose() * contact.frame.R * contact.C.topRows<3>();
  if (!moves(2)) {  // the yaw turns the first two only
    if (contact.surface == Surface::kCircle) return 0;
    forces = forces.topRows(2).eval();
  }
  const double least = forces.cols() > forces.rows() ? 0 : singular_values(forces).minCoeff();
  if (contact.w_min.minCoeff() < 0) return least;
  const Eigen::VectorXd middle = forces.rowwise().sum().normalized();
  return std::max(least, (middle.transpose() * forces).minCoeff());
}

}  // namespace

bool base_determines_forces(const Problem& problem) {
  if (!problem.contact || problem.robot.base_axes.size() != 6 ||
      problem.robot.thrusters.size() > kMostPatternThrusters) {
    return false;
  }
  const Contact& contact = *problem.contact;
  return contact.C.cols() == 3 && contact.C.bottomRows<3>().isZero(0) &&
         singular_values(contact.C.topRows<3>()).minCoeff() > 1e-6 &&
         contact.w_min.array().maxCoeff() == -kInfinity &&
         contact.w_max.array().minCoeff() == kInfinity;
}

std::optional<int> coordinate_about_yaw(const Problem& problem) {
  constexpr double kUpright = 1e-15;  // as exact as a rotation of rounded numbers
  const Robot& robot = problem.robot;
  for (const int axis : {0, 1, 5}) {
    if (!is_free_axis(robot, axis)) return std::nullopt;
  }
  if (problem.dependent.empty() || problem.contact || !is_parked(robot)) return std::nullopt;
  const std::vector<int> chain = chain_to(robot, problem.end_effector);
  if (chain.empty()) return std::nullopt;
  const Joint& joint = robot.joints[static_cast<std::size_t>(chain.front())];
  const Eigen::Vector3d axis = joint.placement.R * joint.axis;
  const auto is_upright = [](const Eigen::Vector3d& x) { return x.head<2>().norm() <= kUpright; };
  if (joint.type != JointType::kRevolute || !is_upright(axis)) return std::nullopt;
  // On a tilted floor, the yaw changes what other joints bear.
  if (chain.size() < robot.joints.size() && !is_upright(robot.mount.R.col(2))) return std::nullopt;
  const int at = place_in(problem.redundant, chain.front());
  if (at == static_cast<int>(problem.redundant.size())) return std::nullopt;
  return at;
}

LoopCoordinates::LoopCoordinates(const Problem& problem, ContactForces forces,
                                 std::optional<int> about_yaw)
    : base_is_dependent(problem.robot.base_axes.size() == 6 ||
                        (problem.dependent.empty() && !problem.contact)) {
  const auto own = static_cast<int>(problem.redundancy());
  int next = own + static_cast<int>(problem.dependent.size());
  if (problem.contact) {
    for (const int joint : problem.contact->follow) add_joint(problem, next++, joint);
  }
  second = {0, chain.count()};
  if (!base_is_dependent && is_free_axis(problem.robot, 5)) {
    add(next++, true, -std::numbers::pi, std::numbers::pi);
  }
  yaw = {second.to, chain.count()};
  joints = chain_to(problem.robot, problem.end_effector);
  if (about_yaw) {
    left_out = *about_yaw;
    resting = joints.front();
    joints.erase(joints.begin());
  }
  for (const int joint : joints) {
    const int at = place_in(problem.redundant, joint);
    const bool given = at < static_cast<int>(problem.redundant.size());
    add_joint(problem, given ? at : own + place_in(problem.dependent, joint), joint);
  }
  first = {yaw.to, chain.count()};
  auto at = static_cast<int>(problem.redundant.size());
  const auto add_own = [&](bool turns) {
    add(at, turns, problem.theta_r_min[at], problem.theta_r_max[at]);
    ++at;
  };
  for (const int axis : problem.free.axes) add_own(axis >= 3);
  free = {first.to, chain.count()};
  while (at < own) add_own(problem.contact->surface == Surface::kCircle);
  regrasp = {free.to, chain.count()};
  if (problem.contact && forces == ContactForces::kShares) limit_forces(problem);
  for (Eigen::Index k = 0; k < w_min.size(); ++k) add(next++, false, 0, 1);
  shares = {regrasp.to, chain.count()};
  if (about_yaw) {
    lower[left_out] = problem.theta_r_min[left_out];
    upper[left_out] = problem.theta_r_max[left_out];
  }
}

void LoopCoordinates::add(int at, bool turns, double low, double high) {
  if (lower.size() <= at) {
    lower.conservativeResize(at + 1);
    upper.conservativeResize(at + 1);
  }
  lower[at] = low;
  upper[at] = high;
  chain.index.push_back(at);
  chain.turns.push_back(turns);
  if (turns) limit_to_a_turn(lower[at], upper[at]);
}

void LoopCoordinates::add_joint(const Problem& problem, int at, int joint) {
  const Joint& of = problem.robot.joints[static_cast<std::size_t>(joint)];
  const bool given = at < problem.redundancy();
  add(at, of.type == JointType::kRevolute, given ? problem.theta_r_min[at] : of.q_min,
      given ? problem.theta_r_max[at] : of.q_max);
}

/// The base's free linear axes bear only the weight, t c and the second contact's force, so each
/// |w_k| <= (most_force + t |force of c|)/least_force.
void LoopCoordinates::limit_forces(const Problem& problem) {
  w_min = problem.contact->w_min;
  w_max = problem.contact->w_max;
  v_min = v_max = Eigen::VectorXd::Zero(w_min.size());
  if (w_min.allFinite() && w_max.allFinite()) return;
  const double least = least_force(problem);
  if (!(least > 1e-6)) {
    throw std::invalid_argument(problem.name +
                                ": contact.forces: got forces without limits, expected limits, or "
                                "a base whose free axes bear each of them, for a proof");
  }
  const double most = most_force(problem) / least, by_t = problem.c.head<3>().norm() / least;
  for (Eigen::Index k = 0; k < w_min.size(); ++k) {
    if (std::isfinite(w_min[k]) && std::isfinite(w_max[k])) continue;
    const double low = w_min[k] >= 0 ? 0 : -1, high = w_max[k] <= 0 ? 0 : 1;
    w_min[k] = low * most;
    w_max[k] = high * most;
    v_min[k] = low * by_t * (1 + 1e-9);
    v_max[k] = high * by_t * (1 + 1e-9);
  }
}

LoopPosture::LoopPosture(const Problem& problem, const LoopCoordinates& coordinates)
    : problem_(problem),
      coordinates_(coordinates),
      tip_(problem.robot.end_effectors[static_cast<std::size_t>(problem.end_effector)]),
      kinematics_(problem.robot) {
  q_ = (problem.contact ? problem.contact->q_rest : resting_joints(problem.robot)).cast<Extended>();
}

void LoopPosture::set(const ExtendedVector& x) {
  using std::cos;
  using std::sin;
  const auto at = [&](int i) { return x[coordinates_.chain.index[static_cast<std::size_t>(i)]]; };
  const auto& first = coordinates_.first;
  for (int i = first.from; i < first.to; ++i) {
    q_[coordinates_.joints[static_cast<std::size_t>(i - first.from)]] = at(i);
  }
  for (int i = 0; i < coordinates_.second.to; ++i) {
    q_[problem_.contact->follow[static_cast<std::size_t>(i)]] = at(i);
  }
  kinematics_.set_joints(q_);
  if (coordinates_.yaw.count() > 0) {
    const Extended yaw = at(coordinates_.yaw.from);
    yaw_.R << cos(yaw), -sin(yaw), 0, sin(yaw), cos(yaw), 0, 0, 0, 1;
  }
  pose_ = free_pose(problem_, x);
  const Pose<Extended> mount{problem_.robot.mount.R.cast<Extended>(),
                             problem_.robot.mount.p.cast<Extended>()};
  target_ = mount.inverse() * pose_;
  const Matrix3<Extended> from_tip = pose_.R * kinematics_.end_effector(tip_).R.transpose();
  R_base_ = coordinates_.base_is_dependent ? from_tip : Matrix3<Extended>(mount.R * yaw_.R);
  if (problem_.contact) set_contact(x);
  set_loads(from_tip);
}

/// Joints of the chain are loaded from the end effector's pose, all others from the base.
void LoopPosture::set_loads(const Matrix3<Extended>& from_tip) {
  const Vector6<Extended> c = exact_turned(problem_, pose_, problem_.c);
  const Matrix6X<Extended> W = exact_turned(problem_, pose_, W_);
  const Eigen::Index n = problem_.robot.velocities();
  const auto axes = static_cast<Eigen::Index>(problem_.robot.base_axes.size());
  loads_.resize(2 * n);
  kinematics_.gravity_and_buoyancy(R_base_, tau_);
  kinematics_.jacobian(tip_, R_base_, J_);
  loads_.head(n) = tau_;
  loads_.tail(n) = J_.transpose() * c;
  columns_ = J_.transpose() * W;
  kinematics_.gravity_and_buoyancy(from_tip, tau_);
  kinematics_.jacobian(tip_, from_tip, J_);
  const auto load = [&](int joint) {
    loads_[axes + joint] = tau_[axes + joint];
    loads_[n + axes + joint] = J_.col(axes + joint).dot(c);
    columns_.row(axes + joint) = J_.col(axes + joint).transpose() * W;
  };
  if (coordinates_.resting) load(*coordinates_.resting);
  for (const int joint : coordinates_.joints) load(joint);
}

void LoopPosture::set_contact(const ExtendedVector& x) {
  const Contact& contact = *problem_.contact;
  const Eigen::Index own = problem_.redundancy();
  contact_ = exact_contact(contact, x.data() + (own - contact.coordinates()));
  const Eigen::Index l = coordinates_.w_min.size();
  const auto at_shares = [&](const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
    const ExtendedVector from = low.cast<Extended>();
    return ExtendedVector(from + x.tail(l).cwiseProduct(high.cast<Extended>() - from));
  };
  w_ = at_shares(coordinates_.w_min, coordinates_.w_max);
  v_ = at_shares(coordinates_.v_min, coordinates_.v_max);
}

ExtendedVector LoopPosture::forces(const ExtendedVector& w) const {
  const Contact& contact = *problem_.contact;
  const Vector6<Extended> h = contact.C.cast<Extended>() * w;
  Matrix6X<Extended> J_2;
  const auto touching = static_cast<std::size_t>(contact.end_effector);
  kinematics_.jacobian(problem_.robot.end_effectors[touching], R_base_, J_2);
  return J_2.transpose() * rotated(contact_.R, h);
}

MatrixX<Extended> LoopPosture::levers() const {
  const auto touching = static_cast<std::size_t>(problem_.contact->end_effector);
  Matrix6X<Extended> J_2;
  kinematics_.jacobian(problem_.robot.end_effectors[touching], Matrix3<Extended>::Identity(), J_2);
  return J_2.topRows<3>().transpose();
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

ExtendedVector LoopPosture::contact_rows(const Pose<Extended>& pose) const {
  ExtendedVector rows(problem_.contact->holds_axes ? 12 : 3);
  rows.head<3>() = pose.p;
  for (int i = 0; i < 3 && rows.size() > 3; ++i) rows.segment<3>(3 + 3 * i) = pose.R.col(i);
  return rows;
}

ExtendedVector LoopPosture::touching() const {
  const auto at = static_cast<std::size_t>(problem_.contact->end_effector);
  return contact_rows(kinematics_.end_effector(problem_.robot.end_effectors[at]));
}

ExtendedVector LoopPosture::touched() const {
  return contact_rows(kinematics_.end_effector(tip_) * pose_.inverse() * contact_);
}

}  // namespace maxwrench
