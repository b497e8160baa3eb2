#pragma once

#include <cmath>

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

}  // namespace maxwrench
