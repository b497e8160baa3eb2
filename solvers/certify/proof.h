#pragma once

#include <memory>
#include <string>

#include "solvers/certify/certify.h"

namespace maxwrench {

struct Method;
struct Problem;

/// `make_capability_bound`, or null where it does not serve.
std::unique_ptr<Bound> find_bound(const Problem& problem, const std::string& measure,
                                  Wrench wrench);

/// Of how many coordinates the boxes of a bound are: theta_r and what follows.
Eigen::Index boxed_coordinates(const Problem& problem, const Bound& bound);

/// Branch and bound over theta_r with the measure and wrench of a method, from what a search found:
/// no posture has more than the bound of the result. Its best is evaluated, but not verified.
CertifyResult prove(const Problem& problem, const Method& method, const Bound& bound,
                    const Candidate& incumbent, const CertifyOptions& options);

}  // namespace maxwrench
