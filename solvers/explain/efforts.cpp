#include <cmath>

#include "lib/measure/closed_form.h"
#include "lib/tank/effort_tracking.h"
#include "solvers/explain/parts.h"
#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

/// The diagonal of W_u, also where an actuator has no limits or acts in one direction only.
Eigen::VectorXd effort_weights(const Zonotope& set) {
  Eigen::VectorXd scale = smaller_limits(set);
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    if (scale[i] == 0) scale[i] = std::max(std::abs(set.u_min[i]), std::abs(set.u_max[i]));
    if (scale[i] == 0 || !std::isfinite(scale[i])) scale[i] = 1;
  }
  return scale.cwiseInverse();
}

/// u'Q u less the least u'Q v over v within the limits with B v = B u. It is zero exactly if u is
/// the optimum of v'Q v, and bounds half of what is missing. Infinite if it is not known.
double optimality_gap(const Zonotope& set, const Eigen::VectorXd& Q, const Eigen::VectorXd& u) {
  LinearProgram lp;
  lp.A = set.B.sparseView();
  lp.A.makeCompressed();
  lp.b = set.B * u;
  lp.c = -Q.cwiseProduct(u);
  lp.l = set.u_min;
  lp.u = set.u_max;
  LpSolution best;
  make_simplex()->solve(lp, best);
  if (best.status != Status::kOptimal || !verified(lp, best)) return kInfinity;
  return lp.c.dot(best.x - u);
}

}  // namespace

void explain_efforts(const Answer& answer, const WrenchProgram& program, LeastEfforts& efforts) {
  const Zonotope& set = *program.actuation;
  if (answer.capability.w.size() == 0) {
    efforts.missing = "measure " + answer.choice.measure + " has no wrench";
    return;
  }
  const Eigen::VectorXd weights = effort_weights(set);
  const Eigen::VectorXd Q = weights.cwiseAbs2();
  const Eigen::VectorXd tau = program.tau_d + program.JtW * (efforts.share * answer.capability.w);
  EffortAnswer found;
  EffortTracker(Q).solve({set.B, tau, Eigen::VectorXd::Zero(Q.size()), set.u_min, set.u_max},
                         found);
  const double scale = std::max(1.0, tau.lpNorm<Eigen::Infinity>());
  if (found.relaxed || !(found.shortfall <= kAnswerTolerance * scale)) {
    efforts.missing = "no efforts within the limits hold this share of the wrench";
    return;
  }
  efforts.u = found.u;
  efforts.norm = weights.cwiseProduct(found.u).norm();
  efforts.balance = found.shortfall;
  efforts.gap = optimality_gap(set, Q, found.u);
  if (!(efforts.gap <= kAnswerTolerance * (1 + efforts.norm * efforts.norm))) {
    efforts.missing = "the least efforts are not confirmed by the data";
    efforts.u.resize(0);
  }
  if (answer.capability.u.size() == Q.size()) {
    efforts.vertex_norm = weights.cwiseProduct(answer.capability.u).norm();
  }
}

}  // namespace maxwrench
