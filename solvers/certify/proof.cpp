#include "solvers/certify/proof.h"

#include <stdexcept>

#include "maxwrench/problem.h"
#include "solvers/solve/method.h"

namespace maxwrench {

std::unique_ptr<Bound> find_bound(const Problem& problem, const std::string& measure,
                                  Wrench wrench) {
  try {
    return make_capability_bound(problem, measure, wrench);
  } catch (const std::invalid_argument&) {
    return nullptr;
  }
}

Eigen::Index boxed_coordinates(const Problem& problem, const Bound& bound) {
  Eigen::VectorXd lower = problem.theta_r_min, upper = problem.theta_r_max;
  bound.extend(lower, upper);
  return lower.size();
}

CertifyResult prove(const Problem& problem, const Method& method, const Bound& bound,
                    const Candidate& incumbent, const CertifyOptions& options) {
  const auto objective =
      make_capability_objective(problem, method.choice.wrench, method.make_measure);
  return certify(*objective, bound, incumbent, options);
}

}  // namespace maxwrench
