#pragma once

#include "lib/trajectory/scheme.h"
#include "lib/trajectory/transfer_dynamics.h"

namespace maxwrench {

/// A clamped cubic spline from the start of a transfer to its end.
struct SplineMotion {
  SchemeMaps maps;    ///< from the knots to the instants
  Eigen::MatrixXd Q;  ///< all knots, both ends included (K×n)

  Eigen::VectorXd q(int instant) const { return Q.transpose() * maps.P.row(instant).transpose(); }
  Eigen::VectorXd v(int instant) const { return Q.transpose() * maps.V.row(instant).transpose(); }
  Eigen::VectorXd a(int instant) const { return Q.transpose() * maps.A.row(instant).transpose(); }
};

/// The same motion with a knot at each of `intervals` + 1 equidistant times and `per_interval`
/// instants between them.
///
/// @param task   the transfer
/// @param knots  its table of knots
SplineMotion resampled(const MotionTask& task, const Eigen::MatrixXd& knots, int intervals,
                       int per_interval);

/// Moves the knots between the ends to a local minimum of the sum of ((u_i - efforts_i)/w_i)^2 over
/// all instants, where u = B^+ f is not limited, by the method of Levenberg and Marquardt.
///
/// @param problem    the transfer
/// @param m          the mass of the payload [kg]
/// @param stiffness  weight of what exceeds the limits of joints and speeds, as in `TransferIndex`
///                   for epsilon = 1
/// @param efforts    what the efforts at the instants shall be (m×instants); empty: zero
/// @param motion     where to begin; receives the result
void follow_efforts(const Problem& problem, double m, double stiffness,
                    const Eigen::MatrixXd& efforts, SplineMotion& motion);
/// The same with efforts of zero: the motion of least effort.
void minimise_effort(const Problem& problem, double m, double stiffness, SplineMotion& motion);

}  // namespace maxwrench
