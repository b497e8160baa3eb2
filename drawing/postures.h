#pragma once

#include <span>
#include <string>
#include <vector>

#include "drawing/force_set.h"

namespace maxwrench {

/// One robot in one posture, with sets of forces around its end effector.
struct DrawnPosture {
  std::string title;
  const Problem* problem = nullptr;
  Posture posture;
  std::vector<ForceSet> sets;
  /// Points whose convex hull outlines the base, in base axes [m]; empty: the robot's solids or,
  /// if it has none, thrusters and arm mounts.
  std::vector<Eigen::Vector3d> hull;
  /// Actuator efforts; the thrusters' are drawn as arrows. Empty: arrows show the directions only.
  Eigen::VectorXd u;
};

/// Draws postures side by side, all in the same scales of metres and of newtons (fig:polytopes and
/// fig:optimalpolytopes), as SVG. Sets of the same name look the same in all panels. Names and
/// titles are written by `Svg::text`. Throws std::invalid_argument if there is nothing to draw or
/// it is not finite.
std::string draw_postures(std::span<const DrawnPosture> panels, View view = View::kTop);

/// The same postures seen from the robot's right, and below that from above.
std::string draw_both_views(std::span<const DrawnPosture> panels);

}  // namespace maxwrench
