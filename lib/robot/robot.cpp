#include "maxwrench/robot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace maxwrench {

bool base_axes_are_integrable(const std::vector<int>& axes) {
  static const std::array<std::vector<int>, 8> kAllowed = {
      {{}, {0}, {0, 1}, {0, 1, 2}, {5}, {0, 1, 5}, {0, 1, 2, 5}, {0, 1, 2, 3, 4, 5}}};
  return std::find(kAllowed.begin(), kAllowed.end(), axes) != kAllowed.end();
}

double turned_into_limits(const Joint& joint, double q) {
  if (joint.type != JointType::kRevolute) return q;
  constexpr double kTurn = 2 * std::numbers::pi;
  if (q > joint.q_max) q -= kTurn * std::ceil((q - joint.q_max) / kTurn);
  if (q < joint.q_min) q += kTurn * std::ceil((joint.q_min - q) / kTurn);
  return q;
}

void add_body(Link& link, double mass, const Eigen::Vector3d& com, const Eigen::Matrix3d& inertia) {
  // Parallel-axis theorem: about the common centre of mass, the two parts add the inertia of their
  // reduced mass at their distance.
  const Eigen::Vector3d apart = com - link.com;
  const double reduced = link.mass * mass / (link.mass + mass);
  link.inertia += inertia + reduced * (apart.squaredNorm() * Eigen::Matrix3d::Identity() -
                                       apart * apart.transpose());
  link.com += mass / (link.mass + mass) * apart;
  link.mass += mass;
}

void complete_actuation(Robot& robot) {
  const int n = robot.velocities();
  const int m = robot.actuators();
  const int base = static_cast<int>(robot.base_axes.size());
  const int thrusters = static_cast<int>(robot.thrusters.size());
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, m);
  Eigen::VectorXd u_min(m);
  Eigen::VectorXd u_max(m);
  robot.u_rate_max = Eigen::VectorXd::Constant(m, kInfinity);
  for (int j = 0; j < thrusters; ++j) {
    const Thruster& thruster = robot.thrusters[j];
    Vector6d column;
    column << thruster.direction, thruster.position.cross(thruster.direction);
    for (int i = 0; i < base; ++i) B(i, j) = column[robot.base_axes[i]];
    u_min[j] = thruster.force_min;
    u_max[j] = thruster.force_max;
    robot.u_rate_max[j] = thruster.force_rate_max;
  }
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
    B(base + j, thrusters + j) = 1;
    if (const auto& gear = robot.joints[j].gear)
      B(base + gear->leader, thrusters + j) = -gear->ratio;
    u_max[thrusters + j] = robot.joints[j].effort_max;
    u_min[thrusters + j] = -robot.joints[j].effort_max;
  }
  robot.actuation = make_zonotope(std::move(B), std::move(u_min), std::move(u_max));
}

}  // namespace maxwrench
