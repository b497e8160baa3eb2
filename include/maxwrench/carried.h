#pragma once

#include <string>
#include <vector>

#include "maxwrench/types.h"

/// @file
/// What the end effector exerts over time: the weight and inertia of a payload, or a table of
/// wrenches.

namespace maxwrench {

/// A body that is fixed to the end effector, for each kg of its mass.
///
/// All lengths are in the axes of the end effector.
struct CarriedBody {
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      ///< centre of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< inertia about `com` [m^2]
  double volume = 0;                                  ///< displaced volume [m^3]
  Eigen::Vector3d cob = Eigen::Vector3d::Zero();      ///< centre of buoyancy [m]
  /// Added mass about `com`: along the axes [-], and about them [m^2].
  Vector6d added_mass = Vector6d::Zero();
};

/// Wrenches [force; torque] over time, linear in between.
struct WrenchTable {
  std::string file;       ///< where they come from; empty: from code
  std::vector<double> t;  ///< times that increase from 0 to the duration of the task [s]
  Matrix6Xd wrenches = Matrix6Xd(6, 0);  ///< the wrenches, a column for each time [N; N m]

  /// Returns the wrench at the time t [s]; before the first time and after the last, the one there.
  Vector6d at(double time) const;
};

}  // namespace maxwrench
