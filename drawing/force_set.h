#pragma once

#include <string>
#include <vector>

#include "maxwrench/posture.h"

namespace maxwrench {

class Measure;
struct Problem;

/// The plane of a picture: seen from above (x to the right, y up), or from the robot's right (x to
/// the right, z up).
enum class View { kTop, kSide };

/// The world's axes along the two axes of the picture, 2×3.
Eigen::Matrix<double, 2, 3> axes(View view);

/// Whether c is a force along the plane of a view.
bool in_view(const Vector6d& c, View view);

/// The forces in the plane of a view that a measure allows at a posture.
struct ForceSet {
  std::string name;
  std::vector<Eigen::Vector2d> outline;         ///< [N], counterclockwise; empty if there are none
  double beta = 0;                              ///< [N] along c; NaN without a value
  Eigen::Vector2d h = Eigen::Vector2d::Zero();  ///< the force that attains beta
  Wrench wrench = Wrench::kPure;
};

/// With `Wrench::kPure` these are the forces without any other component (no torque, no force out
/// of the plane); the boundary of the set along c is beta. With `kAny` these are the forces that
/// occur together with any allowed wrench; the support of the set along c is beta. The outline is
/// exact for polytopes. For `curved` sets it is an inscribed polygon within 1e-4 of the size. The
/// solver of `measure` must support several wrench columns. Throws std::invalid_argument if c is
/// not a force in the plane of the view.
ForceSet force_set(const Problem& problem, const Posture& posture, Measure& measure, Wrench wrench,
                   View view, bool curved, std::string name);

}  // namespace maxwrench
