#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "maxwrench/problem.h"

namespace maxwrench {

/// What proves that a trajectory exerts a wrench at every instant. All else follows from the task.
struct TrajectoryCertificate {
  std::string version;       ///< version of maxwrench that wrote it
  std::string problem;       ///< name of the problem on the command line
  bool collision = true;     ///< whether bodies are kept apart
  std::uint64_t digest = 0;  ///< of the robot, the task and its motion
  /// v [N or N m]. Along a path, w c with w >= v is exerted at all times. In an impulse, at the
  /// peak.
  double value = 0;
  int t_h = 0;            ///< the knot of an impulse's peak
  Eigen::MatrixXd knots;  ///< k×r, without theta_0 of an impulse
  /// Positions of the dependent joints, roughly, at places that cut each interval into equal parts
  /// (joints×places). They tell IK solutions apart. Empty without such joints.
  Eigen::MatrixXd dependent;
  /// The number of parts into which the edges cut each interval between knots.
  int parts = 0;
  Eigen::MatrixXd y;  ///< control points of the efforts at the edges, m×(parts intervals + 1)
  /// Control points of the wrench along c at the edges. Empty along a path where w = v throughout.
  Eigen::VectorXd w;
};

/// A hash (FNV-1a) of all numbers on which a proof in time depends.
std::uint64_t motion_digest(const Problem& problem);

/// The contents of a certificate file (`seal`).
std::string certificate_text(const TrajectoryCertificate& certificate);

/// The contents of a certificate file of a list of scenarios: a certificate of each, in the order
/// of `scenario_task`.
std::string certificate_text(const std::vector<TrajectoryCertificate>& scenarios);

/// Whether a file is such a certificate.
bool is_trajectory_certificate(const std::string& file);

/// The certificate of a file, or those of all scenarios. Throws std::invalid_argument, in one line
/// with the name of the file, if the file is damaged or is not such a certificate. Does not check
/// its claims.
std::vector<TrajectoryCertificate> read_trajectory_certificates(const std::string& file);

}  // namespace maxwrench
