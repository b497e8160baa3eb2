#pragma once

#include <string>

#include "verify/certificate.h"

namespace maxwrench {

/// The result of a check of a certificate.
struct Verification {
  std::string rejection;  ///< empty if the certificate is verified
  long boxes = 0;         ///< of the tree that were checked
  long by_multiplier = 0, by_collision = 0, by_equations = 0, by_parent = 0;  ///< leaves by reason
  double ceiling = kInfinity;  ///< of all postures, without any box
};

/// Checks that a certificate proves its claims about the problem: no posture within the limits has
/// a value above `bound`, the certificate's posture has its value, and the gap between the two is
/// as claimed. Every bound is evaluated anew in interval arithmetic, from the problem's data and
/// the certificate's multipliers, without any code that found them. The result is the same at any
/// number of threads. Throws std::invalid_argument, in one line, if the problem or the measure is
/// not supported.
Verification verify(const Problem& problem, const ProofCertificate& proof, int threads);

}  // namespace maxwrench
