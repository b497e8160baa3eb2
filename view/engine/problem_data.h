#pragma once

#include <string>
#include <string_view>

#include "maxwrench/problem.h"

namespace maxwrench {

/// Why the evaluation engine does not support a task, in one line; empty if it does.
///
/// It supports tasks of robots without a collision check, or with the one that `finalize` makes.
std::string why_no_engine(const Problem& problem);

/// All that an evaluation of a task depends on, as bytes for `read_problem`.
///
/// The collision check is written as its shapes, and `Problem::start_system` is left out, as are
/// texts that no result depends on: sources, notes, warnings, files, named postures and bodies for
/// figures. The bytes begin with a version and end with a checksum. All numbers are written bit for
/// bit, little endian.
///
/// @throws std::invalid_argument with the line of `why_no_engine` unless it is empty.
std::string problem_data(const Problem& problem);

/// The task that was written. Its `start_system` is made again.
///
/// @throws std::invalid_argument with one line if the data are damaged or of another version.
Problem read_problem(std::string_view data);

}  // namespace maxwrench
