#pragma once

#include <string>

#include "verify/certificate.h"

namespace maxwrench {

class Equations;
class FormModel;

/// Checks the value of the certificate's posture. Empty, or the reason why the posture does not
/// have this value: a coordinate is beyond its limits, the equations do not hold up to 1e-10, the
/// base is off its free axes, the gain of a second contact is below its sigma_min, the posture
/// collides, or efforts within their limits do not reach the value, up to 1e-8 (1 + |value|) in
/// each row and limit. No program is solved: the efforts are in the certificate or follow from it.
std::string reject_incumbent(const Problem& problem, const FormModel& model,
                             const Equations& equations, const ProofCertificate& proof);

}  // namespace maxwrench
