#include "lib/measure/task_dynamics.h"

#include <algorithm>
#include <stdexcept>

#include "lib/math/rotated.h"
#include "lib/measure/closed_form.h"
#include "maxwrench/posture.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

const Problem& with_accelerations(const Problem& problem, const std::string& measure) {
  const std::string why = why_no_acceleration(problem);
  if (!why.empty()) throw std::invalid_argument("measure " + measure + ": " + why);
  return problem;
}

}  // namespace

std::string why_no_acceleration(const Problem& problem) {
  const Robot& robot = problem.robot;
  if (problem.contact) {
    return problem.name + " has a second contact, expected the acceleration of a free end effector";
  }
  if (robot.links.size() != robot.joints.size() + 1) {
    return "got " + std::to_string(robot.links.size()) + " links with masses, expected " +
           std::to_string(robot.joints.size() + 1) + ": the base, and one for each joint";
  }
  const auto geared = std::find_if(robot.joints.begin(), robot.joints.end(),
                                   [](const Joint& joint) { return joint.gear.has_value(); });
  if (geared != robot.joints.end()) {
    return "joint " + geared->name + " of " + robot.name +
           " has a gear, expected motors that move each joint alone";
  }
  if (robot.no_dynamics.empty()) return "";
  const DataFault& fault = robot.no_dynamics.front();
  return fault.key + ": got " + fault.got + ", expected " + fault.expected;
}

TaskDynamics::TaskDynamics(const Problem& problem, const std::string& measure)
    : dynamics_(with_accelerations(problem, measure).robot),
      joints_(static_cast<Eigen::Index>(problem.robot.joints.size())),
      W_0_(problem.W_any),
      llt_(problem.robot.velocities()) {}

const char* TaskDynamics::set(const Posture& posture) {
  if (posture.q.size() != joints_) return "the posture has no joint positions";
  rotate_into(posture.turn, W_0_, W_);
  T_.noalias() = W_.transpose().lazyProduct(posture.J);
  dynamics_.set_configuration(posture.base.R, posture.q);
  dynamics_.mass_matrix(M_);
  if (!factor()) return "M is singular: a motion has no inertia";
  X_ = T_.transpose();
  for (Eigen::Index i = 0; i < X_.cols(); ++i) llt_.solveInPlace(X_.col(i));
  return nullptr;
}

/// A pivot is compared with its own entry of M, because the units and sizes of the entries differ.
bool TaskDynamics::factor() {
  llt_.compute(M_);
  if (llt_.info() != Eigen::Success) return false;
  const auto& L = llt_.matrixLLT();
  for (Eigen::Index i = 0; i < M_.rows(); ++i) {
    if (!(L(i, i) * L(i, i) > kPivotTolerance * M_(i, i))) return false;
  }
  return true;
}

}  // namespace maxwrench
