#pragma once

#include "lib/math/rotated.h"
#include "maxwrench/problem.h"
#include "maxwrench/tank.h"

namespace maxwrench {

/// What a script asks for at one time.
struct Reference {
  PathPoint x;
  Eigen::VectorXd theta_r, rate, acceleration;  ///< r
  Vector6d c, h;                                ///< in the world
  Eigen::Matrix3d turn;                         ///< of c and W_any from the start
  Eigen::VectorXd u;                            ///< m
};

/// Joins the instants of a script: efforts and wrenches linearly; theta_r as its interpolation
/// says, on the spline by the cubics through values and rates of neighbouring instants, which are
/// those of the spline. Linear theta_r has the rate of its slope and the acceleration of the
/// instants.
class ScriptReader {
 public:
  /// Keeps references to both. Throws std::invalid_argument unless the script has at least two
  /// instants with efforts.
  ScriptReader(const Problem& problem, const TankScript& script);
  ScriptReader(const Problem&, const TankScript&&) = delete;

  void read(double t, Reference& reference) const;

 private:
  void join(std::size_t from, double z, double dt, Reference& reference) const;
  Eigen::VectorXd of_theta_r(const Eigen::VectorXd& velocities) const;
  Eigen::Matrix3d turn(const Eigen::Matrix3d& R) const;

  const Problem& problem_;
  const TankScript& script_;
};

}  // namespace maxwrench
