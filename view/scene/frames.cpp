#include "lib/robot/kinematics.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/format.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

ordered_json links_json(const Robot& robot, const Instant& instant) {
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(instant.q);
  ordered_json list = ordered_json::array();
  for (const Pose<double>& link : kinematics.links()) {
    for (const ordered_json& number : matrix_json(instant.base * link)) list.push_back(number);
  }
  return list;
}

/// The posture of an instant with the forces of the motion, whose wrench set is that of the
/// instant if no rate limit counts.
Posture posture_at(const Problem& problem, const Instant& instant) {
  Posture posture;
  posture.conclude(Status::kValid);
  posture.J = instant.J;
  posture.tau_d = instant.tau_d;
  if (problem.motion->c_turns) {
    posture.turn = instant.end_effector.R * problem.pose.R.transpose();
  }
  return posture;
}

ordered_json frame_of(const Answer& answer, const Instant& instant) {
  const Problem& problem = *answer.task;
  const bool solved = answer.has_value();
  ordered_json frame;
  frame["theta_r"] = array(theta_r_at(problem, instant));
  frame["theta"] = array(instant.q);
  frame["links"] = links_json(problem.robot, instant);
  frame["end_effector"] = matrix_json(instant.end_effector);
  frame["c"] = array(instant.c);
  frame["status"] = to_string(answer.status);
  frame["reason"] = known(!answer.reason.empty(), answer.reason.str());
  frame["h"] = solved ? array(instant.h) : ordered_json::array();
  frame["u"] = solved ? array(instant.u) : ordered_json::array();
  return frame;
}

ordered_json static_frame(const Answer& answer) {
  const Problem& problem = *answer.task;
  ordered_json frame = frame_of(answer, answer.trajectory.instants.front());
  // With free coordinates of the pose, and regrasp coordinates, more than joints.
  frame["theta_r"] = array(answer.posture.theta_r);
  frame["beta"] = known(answer.has_value(), answer.beta());
  frame["unit"] = answer.unit;
  if (answer.has_value() && answer.capability.w.size() == 0) frame["h"] = ordered_json::array();
  if (problem.contact) {
    frame["contact"] = matrix_json(answer.posture.contact);
    frame["h_2"] = answer.has_value() ? array(answer.capability.h_2) : ordered_json::array();
  }
  if (answer.posture.status == Status::kValid) {
    frame["sets"] = wrench_sets_json(problem, answer.posture, answer.choice);
  }
  return frame;
}

}  // namespace

ordered_json frames_json(const Answer& answer) {
  if (!answer.task->motion) return ordered_json::array({static_frame(answer)});
  ordered_json frames = ordered_json::array();
  for (const Instant& instant : answer.trajectory.instants) {
    if (!instant.q.allFinite()) continue;  // the dependent joints do not reach it
    ordered_json frame = frame_of(answer, instant);
    frame["beta"] = known(answer.has_value(), instant.beta());
    frame["unit"] = answer.unit;
    frame["t"] = instant.t;
    frame["v"] = array(instant.v);
    frame["sets"] =
        wrench_sets_json(*answer.task, posture_at(*answer.task, instant), answer.choice);
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace maxwrench
