#pragma once

#include <string>
#include <vector>

#include "maxwrench/task.h"

namespace maxwrench {

/// Rejects a mass that is negative and moments that no body has. A mass point, a thin rod and a
/// frame without mass are fine as long as they are a part of a link.
void require_body(const std::string& link, double mass, const Eigen::Matrix3d& inertia);

/// Whether something displaces water, and whether added mass and drag are known of it.
struct InWater {
  std::string name;
  double volume = 0;  ///< m^3
  bool has_hydrodynamics = false;
};

/// What displaces water moves water: once one body has added mass, each body with a volume needs
/// its own, if only zeros. A forgotten one would go unnoticed. Added mass and drag are those of
/// water, so there must be some.
void require_hydrodynamics(const std::vector<InWater>& bodies, double water_density);

/// Rejects negative or infinite coefficients.
void require_coefficients(const std::string& key, const Vector6d& values);

}  // namespace maxwrench
