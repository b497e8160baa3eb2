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
  return frame;
}

}  // namespace

ordered_json sets_json(const Answer& answer, std::size_t instant) {
  const Problem& problem = *answer.task;
  const bool in_time = problem.motion.has_value();
  const Posture& posture =
      in_time ? posture_at(problem, answer.trajectory.instants.at(instant)) : answer.posture;
  if (posture.status != Status::kValid) return nullptr;
  return wrench_sets_json(problem, posture, answer.choice);
}

ordered_json frames_json(const Answer& answer, std::size_t most_sets) {
  ordered_json frames = ordered_json::array();
  if (!answer.task->motion) {
    frames.push_back(static_frame(answer));
    if (most_sets > 0) frames[0]["sets"] = sets_json(answer, 0);
    return frames;
  }
  const std::size_t instants = answer.trajectory.instants.size();
  const std::size_t step = most_sets == 0 ? instants : (instants + most_sets - 1) / most_sets;
  for (std::size_t i = 0; i < instants; ++i) {
    const Instant& instant = answer.trajectory.instants[i];
    if (!instant.q.allFinite()) continue;  // the dependent joints do not reach it
    ordered_json frame = frame_of(answer, instant);
    frame["beta"] = known(answer.has_value(), instant.beta());
    frame["unit"] = answer.unit;
    frame["t"] = instant.t;
    frame["v"] = array(instant.v);
    frame["instant"] = i;
    if (most_sets > 0 && i % step == 0) frame["sets"] = sets_json(answer, i);
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace maxwrench
