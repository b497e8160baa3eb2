#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solvers/pontryagin/extremal.h"

namespace maxwrench {

/// How a climb ended.
struct Climb {
  /// "jumps": the efforts jump between their limits, and the mass rises no more. "stalled": the
  /// curve could not be followed farther. "no_extremal": none was found to begin with.
  /// "effortless": a larger payload needs less effort. "budget": nothing was left to spend.
  const char* end = "no_extremal";
  Extremal extremal;         ///< the last one; without nodes if there is none
  double speed_excess = -1;  ///< the largest excess of a joint's speed, as a share of its limit
};

/// Follows a curve of extremals to the largest payload.
///
/// * The motion of least effort near a start (`minimise_effort`) gives states and costates. From
///   there Newton's method finds the extremal of least effort at the mass of the start, without
///   limits of efforts.
/// * The limits are lowered to the task's.
/// * The costates are scaled such that nu(T) = 1. This does not change the motion, but the index:
///   the mass is now free.
/// * epsilon falls, each time by a factor that depends on Newton's method, from the extremal that
///   the last two predict. The mass rises, and the efforts approach jumps.
///
/// @param shooting  of the transfer
/// @param problem   the transfer
/// @param knots     the table of the start
/// @param m         its mass [kg]
/// @param seen      called with each extremal of the task's own limits
Climb climb(Shooting& shooting, const Problem& problem, const Eigen::MatrixXd& knots, double m,
            const std::function<void(const Extremal&)>& seen);

/// The knots of two plans that sample an extremal: the one that passes through it at the instants
/// of the knots, and the one whose efforts at all instants are nearest to its own
/// (`follow_efforts`). In the limit of many knots both are the extremal.
std::vector<Eigen::MatrixXd> plans_of(Shooting& shooting, const Problem& problem,
                                      const Extremal& extremal);

/// The efforts of an extremal at their limits, over time: "q1 max, min 0.9444, max 2.6281; q2 ...",
/// with the instants [s] at which the effort changes its sign.
std::string describe_switching(Shooting& shooting, const Problem& problem, const Extremal& extremal,
                               int& switches);

}  // namespace maxwrench
