#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "maxwrench/posture.h"
#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/status.h"

// Functions that format parts of an answer.

namespace maxwrench {

nlohmann::ordered_json array(const Eigen::VectorXd& v);

/// An array of the matrix's rows.
nlohmann::ordered_json rows(const Eigen::MatrixXd& matrix);

/// The value, or null.
nlohmann::ordered_json known(bool condition, const nlohmann::ordered_json& value);

/// position, rpy
nlohmann::ordered_json to_json(const Pose<double>& pose);

/// position and rpy of the base in the world, then each joint by its name.
nlohmann::ordered_json theta(const Robot& robot, const Pose<double>& base,
                             const Eigen::VectorXd& q);

nlohmann::ordered_json to_json(const Residual& residual);

/// An array of objects.
nlohmann::ordered_json to_json(const std::vector<CallCount>& counts);

/// The object on one line. JSON requires UTF-8: text in another encoding is read as Latin-1, so
/// that different names stay different.
std::string in_one_line(const nlohmann::ordered_json& object);

/// Roll, pitch, yaw with R = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Vector3d rpy(const Eigen::Matrix3d& R);

/// The number with five decimals; one that rounds to zero has no sign.
std::string decimals(double value);

/// Numbers in columns.
std::string line(const Eigen::VectorXd& v);
std::string line(const Residual& residual);

/// "0.1 %"
std::string percent(double share);

/// "20 evaluations in 0.5 s"
std::string line(long evaluations, double seconds);

/// Random theta_r within the limits, always the same ones: how many have a valid posture, and the
/// outcome of all postures there.
struct Sampled {
  int valid = 0;
  IkCounts postures;
};
Sampled sample_postures(const Problem& problem, int samples);

/// "postures: 3 valid, ..."
std::string describe(const IkCounts& ik_solutions);

/// The number of instants from knot to knot.
int instants_per_interval(const MotionTask& task);

/// "N" or "N m": the unit of its effort.
const char* actuator_unit(const Robot& robot, Eigen::Index i);

/// Whether the pose of the end effector is a result rather than the task's: part of it is free, or
/// all joints are given.
bool finds_pose(const Answer& answer);

}  // namespace maxwrench
