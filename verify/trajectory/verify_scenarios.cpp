#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/trajectory/provable.h"
#include "verify/trajectory/scenario_task.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

/// The number of certificates that a task needs.
std::size_t certificate_count(const Problem& problem) {
  return problem.scenarios.empty() ? 1 : static_cast<std::size_t>(scenario_count(problem));
}

bool are_equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a.array() == b.array()).all();
}

/// Empty, or why the certificates are not those of one trajectory of the list.
std::string reject_list(const Problem& problem, const std::vector<TrajectoryCertificate>& proofs) {
  if (proofs.size() != certificate_count(problem)) return "it is for another robot or task";
  for (std::size_t i = 1; i < proofs.size(); ++i) {
    const TrajectoryCertificate& each = proofs[i];
    if (each.problem != proofs[0].problem || each.version != proofs[0].version) {
      return "its scenarios are of different tasks or versions";
    }
    if (each.collision != proofs[0].collision || each.t_h != proofs[0].t_h ||
        !are_equal(each.knots, proofs[0].knots) ||
        !are_equal(each.dependent, proofs[0].dependent)) {
      return "its scenarios are of different trajectories";
    }
  }
  return "";
}

/// What all certificates together claim, whether it is true or not; NaN if their number is wrong.
void read_claim(const Problem& problem, const std::vector<TrajectoryCertificate>& proofs,
                TaskVerification& result) {
  result.guaranteed = std::numeric_limits<double>::quiet_NaN();
  if (proofs.size() != certificate_count(problem)) return;
  if (problem.scenarios.empty()) {
    result.guaranteed = proofs[0].value;
    return;
  }
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    const ScenarioTask one = scenario_task(problem, static_cast<int>(i));
    const double factor = least_factor(proofs[i].value, one.length);
    if (i > 0 && !(factor < result.guaranteed) && !std::isnan(factor)) continue;
    result.guaranteed = factor;
    result.decides = one.name;
    if (std::isnan(factor)) return;
  }
}

}  // namespace

TaskVerification verify(const Problem& problem, const std::vector<TrajectoryCertificate>& proofs,
                        int threads) {
  require_provable_task(problem);
  TaskVerification result;
  read_claim(problem, proofs, result);
  result.rejection = reject_list(problem, proofs);
  if (problem.scenarios.empty() && result.rejection.empty()) {
    static_cast<TrajectoryVerification&>(result) = verify(problem, proofs[0], threads);
    return result;
  }
  for (std::size_t i = 0; i < proofs.size() && result.rejection.empty(); ++i) {
    const ScenarioTask one = scenario_task(problem, static_cast<int>(i));
    const TrajectoryVerification each = verify(one.task, proofs[i], threads);
    result.slices += each.slices;
    result.places += each.places;
    result.clearance = std::min(result.clearance, each.clearance);
    if (!each.verified()) {
      result.rejection = one.name + ": " + each.rejection;
      result.t = each.t;
    }
  }
  return result;
}

}  // namespace maxwrench
