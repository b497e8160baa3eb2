#include "benchmarks/proof.h"

#include <stdexcept>

#include "benchmarks/case.h"
#include "maxwrench/problem.h"

namespace maxwrench {

Eigen::Index boxed_coordinates(const Problem& problem, const std::string& measure, Wrench wrench) {
  try {
    Eigen::VectorXd lower = problem.theta_r_min, upper = problem.theta_r_max;
    make_capability_bound(problem, measure, wrench)->extend(lower, upper);
    return lower.size();
  } catch (const std::invalid_argument&) {
    return 0;
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
