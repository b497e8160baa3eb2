#pragma once

#include <string>
#include <vector>

#include "maxwrench/tank.h"
#include "maxwrench/types.h"

namespace maxwrench {

struct Trajectory;
struct Problem;

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
/// Both throw std::invalid_argument for a theta_r without a posture.
std::string figure(const Problem& problem, const std::vector<Panel>& panels);

/// The postures alone, from two sides, as SVG. Titles as above.
std::string posture_figure(const Problem& problem, const std::vector<Panel>& panels);

/// One curve of c'h_e over time with the trajectory dashed.
struct TankCurve {
  std::string name;
  const TankRun* run;
};
/// The paper's fig:staticTorque: all curves in one picture. Throws std::invalid_argument for a run
/// without samples, or with readings that are not finite.
std::string tank_figure(const Problem& problem, const std::vector<TankCurve>& curves);

/// Runs of a task in time as SVG, all over time: the angle of the end effector (not of an impulse,
/// where it rests), the readings along c and the trajectories, and of each run the thruster forces
/// with their limits and theta_r. Throws as `tank_figure`.
std::string motion_figure(const Problem& problem, const std::vector<TankCurve>& curves);

/// The robot at the instants of a trajectory that are next to `times` [s], from two sides, as SVG;
/// titles say how far the end effector has turned, or when it is. The trajectory has instants, as
/// one that is no invalid posture.
std::string trajectory_figure(const Problem& problem, const Trajectory& trajectory,
                              const std::vector<double>& times);

}  // namespace maxwrench
