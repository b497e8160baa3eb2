#pragma once

#include "lib/math/rotated.h"
#include "maxwrench/problem.h"
#include "maxwrench/tank.h"

namespace maxwrench {

/// The reference values of a script at one time.
struct Reference {
  PathPoint x;
  Eigen::VectorXd theta_r, rate, acceleration;  ///< r
  Vector6d c, h;                                ///< in the world
  Eigen::Matrix3d turn;                         ///< the rotation of c and W_any since the start
  Eigen::VectorXd u;                            ///< m
};

/// Interpolates between the instants of a script. Efforts and wrenches are linear. theta_r follows
/// the script's interpolation. On the spline, cubics through the values and rates of neighbouring
/// instants reproduce it. If theta_r is linear, its rate is the slope and its acceleration that of
/// the instants.
class ScriptReader {
 public:
  /// Keeps references to both arguments. Throws std::invalid_argument unless the script has at
  /// least two instants with efforts.
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
