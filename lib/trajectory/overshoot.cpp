#include "lib/trajectory/overshoot.h"

#include <algorithm>
#include <limits>

#include "lib/trajectory/carried.h"
#include "lib/trajectory/motion_evaluator.h"

namespace maxwrench {

double overshoot_of(const Problem& problem, const Eigen::MatrixXd& Q, double mass) {
  const Zonotope& set = problem.robot.actuation;
  if (!set.has_facets) return std::numeric_limits<double>::quiet_NaN();
  MotionEvaluator motion(problem, make_dense_spline(*problem.motion, kOvershootInstants));
  std::vector<Instant> instants;
  motion.evaluate(Q, instants);
  double share = 0;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Instant& instant = instants[i];
    const Vector6d c =
        factored_wrench(problem.robot, *problem.motion, instant.t, motion.maps().x[i]);
    const Eigen::VectorXd tau = instant.tau_d + mass * (instant.J.transpose() * c);
    const Eigen::VectorXd loads = set.N.transpose() * tau;
    for (Eigen::Index j = 0; j < loads.size(); ++j) {
      const double limit = loads[j] > 0 ? set.b_max[j] : set.b_min[j];
      if (loads[j] != 0) share = std::max(share, loads[j] / limit);
    }
  }
  return share - 1;
}

}  // namespace maxwrench
