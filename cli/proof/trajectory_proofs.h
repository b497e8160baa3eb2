#pragma once

#include <string>

#include "maxwrench/trajectory_proof.h"

namespace maxwrench {

/// Proves a trajectory, writes the certificate, and prints the proof as text or as one JSON object;
/// returns the exit status.
///
/// @param certificate  the file for the certificate; empty: none
int certify_trajectory(const Problem& problem, const Eigen::MatrixXd& knots, const Options& options,
                       const std::string& certificate, bool json);

/// Prints the answer of a search and what of it is proven at every instant; returns the exit
/// status.
int report_proven(const TrajectoryProof& proof, bool json);

/// Checks a certificate of a trajectory and prints the result; returns the exit status.
///
/// @param problem  the task to check it against; empty: the one that it names
int verify_trajectory_file(const std::string& file, const std::string& problem, int threads,
                           bool json);

}  // namespace maxwrench
