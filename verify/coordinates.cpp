#include "verify/coordinates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace maxwrench {
namespace {

/// The axis of a joint about the yaw may be off by this share, a rounding error of rotations. The
/// equations allow for more.
constexpr double kUpright = 1e-15;

void throw_unless_supported(bool supports, const Problem& problem) {
  if (supports) return;
  throw std::invalid_argument(problem.name +
                              ": expected a static task, and joints that move the end effector");
}

/// A joint with a gear is taken to rest, as its leader does.
void throw_on_moving_gears(const Problem& problem, const std::vector<int>& of_joint) {
  for (std::size_t i = 0; i < of_joint.size(); ++i) {
    const Joint& joint = problem.robot.joints[i];
    if (!joint.gear) continue;
    if (of_joint[i] < 0 && of_joint[static_cast<std::size_t>(joint.gear->leader)] < 0) continue;
    throw std::invalid_argument(problem.name + ": got a gear that moves '" + joint.name +
                                "', expected joints of the end effector without gears");
  }
}

std::vector<int> joints_between(const Problem& problem) {
  const Robot& robot = problem.robot;
  std::vector<int> joints;
  for (int link = robot.end_effectors[static_cast<std::size_t>(problem.end_effector)].link;
       link > 0; link = robot.joints[static_cast<std::size_t>(link - 1)].parent) {
    joints.insert(joints.begin(), link - 1);
  }
  return joints;
}

int place_of(const std::vector<int>& list, int joint) {
  return static_cast<int>(std::find(list.begin(), list.end(), joint) - list.begin());
}

}  // namespace

bool forces_follow_from_base(const Problem& problem) {
  if (!problem.contact || problem.robot.base_axes.size() != 6) return false;
  const Contact& contact = *problem.contact;
  const Eigen::MatrixXd& C = contact.C;
  return C.cols() == 3 && C.bottomRows(3).isZero(0) &&
         Eigen::JacobiSVD<Eigen::Matrix3d>(C.topRows<3>()).singularValues()[2] > 1e-6 &&
         (contact.w_min.array() == -kInfinity).all() && (contact.w_max.array() == kInfinity).all();
}

int joint_about_yaw(const Problem& problem) {
  const Robot& robot = problem.robot;
  const std::vector<int>& axes = robot.base_axes;
  for (const int axis : {0, 1, 5}) {
    if (place_of(axes, axis) == static_cast<int>(axes.size())) return -1;
  }
  const std::vector<int> chain = joints_between(problem);
  if (axes.size() == 6 || problem.dependent.empty() || problem.contact || chain.empty()) return -1;
  const int first = chain.front();
  if (place_of(problem.redundant, first) == static_cast<int>(problem.redundant.size())) return -1;
  const Joint& joint = robot.joints[static_cast<std::size_t>(first)];
  const Eigen::Vector3d axis = joint.placement.R * joint.axis;
  const bool upright = std::abs(axis[0]) <= kUpright && std::abs(axis[1]) <= kUpright;
  return joint.type == JointType::kRevolute && upright ? first : -1;
}

PostureCoordinates::PostureCoordinates(const Problem& problem, const CoordinateChoice& choice)
    : of_joint(problem.robot.joints.size(), -1),
      chain(joints_between(problem)),
      resting(choice.without) {
  throw_unless_supported(!problem.motion, problem);
  const Robot& robot = problem.robot;
  const int own = problem.redundancy(), given = static_cast<int>(problem.redundant.size());
  const auto add_joint = [&](int joint, int coordinate) {
    const Joint& at = robot.joints[static_cast<std::size_t>(joint)];
    of_joint[static_cast<std::size_t>(joint)] = count();
    variables.push_back({at.type == JointType::kRevolute, coordinate, at.q_min, at.q_max});
  };
  int next = own + static_cast<int>(problem.dependent.size());
  if (problem.contact) {
    for (const int joint : problem.contact->follow) add_joint(joint, next++);
  }
  yaw = count();
  const std::vector<int>& axes = robot.base_axes;
  base_is_dependent = axes.size() == 6 || (problem.dependent.empty() && !problem.contact);
  if (!base_is_dependent && place_of(axes, 5) < static_cast<int>(axes.size())) {
    variables.push_back({true, next++, -std::numbers::pi, std::numbers::pi});
  }
  first = count();
  for (const int joint : chain) {
    if (joint == resting) continue;
    const int at = place_of(problem.redundant, joint);
    if (at < given) {
      add_joint(joint, at);
    } else if (const int follows = place_of(problem.dependent, joint);
               follows < static_cast<int>(problem.dependent.size())) {
      add_joint(joint, own + follows);
    }
  }
  free = count();
  int at = given;
  for (const int axis : problem.free.axes) variables.push_back({axis >= 3, at++, 0, 0});
  regrasp = count();
  const bool around = problem.contact && problem.contact->surface == Surface::kCircle;
  while (at < own) variables.push_back({around, at++, 0, 0});
  shares = count();
  for (int k = 0; choice.contact_shares && k < problem.contact_columns(); ++k) {
    variables.push_back({false, next++, 0, 1});
  }
  throw_unless_supported(count() + (resting < 0 ? 0 : 1) == next, problem);
  throw_on_moving_gears(problem, of_joint);
  for (Variable& variable : variables) {
    if (variable.coordinate >= own) continue;
    variable.lower = problem.theta_r_min[variable.coordinate];
    variable.upper = problem.theta_r_max[variable.coordinate];
  }
}

bool is_free(const Robot& robot, int axis) {
  return std::find(robot.base_axes.begin(), robot.base_axes.end(), axis) != robot.base_axes.end();
}

double rest_of(const Problem& problem, std::size_t joint) {
  if (problem.contact) return problem.contact->q_rest[static_cast<Eigen::Index>(joint)];
  const Joint& at = problem.robot.joints[joint];
  if (at.gear) {
    return at.gear->ratio * rest_of(problem, static_cast<std::size_t>(at.gear->leader)) +
           at.gear->offset;
  }
  return std::clamp(0.0, at.q_min, at.q_max);
}

}  // namespace maxwrench
