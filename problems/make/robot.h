#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// Rejects an index that is none of the robot's links.
void require_link(const std::string& key, const Robot& robot, int link);

/// Rejects a negative mass, and a matrix that is not finite or not symmetric.
void require_body(const std::string& link, double mass, const Eigen::Matrix3d& inertia);

/// Why no body has these moments; empty if one can. A point mass, a thin rod and a frame without
/// mass can be part of a link.
std::optional<DataFault> why_no_body(const std::string& link, double mass,
                                     const Eigen::Matrix3d& inertia);

/// A body that displaces water, and whether its added mass and drag are known.
struct InWater {
  std::string name;
  double volume = 0;  ///< m^3
  bool has_hydrodynamics = false;
};

/// Rejects incomplete hydrodynamics. A body that displaces water also moves water. Once one body
/// has added mass, every body with a volume must have its own, even if it is zero; otherwise a
/// forgotten one would go unnoticed. Added mass and drag need a water density > 0.
void require_hydrodynamics(const std::vector<InWater>& bodies, double water_density);

/// Rejects negative or infinite coefficients.
void require_coefficients(const std::string& key, const Vector6d& values);

}  // namespace maxwrench
