#include "benchmarks/proof.h"

#include <stdexcept>

#include "benchmarks/case.h"
#include "maxwrench/problem.h"

namespace maxwrench {

bool has_bound(const Problem& problem, const std::string& measure, Wrench wrench) {
  try {
    make_capability_bound(problem, measure, wrench);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

CertifyResult prove(const Problem& problem, const Method& method, const Candidate& incumbent,
                    const CertifyOptions& options) {
  const auto bound = make_capability_bound(problem, method.choice.measure, method.choice.wrench);
  const auto objective =
      make_capability_objective(problem, method.choice.wrench, method.make_measure);
  return certify(*objective, *bound, incumbent, options);
}

}  // namespace maxwrench
