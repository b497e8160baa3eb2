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
/// its postures with c and four sets of forces around its end effector: the ellipsoid, the L2 and
/// the L-infinity polytope of the forces without any other wrench component, and the L-infinity
/// polytope of those that occur together with any allowed wrench. "beta" in a title becomes the
/// letter. If c is no force along the plane seen from above or from the side, as `posture_figure`.
std::string figure(const Problem& problem, const std::vector<Panel>& panels);

/// The postures alone, from two sides, as SVG. Titles as above.
std::string posture_figure(const Problem& problem, const std::vector<Panel>& panels);

}  // namespace maxwrench
