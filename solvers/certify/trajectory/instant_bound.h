#pragma once

#include <memory>

#include "maxwrench/bound.h"
#include "maxwrench/objective.h"
#include "maxwrench/problem.h"
#include "solvers/certify/trajectory/instant_ranges.h"

namespace maxwrench {

/// One instant of all plans of a task: the end effector's motion is given, and theta_r, its rate
/// and its acceleration are within ranges.
///
/// The value of a box x is the most along c that efforts within their limits exert, with the best
/// motion in the ranges. x = [theta_r; its rate], or theta_r alone where it rests. Of a plan's
/// value at this instant it is an upper bound, because it ignores all other instants.
struct PlanInstant {
  /// A static task with one contact whose base's pose follows in closed form: the pose and c of
  /// this instant, and the ranges of theta_r as its limits.
  Problem task;
  PathPoint x;  ///< in axes that move with the current, so that the water is at rest
  InstantRanges ranges;
  bool knot = true;  ///< whether plans are held to be free of collisions here
  Eigen::Vector3d current = Eigen::Vector3d::Zero();  ///< [m/s], in axes of the world

  /// Whether theta_r rests, and so does the path.
  bool rests() const;
  /// The limits of boxes.
  Eigen::VectorXd lower() const;
  Eigen::VectorXd upper() const;
};

/// An upper bound of the values in boxes. In base axes
///
///     tau = tau_0(q) + sum_j q_ddot_j m_j(q) + sum_j q_dot_j d_j(q) + delta(q, q_dot),
///
/// where tau_0 (weight, the path's acceleration and its linear drag), the columns m_j of M A_r and
/// the linear drag d_j are multi-affine in (cos q_i, sin q_i), and delta has the terms that are
/// quadratic in velocities, which interval arithmetic encloses over the box. So with the largest
/// and the least t, any lambda proves that no value in [low, high] exceeds
///
///     U(lambda) = s(lambda) + max over delta of -lambda'delta + max over control points v, t in
///                 {low, high} and the vertices of q_ddot and q_dot of
///                 t (1 - lambda'a_v) - lambda'(tau_0,v + sum_j q_ddot_j m_jv + q_dot_j d_jv).
///
/// The instant must outlive the bound. Throws std::invalid_argument as `make_capability_bound`.
std::unique_ptr<Bound> make_instant_bound(const PlanInstant& at);
std::unique_ptr<Bound> make_instant_bound(const PlanInstant&& at) = delete;

/// The values at points x, by a linear program over efforts, accelerations and t, in ordinary
/// arithmetic; -infinity where a posture collides. The instant must outlive the objective.
std::unique_ptr<Objective> make_instant_objective(const PlanInstant& at);
std::unique_ptr<Objective> make_instant_objective(const PlanInstant&& at) = delete;

}  // namespace maxwrench
