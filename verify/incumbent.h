#pragma once

#include <string>
#include <vector>

#include "verify/certificate.h"
#include "verify/coordinates.h"
#include "verify/interval.h"

namespace maxwrench {

class Equations;
class FormModel;

/// The coordinates of the certificate's posture. The forces of a second contact are among them
/// unless they follow from the base and the certificate goes without them.
CoordinateChoice posture_coordinates(const Problem& problem, const ProofCertificate& proof);

/// Checks the value of the certificate's posture. Empty, or the reason why the posture does not
/// have this value: a coordinate is beyond its limits, the equations do not hold up to 1e-10, the
/// base is off its free axes, the gain of a second contact is below its sigma_min, the posture
/// collides, or efforts within their limits do not reach the value, up to 1e-8 (1 + |value|) in
/// each row and limit. No program is solved: the efforts are in the certificate or follow from it.
std::string reject_incumbent(const Problem& problem, const FormModel& model,
                             const Equations& equations, const ProofCertificate& proof);

/// Whether efforts within limits balance tau, B u = tau, up to `tolerance`. Empty, or why not.
std::string reject_balance(const Eigen::MatrixXd& B, const Zonotope& limits,
                           const Eigen::VectorXd& u, const std::vector<Narrow>& tau,
                           double tolerance);

}  // namespace maxwrench
