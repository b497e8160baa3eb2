#pragma once

#include <vector>

#include "maxwrench/path.h"

namespace maxwrench {

/// The linear maps of a scheme from a table Q of knots (K×r) to N instants. For an impulse the
/// first of the K = k + 1 knots is theta_0. The first instant, if `starts`, is at rest there.
///
///     theta_r = P Q,   theta_r_dot = V Q,   v = moves (J_e x_dot + A_r theta_r_dot)
///     `spline`: theta_r_ddot = A Q and v_dot exact;   else: v_dot = D v
///
/// v and v_dot are those of all velocities, in base axes.
struct SchemeMaps {
  std::vector<double> t;      ///< N [s]
  std::vector<PathPoint> x;   ///< N, of the end effector; accelerations only for `spline`
  std::vector<int> knot_at;   ///< K: the instant of each knot; -1 if there is none
  Eigen::MatrixXd P, V, A;    ///< N×K; A only for `spline`, else empty
  Eigen::MatrixXd D;          ///< N×N; empty for `spline`
  Eigen::VectorXd moves;      ///< N numbers: 1, or 0 where the scheme sets v to zero
  bool starts = false;        ///< the first instant is the start of an impulse
  int before = 0, after = 0;  ///< knots that are given, at the start and at the end
  double dt = 0;              ///< between neighbouring knots [s]; 0 if k = 1
  /// Rows that act on each coordinate of theta_r over its K knots: limits of its rate (speed Q
  /// within +-q_dot_max), limits of its value in addition to those at the knots (place Q within the
  /// limits), and rows that must vanish (zero Q = 0; an acceleration is multiplied by dt^2).
  Eigen::MatrixXd speed, place, zero;

  int instants() const { return static_cast<int>(t.size()); }
  int knots() const { return static_cast<int>(P.cols()); }
  /// The knots of a table: those that are not given.
  int rows() const { return knots() - before - after; }
  bool smooth() const { return D.size() == 0; }
};

/// Throws std::invalid_argument if the scheme does not support the task.
SchemeMaps make_scheme(const MotionTask& task);

/// Instants per interval for `value_between_knots`, along a path and in an impulse.
inline constexpr int kDensePath = 25, kDenseImpulse = 50;

/// The knots that a scheme maps: the table, for an impulse with theta_0 before it, for a transfer
/// with both ends.
Eigen::MatrixXd all_knots(const MotionTask& task, const Eigen::MatrixXd& table);

/// The clamped cubic spline through the knots of a task, whatever its scheme, with this many
/// instants per interval. `value_between_knots` is computed on it. For an impulse it begins with
/// the start.
SchemeMaps make_dense_spline(const MotionTask& task, int instants_per_interval);

}  // namespace maxwrench
