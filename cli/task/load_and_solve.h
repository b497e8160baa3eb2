#pragma once

#include <string>
#include <vector>

#include "cli/output.h"
#include "cli/task/motion_options.h"
#include "cli/task/problem_options.h"
#include "maxwrench/solve.h"
#include "maxwrench/trajectory_proof.h"

namespace maxwrench {

/// Loads the task of a command that writes files, and changes its motion.
///
/// @param problem  the task, as `ProblemOptions::load` takes it
/// @param source   how it is loaded
/// @param motion   what changes in it
/// @param inputs   files that the command reads beside those of the task
/// @param outputs  files that it writes
/// @throws std::invalid_argument as `require_apart`, if an output would replace any input
Problem load_apart(const std::string& problem, const ProblemOptions& source,
                   const MotionOptions& motion, const std::vector<NamedFile>& inputs,
                   const std::vector<NamedFile>& outputs);

/// `solve`, with progress on stderr under the name of the command, until Ctrl-C.
Answer solve_with_progress(const char* command, const Problem& problem, Options how);

/// `solve_proven` likewise.
TrajectoryProof solve_proven_with_progress(const char* command, const Problem& problem,
                                           Options how);

}  // namespace maxwrench
