#include "maxwrench/task.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "lib/math/decompositions.h"
#include "lib/math/rotated.h"
#include "lib/posture/movable.h"
#include "lib/robot/chain.h"
#include "problems/make/bad_value.h"
#include "problems/make/contact.h"
#include "problems/make/free_pose.h"
#include "problems/make/motion_task.h"
#include "problems/make/posture.h"
#include "problems/make/scenarios.h"
#include "problems/make/theta_r.h"

namespace maxwrench {
namespace {

void require_final(const Robot& robot) {
  const Eigen::MatrixXd& B = robot.actuation.B;
  if (!robot.links.empty() && B.rows() == robot.velocities() && B.cols() == robot.actuators() &&
      robot.u_rate_max.size() == robot.actuators()) {
    return;
  }
  throw BadValue("robot", fmt::format("'{}', which is not complete", robot.name),
                 "a robot that finalize returned");
}

void set_wrench(const TaskSpec& task, Problem& problem) {
  if (task.wrench_in_end_effector && problem.motion && problem.motion->impulse) {
    throw BadValue("wrench.frame", "'end_effector'", "'world': the pose of an impulse is constant");
  }
  problem.wrench_in_end_effector = task.wrench_in_end_effector;
  if (task.wrench_in_end_effector) problem.wrench_axes = problem.pose.R;
  set_wrenches(task, problem);
  require_finite("wrench.reference", task.reference);
  require_positive("wrench.reference", task.reference);
  problem.reference = task.reference;
  if (!task.desired) return;
  require_numbers("wrench.desired", *task.desired, 6);
  if (!(task.desired->array() > 0).all()) {
    throw BadValue("wrench.desired", shown(*task.desired), "numbers > 0");
  }
  problem.desired = *task.desired;
}

void set_any(const std::vector<std::string>& any, const std::vector<StatedDirection>& directions,
             Problem& problem) {
  problem.W_any.setZero(6, static_cast<Eigen::Index>(any.size()));
  for (std::size_t column = 0; column < any.size(); ++column) {
    const auto axis = std::find(kWrenchAxes.begin(), kWrenchAxes.end(), any[column]);
    const auto here = any.begin() + static_cast<std::ptrdiff_t>(column);
    if (axis == kWrenchAxes.end() || std::find(any.begin(), here, any[column]) != here) {
      throw BadValue("wrench.any", shown(any),
                     fmt::format("some of {}, each once", fmt::join(kWrenchAxes, ", ")));
    }
    problem.W_any(axis - kWrenchAxes.begin(), static_cast<Eigen::Index>(column)) = 1;
  }
  problem.W_any = rotated(problem.wrench_axes, problem.W_any);
  for (const auto& [key, got, c] : directions) {
    const Vector6d outside = c - problem.W_any * (problem.W_any.transpose() * c);
    if (outside.norm() <= 1e-12) continue;
    throw BadValue(key, got, fmt::format("a direction within any = {}", fmt::join(any, ", ")));
  }
}

/// Sets W_any, the wrenches that do work. Let T be the twists with which the end effector can leave
/// its pose. W_any is all of T or, if c has a part that the structure takes, c and those of T
/// across c. The columns that a task gives itself must not span a wrench h with T'h = 0, because
/// nothing bounds it. What a list of scenarios leaves free is across all of its wrenches.
void choose_wrenches(const TaskSpec& task, Problem& problem) {
  if (problem.motion && problem.motion->has_factor()) {
    problem.W_any = problem.c;  // not used: these wrenches are pure
    return;
  }
  const Matrix6Xd T = motions_at_pose(problem);
  const std::vector<StatedDirection> directions = stated_directions(task, problem);
  for (const auto& [key, got, c] : directions) {
    if ((T.transpose() * c).norm() >= kRankTolerance) continue;
    throw BadValue(key, got, "a direction that does work: the end effector can move along it");
  }
  if (!task.any) {
    problem.W_any = T;
    problem.scenarios.F = free_across(directions, T);
    const Eigen::VectorXd c_T = T.transpose() * problem.c;
    if (c_T.norm() > 1 - kRankTolerance) return;
    problem.W_any << problem.c, T * split(c_T).complement;
    return;
  }
  set_any(*task.any, directions, problem);
  problem.scenarios.F = free_across(directions, problem.W_any);
  const Split works = split(problem.W_any.transpose() * T, kRankTolerance);
  if (works.complement.cols() == 0) return;
  const Vector6d idle = tidy_range(problem.W_any * works.complement).col(0);
  throw BadValue("wrench.any", shown(*task.any),
                 fmt::format("axes of which every wrench does work ([{:.3g}] does none, as the end "
                             "effector cannot move along it)",
                             fmt::join(idle, ", ")));
}

}  // namespace

int find_end_effector(std::string_view key, const std::string& name, const Robot& robot) {
  std::vector<std::string> names;
  for (const EndEffector& tip : robot.end_effectors) {
    if (tip.name == name) return static_cast<int>(names.size());
    names.push_back(tip.name);
  }
  throw BadValue(key, name.empty() ? "nothing" : shown(name),
                 fmt::format("an end effector of the robot: {}", fmt::join(names, ", ")));
}

Problem make_problem(const TaskSpec& task) {
  require_final(task.robot);
  Problem problem;
  problem.name = task.name;
  problem.label = task.label;
  problem.source = task.source;
  problem.robot = task.robot;
  problem.end_effector = find_end_effector("end_effector", task.end_effector, problem.robot);
  require_pose("pose", task.pose);
  const bool transfer = task.motion && task.motion->transfer;
  // Of a transfer, `set_joints` checks the names.
  problem.pose = transfer ? pose_at_mount(problem.robot, problem.end_effector,
                                          joints_by_name("from.", task.from, problem.robot))
                 : task.posture
                     ? pose_at_mount(problem.robot, problem.end_effector, joints_at_posture(task))
                     : task.pose;
  set_motion(task, problem);
  set_wrench(task, problem);
  set_joints(task, problem);
  set_free_pose(task, problem);
  set_start(task, problem);
  require_ik_solution(task, problem);
  require_free_motions(task, problem);
  choose_wrenches(task, problem);
  set_scenarios(task, problem);
  if (task.contact) {
    set_contact(*task.contact, problem);
    reconsider_default(task, problem);
  }
  return problem;
}

}  // namespace maxwrench
