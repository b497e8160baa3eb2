#include "maxwrench/problem.h"

#include <stdexcept>

namespace maxwrench {

const char* to_string(Wrench wrench) { return wrench == Wrench::kPure ? "pure" : "any"; }

Wrench parse_wrench(const std::string& name) {
  if (name == "pure") return Wrench::kPure;
  if (name == "any") return Wrench::kAny;
  throw std::invalid_argument("wrench: got '" + name + "', expected pure or any");
}

const char* Problem::unit() const {
  if (!scenarios.empty()) return scenarios.unit;
  if (motion && motion->payload) return "kg";
  if (motion && motion->table) return "-";
  if (c.tail<3>().isZero()) return "N";
  if (c.head<3>().isZero()) return "N m";
  return "mixed";
}

const char* Problem::acceleration_unit() const {
  if (c.tail<3>().isZero()) return "m/s^2";
  if (c.head<3>().isZero()) return "rad/s^2";
  return "mixed";
}

const char* Problem::type() const {
  if (!motion) return "static";
  if (motion->transfer) return "transfer";
  return motion->impulse ? "impulse" : "trajectory";
}

std::string Problem::theta_r_name(int i) const {
  const int joints = static_cast<int>(redundant.size());
  if (i < joints) {
    return robot.joints[static_cast<std::size_t>(redundant[static_cast<std::size_t>(i)])].name;
  }
  if (i >= joints + free.count()) return "regrasp_" + std::to_string(i - joints - free.count() + 1);
  const int axis = free.axes[static_cast<std::size_t>(i - joints)];
  return std::string("pose_") + kTwistAxes[static_cast<std::size_t>(axis)];
}

const char* Problem::theta_r_unit(int i) const {
  const int joints = static_cast<int>(redundant.size());
  bool turns = contact && contact->surface == Surface::kCircle;
  if (i < joints) {
    const int joint = redundant[static_cast<std::size_t>(i)];
    turns = robot.joints[static_cast<std::size_t>(joint)].type == JointType::kRevolute;
  } else if (i < joints + free.count()) {
    turns = free.axes[static_cast<std::size_t>(i - joints)] >= 3;
  }
  return turns ? "rad" : "m";
}

}  // namespace maxwrench
