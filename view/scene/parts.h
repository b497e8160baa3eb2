#pragma once

#include <nlohmann/json.hpp>

#include "maxwrench/solve.h"
#include "problems/loader/visuals.h"

// Parts of a scene.

namespace maxwrench {

/// A pose as a 3x4 matrix by rows.
nlohmann::ordered_json matrix_json(const Pose<double>& pose);

/// The number with six digits, for what is only drawn.
double drawn(double value);
/// The columns one after the other, as `drawn`.
nlohmann::ordered_json drawn_columns(const Eigen::MatrixXd& columns);

/// Adds the bytes of a whole number without a sign, the lowest first.
template <class Number>
void append_bytes(Number number, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes += static_cast<char>(number >> (8 * i) & 0xFF);
  }
}

/// The bodies of each link in its axes: its visuals, else its convex bodies. A link without either
/// is the bars from its origin to its joints and end effectors; a bare base with thrusters is
/// what encloses these and the joints.
nlohmann::ordered_json bodies_json(const Robot& robot, const std::vector<Visual>& visuals);

/// The parts of a mesh in its own axes, thinned out: lower corner and extent of the box around it,
/// points as 16-bit shares of that box, and indices of points, both in base64; its own colour if
/// it has one. Empty if the mesh cannot be read.
std::vector<nlohmann::ordered_json> mesh_json(const Visual& visual);

/// Links, joints, thrusters, actuators and end effectors.
nlohmann::ordered_json robot_json(const Robot& robot, const std::vector<Visual>& visuals);

/// What the robot is and does at each instant of an answer; a static task has one. The members are
/// those that the engine of pages returns, for instants also `t`, `v` and their number `instant`,
/// and at no more than `most_sets` instants the sets of wrenches.
nlohmann::ordered_json frames_json(const Answer& answer, std::size_t most_sets);

/// The sets of wrenches at an instant of an answer, as `wrench_sets_json`; null if its posture is
/// invalid. In time they are those with the forces of the motion.
nlohmann::ordered_json sets_json(const Answer& answer, std::size_t instant);

/// What binds at an answer, as `eval --explain --json` has it; null for a list of scenarios.
nlohmann::ordered_json explanation_json(const Answer& answer);

/// Of a list of scenarios: which one decides, its limits of the efforts, the number of scenarios,
/// and the intervals of all of them unless there are many. Null without a list or a posture.
nlohmann::ordered_json scenarios_json(const Answer& answer);

/// The same of a task in time: which scenario decides and when, and what each allows at each
/// instant. Null if there is no list or no valid trajectory.
nlohmann::ordered_json scenarios_in_time_json(const Answer& answer);

/// The experiment in the virtual tank along a trajectory, as `simulate` runs it by default: whether
/// it was held, the reading that counts, and curves of what is planned and read along c. Null if
/// the trajectory has no value.
nlohmann::ordered_json tank_json(const Answer& answer);

/// The set of forces, or of torques if c is a torque, as a polytope and an ellipsoid. Null if c is
/// neither, or there is no such set.
nlohmann::ordered_json wrench_sets_json(const Problem& task, const Posture& posture,
                                        const Case& choice);

}  // namespace maxwrench
