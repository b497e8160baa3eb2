#pragma once

#include <string>

#include "verify/certificate.h"

namespace maxwrench {

/// What was checked of a certificate.
struct Verification {
  std::string rejection;  ///< empty: it is verified
  long boxes = 0;         ///< of the tree
  long by_multiplier = 0, by_collision = 0, by_equations = 0, by_parent = 0;  ///< leaves
  double ceiling = kInfinity;  ///< of all postures, before any box
};

/// Checks that a certificate proves what it claims of the problem: no posture within the limits has
/// a value above `bound`, the certificate's posture has its value, and the gap between them is as
/// claimed. Every bound is evaluated anew, in interval arithmetic, from the problem's data and the
/// certificate's multipliers; nothing of what found them takes part. The same answer at any number
/// of threads. Throws std::invalid_argument, in one line, if the problem or the measure is none
/// that it serves.
Verification verify(const Problem& problem, const ProofCertificate& proof, int threads);

}  // namespace maxwrench
