#pragma once

#include <string>
#include <vector>

#include "lib/problem.h"

namespace maxwrench {

/// One posture of a figure.
struct Panel {
  std::string title;
  Eigen::VectorXd theta_r;
};

/// The paper's fig:polytopes (one panel) and fig:optimalpolytopes (several) as SVG: the robot in
/// its postures with the ellipsoid, the L2 and the L-infinity polytope of the forces in the plane
/// of motion without torque, and c.
std::string figure(const Problem& problem, const std::vector<Panel>& panels);

}  // namespace maxwrench
