#pragma once

#include <string>

#include "verify/certificate.h"

namespace maxwrench {

class FormModel;

/// Checks the value of a list of scenarios at the posture of a certificate: it must be a factor of
/// every scenario, up to `tolerance`, and the efforts must balance the scenario that decides.
/// Returns the reason why not, or an empty text.
///
/// A load is in {B u} if it satisfies the inequality of each normal of a facet. Each facet lies
/// across rank - 1 independent columns of B, so the normals of all such sets of columns suffice;
/// they are computed from B anew. A load across the range of B must be zero. Loads are independent,
/// so each inequality takes the worst case of each load, and of a ball r |E'J n|.
std::string reject_list_value(const Problem& problem, const FormModel& model,
                              const ProofCertificate& proof, double tolerance);

}  // namespace maxwrench
