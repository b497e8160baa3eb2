#pragma once

#include <string>

#include "verify/certificate.h"

namespace maxwrench {

class Equations;
class FormModel;

/// Empty, or why the certificate's posture does not have its value: a coordinate is beyond its
/// limits, the equations do not hold up to 1e-10, its base is off its free axes, the gain of a
/// second contact is below its sigma_min, it collides, or the value is not reached with efforts
/// within their limits, up to 1e-8 (1 + |value|) in each row and limit. No program is solved: the
/// certificate holds the efforts, or they follow.
std::string reject_incumbent(const Problem& problem, const FormModel& model,
                             const Equations& equations, const ProofCertificate& proof);

}  // namespace maxwrench
