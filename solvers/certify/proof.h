#pragma once

#include <memory>
#include <string>

#include "maxwrench/certify.h"
#include "solvers/certify/certify.h"

namespace maxwrench {

class ProofRecorder;
struct Method;

/// `make_capability_bound`, or null where it does not support the choice.
std::unique_ptr<Bound> find_bound(const Problem& problem, const std::string& measure,
                                  Wrench wrench);

/// The number of coordinates of a bound's boxes: theta_r and the dependent coordinates.
Eigen::Index boxed_coordinates(const Problem& problem, const Bound& bound);

/// Branch and bound over theta_r with the measure and wrench of a method, from the result of a
/// search. No posture has a value above the bound of the result. Its best posture is evaluated, but
/// not verified.
CertifyResult prove(const Problem& problem, const Method& method, const Bound& bound,
                    const Candidate& incumbent, const CertifyOptions& options);

/// `certify` of a task without a certificate. The recorder, unless it is null, receives the boxes.
Proof certify(const Problem& task, const Options& options, const ProofOptions& how,
              ProofRecorder* recorder);

}  // namespace maxwrench
