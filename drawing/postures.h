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
  /// Points whose convex hull outlines the base, in base axes [m]. If empty, the base is drawn from
  /// the robot's solids or, without solids, from its thrusters and arm mounts.
  std::vector<Eigen::Vector3d> hull;
  /// Actuator efforts. Those of the thrusters are drawn as arrows. If empty, arrows show the
  /// directions only.
  Eigen::VectorXd u;
};

/// Draws postures side by side as SVG, all with the same scales of metres and newtons
/// (fig:polytopes and fig:optimalpolytopes). Sets of the same name have the same style in all
/// panels. Names and titles are written by `Svg::text`. Throws std::invalid_argument if there is
/// nothing to draw or a value is not finite.
std::string draw_postures(std::span<const DrawnPosture> panels, View view = View::kTop);

/// Draws the postures seen from the robot's right and, below that, from above.
std::string draw_both_views(std::span<const DrawnPosture> panels);

}  // namespace maxwrench
