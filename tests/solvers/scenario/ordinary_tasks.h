#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "tests/support/changed_limits.h"
#include "tests/support/support.h"

namespace maxwrench {

inline constexpr const char* kTwoArms = "two_arms.toml";
inline constexpr const char* kBarAndWall = "bar_wall.toml";
inline constexpr const char* kBarAlone = "bar_alone.toml";  // the second arm exerts nothing

inline constexpr const char* kUncertain =
    "[uncertainty]\nmass.right_link_4 = 0.1\nmass.vehicle = 0.2\ntrim = 0.3\nthrust = 0.1\n"
    "torque = 0.05\n";

/// A scenario as an ordinary task of the same contact: c has length 1, and a factor of the list is
/// beta divided by `length`.
struct OrdinaryTask {
  Problem task;
  double length = 1;
};

inline Problem along_c(Problem task, const Vector6d& c) {
  task.c = c.normalized();
  return task;
}

inline Problem dead(const Problem& task, const std::string& actuator) {
  const Eigen::Index i = actuator_named(task.robot, actuator);
  return with_limit(with_limit(task, i, LimitSide::kLower, 0), i, LimitSide::kUpper, 0);
}

/// All of the vehicle.
inline const std::vector<std::string> kVehicleThrusters = {
    "front_right_horizontal", "front_left_horizontal", "rear_right_horizontal",
    "rear_left_horizontal",   "front_right_vertical",  "front_left_vertical",
    "rear_right_vertical",    "rear_left_vertical"};

/// The task as it is, and without each of the thrusters.
inline std::vector<OrdinaryTask> any_dead(const Problem& plain) {
  std::vector<OrdinaryTask> all = {{plain}};
  for (const std::string& name : kVehicleThrusters) all.push_back({dead(plain, name)});
  return all;
}

/// The value of an ordinary task at the IK solution of another task's posture; -infinity: there is
/// none.
inline double value_at(const Problem& task, const Posture& posture, Wrench wrench) {
  Case c;
  c.wrench = wrench;
  const LowerLevel lower = resolve_lower_level(task, c);
  const auto measure = lower.make_measure();
  PostureEvaluator model(task, false);
  model.evaluate(posture.theta_r);
  for (int i = 0; i < model.ik_solutions(); ++i) {
    const Posture& here = model.select(i);
    if ((here.q - posture.q).norm() > 1e-9) continue;
    WrenchProgram program = make_wrench_program(task, wrench);
    set_posture(here, program);
    Capability capability;
    measure->evaluate(here, program, false, capability);
    EXPECT_TRUE(capability.status == Status::kOptimal || capability.status == Status::kInfeasible);
    return capability.status == Status::kOptimal ? capability.beta : -kInfinity;
  }
  ADD_FAILURE() << "no such IK solution";
  return -kInfinity;
}

}  // namespace maxwrench
