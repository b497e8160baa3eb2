#pragma once

#include <vector>

#include "lib/math/complex.h"
#include "lib/posture/ik/tool_chain.h"

namespace maxwrench {

/// A theta_r and the solutions y there: the real ones, and one of each pair of complex conjugates.
struct IkSolutionSet {
  Eigen::VectorXd theta_r;
  std::vector<Six<double>> real;
  std::vector<Six<Complex>> pairs;
  bool complete = false;  ///< whether these are all real solutions
  bool full = false;      ///< whether these are all solutions
};

}  // namespace maxwrench
