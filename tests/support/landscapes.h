#pragma once

#include <vector>

#include "tests/support/known.h"

namespace maxwrench {

/// A function of few coordinates whose maximum is known.
struct Landscape {
  const char* name;
  Known objective;
  Eigen::VectorXd maximum;
  double value;
  double tolerance;  // of the value, with the full budget
};

/// -sum_i i (x_i - 0.1 (i - 1))^2 in any number of coordinates.
double bowl(const Eigen::VectorXd& x);

/// 2 - (x_1 - 0.3)^2 - 2 (x_2 + 0.7)^2.
double smooth(const Eigen::VectorXd& x);

/// Smooth, kinked, with many local maxima, with no value in places, at a corner, in one, two and
/// four dimensions.
std::vector<Landscape> landscapes();

}  // namespace maxwrench
