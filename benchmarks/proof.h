#pragma once

#include <string>

#include "solvers/certify/certify.h"

namespace maxwrench {

struct Method;
struct Problem;

/// Of how many coordinates the boxes are that `make_capability_bound` bounds: theta_r and what
/// follows; 0: it does not serve.
Eigen::Index boxed_coordinates(const Problem& problem, const std::string& measure, Wrench wrench);

/// Branch and bound over theta_r with the measure and wrench of a method, from what a search found:
/// no posture has more than the bound of the result. Its best is evaluated, but not verified.
/// Throws std::invalid_argument if there is no bound that serves.
CertifyResult prove(const Problem& problem, const Method& method, const Candidate& incumbent,
                    const CertifyOptions& options);

}  // namespace maxwrench
