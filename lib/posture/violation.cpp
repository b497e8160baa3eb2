#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

bool outside(double x, double min, double max) {
  return x < min - kLimitTolerance || x > max + kLimitTolerance;
}

std::string shown_place(const std::string& name, double x, const char* unit, double min,
                        double max) {
  std::ostringstream text;
  text << name << " at " << x << ' ' << unit << ", limits " << min << " .. " << max;
  return text.str();
}

/// Describes the first coordinate of theta_r beyond its limits; empty if there is none.
std::string theta_r_beyond(const Problem& problem, const Posture& posture) {
  for (int i = 0; i < static_cast<int>(posture.theta_r.size()); ++i) {
    const double x = posture.theta_r[i], min = problem.theta_r_min[i], max = problem.theta_r_max[i];
    if (!outside(x, min, max)) continue;
    return shown_place(problem.theta_r_name(i), x, problem.theta_r_unit(i), min, max);
  }
  return "";
}

/// Describes the first of these joints beyond its limits; empty if there is none.
std::string joint_beyond(const Robot& robot, const std::vector<int>& joints,
                         const Eigen::VectorXd& q) {
  for (const int i : joints) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    if (!outside(q[i], joint.q_min, joint.q_max)) continue;
    const char* unit = joint.type == JointType::kRevolute ? "rad" : "m";
    return shown_place(joint.name, q[i], unit, joint.q_min, joint.q_max);
  }
  return "";
}

/// Describes the fixed coordinate in which the base is farthest from its mount.
std::string base_off_its_axes(const Robot& robot, const Pose<double>& base) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  const Pose<double> moved = robot.mount.inverse() * base;
  Vector6d along;
  along << moved.p, logarithm(moved.R);
  for (const int axis : robot.base_axes) along[axis] = 0;
  int i = 0;
  along.cwiseAbs().maxCoeff(&i);
  const char* axis = kAxes[static_cast<std::size_t>(i % 3)];
  std::ostringstream text;
  text << "it would be " << along[i] << (i < 3 ? " m along " : " rad about ") << axis
       << " from its mount";
  return text.str();
}

std::string detail_of(const Problem& problem, const Posture& posture) {
  const Robot& robot = problem.robot;
  switch (posture.violation) {
    case Violation::kThetaR:
      return theta_r_beyond(problem, posture);
    case Violation::kDependentJoint: {
      const std::string dependent = joint_beyond(robot, problem.dependent, posture.q);
      if (!dependent.empty()) return dependent;
      // In a posture that is given, a joint that does not move the end effector.
      std::vector<int> all(robot.joints.size());
      std::iota(all.begin(), all.end(), 0);
      return joint_beyond(robot, all, posture.q);
    }
    case Violation::kSecondArm:
      return joint_beyond(robot, problem.contact->follow, posture.q);
    case Violation::kBase:
      return base_off_its_axes(robot, posture.base);
    case Violation::kCollision: {
      // With a second arm the posture is the last of several, which may have another fault.
      const int pair = robot.collision ? robot.collision->colliding_pair(posture.links) : -1;
      return pair < 0 ? "" : robot.collision->pair_name(pair);
    }
    case Violation::kNone:
    case Violation::kNoSolution:
      break;
  }
  return "";
}

}  // namespace

std::string describe_violation(const Problem& problem, const Posture& posture) {
  if (posture.status == Status::kValid) return "";
  const std::string detail = detail_of(problem, posture);
  return detail.empty() ? posture.reason.str() : posture.reason.str() + ": " + detail;
}

}  // namespace maxwrench
