#pragma once

#include <string>

#include "maxwrench/types.h"

/// @file
/// The result of a check of a certificate of a trajectory.

namespace maxwrench {

/// The result of a check of a certificate of a trajectory, for all instants of time.
struct TrajectoryVerification {
  std::string rejection;  ///< why it is rejected; empty if it is verified
  double t = -1;          ///< the instant to which the rejection refers [s]; -1: none
  long slices = 0;        ///< number of slices of time on which the efforts were enclosed
  long places = 0;        ///< number of instants at which distances of bodies were computed
  /// No two bodies are closer than their margin plus this [m]; infinite: nothing was checked.
  double clearance = kInfinity;

  /// Returns whether the certificate is verified.
  bool verified() const { return rejection.empty(); }
};

}  // namespace maxwrench
