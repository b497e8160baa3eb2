#pragma once

#include <cmath>

#include "solvers/certify/bound/exact_posture.h"
#include "tests/support/support.h"

namespace maxwrench {

struct RandomBox {
  Eigen::VectorXd lower, upper, inside;
};

/// A box of any size with a point in it, which is sometimes a corner.
inline RandomBox random_box(const Problem& problem, Random& random) {
  RandomBox box;
  box.lower = box.upper = box.inside = random_theta_r(problem, random);
  const double size = std::pow(10, -random.uniform(0, 4));
  for (Eigen::Index i = 0; i < box.inside.size(); ++i) {
    box.lower[i] = std::max(problem.theta_r_min[i], box.inside[i] - size * random.uniform(0, 1));
    box.upper[i] = std::min(problem.theta_r_max[i], box.inside[i] + size * random.uniform(0, 1));
    const double where = random.uniform(0, 1);
    if (where < 0.2) box.inside[i] = box.lower[i];
    if (where > 0.8) box.inside[i] = box.upper[i];
  }
  return box;
}

/// The rows [tau_d; J'c], 2n, of a problem whose base pose follows in closed form.
inline MultiAffine pure_rows(const Problem& problem) {
  ExactPosture posture(problem);
  return {all_coordinates(problem), problem.theta_r_default, [&](const ExtendedVector& theta_r) {
            posture.set(theta_r);
            ExtendedVector rows(2 * problem.robot.velocities());
            rows << posture.tau_d(), posture.J().transpose() * posture.turned(problem.c);
            return rows;
          }};
}

}  // namespace maxwrench
