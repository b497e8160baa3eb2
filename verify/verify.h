#pragma once

#include "maxwrench/verification.h"
#include "verify/certificate.h"

namespace maxwrench {

/// Checks that a certificate proves its claims about the problem: no posture within the limits has
/// a value above `bound`, the certificate's posture has its value, and the gap between the two is
/// as claimed. Every bound is evaluated anew in interval arithmetic, from the problem's data and
/// the certificate's multipliers, without any code that found them. The result is the same at any
/// number of threads. Throws std::invalid_argument, in one line, if the problem or the measure is
/// not supported.
Verification verify(const Problem& problem, const ProofCertificate& proof, int threads);

}  // namespace maxwrench
