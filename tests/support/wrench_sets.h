#pragma once

#include <gtest/gtest.h>

#include "maxwrench/wrench_set.h"

namespace maxwrench {

/// Expects what holds for each wrench set with a status kOptimal: sizes, the polytope's faces,
/// Euler's formula, outward orientation, and the volume by a sum over its facets.
void expect_polytope(const WrenchSet& set);

/// The part of the line {x c} in the set, or an empty interval with min > max.
struct Stretch {
  double min = 0, max = 0;
};
Stretch along(const WrenchSet& set, const Eigen::VectorXd& c);

/// The largest d'f over the vertices.
double support_of(const WrenchSet& set, const Eigen::VectorXd& d);

}  // namespace maxwrench
