#pragma once

#include <vector>

#include "lib/math/complex.h"
#include "lib/posture/ik/tool_chain.h"

namespace maxwrench {

/// A place of theta_r and the solutions y there: those that are real, and one of each pair of
/// conjugate ones.
struct IkSolutionSet {
  Eigen::VectorXd theta_r;
  std::vector<Six<double>> real;
  std::vector<Six<Complex>> pairs;
  bool complete = false;  ///< as many as there are
};

}  // namespace maxwrench
