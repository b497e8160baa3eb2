#pragma once

#include <string>

#include "maxwrench/solve.h"

namespace maxwrench {

struct Method;

/// What a short sample finds of a robot that is far too weak for its own load.
struct TooWeak {
  std::string why;       ///< empty: it is not, or the sample does not tell
  long evaluations = 0;  ///< number of values of theta_r
  IkCounts ik_solutions;
};

/// Samples the default posture and random ones, until one has a value. If none has, the robot is
/// far too weak when a hundred IK solutions or more exist, and in none of them the efforts bear
/// more than a third of tau_d, whatever the wrench helps: the largest s is below 1/3 with
///
///     B u - J'W w = s tau_d,   u_min <= u <= u_max.
///
/// A sample proves nothing: s is continuous in theta_r on each branch of the IK solutions, and
/// would have to triple between the postures of the sample. Tasks in time, with a second contact,
/// with a list of scenarios or without redundancy are never called too weak.
TooWeak find_too_weak(const Problem& task, const Method& method);

}  // namespace maxwrench
