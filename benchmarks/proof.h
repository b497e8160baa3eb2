#pragma once

#include <string>

#include "solvers/certify/certify.h"

namespace maxwrench {

struct Method;
struct Problem;

/// Whether `make_capability_bound` serves.
bool has_bound(const Problem& problem, const std::string& measure, Wrench wrench);

/// Branch and bound over theta_r with the measure and wrench of a method, from what a search found:
/// no posture has more than the bound of the result. Its best is evaluated, but not verified.
/// Throws std::invalid_argument if there is no bound that serves.
CertifyResult prove(const Problem& problem, const Method& method, const Candidate& incumbent,
                    const CertifyOptions& options);

}  // namespace maxwrench
