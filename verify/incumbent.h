#pragma once

#include <string>

#include "verify/certificate.h"
#include "verify/model.h"

namespace maxwrench {

/// Empty, or why the certificate's posture does not have its value: theta_r is beyond its limits,
/// it collides, or the value is not reached with efforts within their limits, up to 1e-8 (1 +
/// |value|) in each row and limit. No program is solved: the certificate holds the efforts, or they
/// follow.
std::string refuse_incumbent(const Problem& problem, const FormModel& model,
                             const ProofCertificate& proof);

}  // namespace maxwrench
