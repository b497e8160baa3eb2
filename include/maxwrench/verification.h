#pragma once

#include <string>

#include "maxwrench/types.h"

/// @file
/// The result of a check of a certificate.

namespace maxwrench {

/// The result of a check of a certificate.
struct Verification {
  std::string rejection;       ///< why the certificate is rejected; empty if it is verified
  long boxes = 0;              ///< number of boxes of the tree that were checked
  long by_multiplier = 0;      ///< leaves whose multiplier proves the bound
  long by_collision = 0;       ///< leaves in which every posture collides
  long by_equations = 0;       ///< leaves that hold no posture
  long by_parent = 0;          ///< leaves that an outer box proves
  double ceiling = kInfinity;  ///< upper bound of all values without any box

  /// Returns whether the certificate is verified.
  bool verified() const { return rejection.empty(); }
};

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
