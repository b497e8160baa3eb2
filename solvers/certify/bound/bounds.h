#pragma once

#include <limits>

#include "maxwrench/bound.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/multi_affine.h"

// The bounds of which that of a capability is made.

namespace maxwrench {

/// Control points may exceed values by this factor at most, on which terms of rounding rely.
inline constexpr double kMostSpread = 16;

/// A sum of products, each with a few factors, in some hundred steps: how far it may be off, as a
/// share of the sum of its magnitudes.
inline constexpr double kBoundRounding = 128 * std::numeric_limits<double>::epsilon();

/// How far a ceiling may be off, as a share of it: rotations of rounded numbers are not quite that.
inline constexpr double kCeilingRounding = 1e-6;
/// [m] A ceiling holds so far beyond the limits of sliding coordinates, as that of `verify` does.
inline constexpr double kCeilingMargin = 1;

/// Bounds with W = c, of beta = max t subject to tau_d + t J'c in a convex set with the support s:
///
///     U(lambda) = s(lambda) + max over control points v and t in {low, high} of
///                 t (1 - lambda'a_v) - lambda'tau_v
///
/// for any lambda, here minus the multiplier of the lower level, which the least U decides.
/// The L-infinity polytope: {B u}; with `l2` the same program with (I, B^+ J'c, B^+ tau_d).
std::unique_ptr<Bound> make_polytope_bound(const Problem& problem, bool l2);
/// The ellipsoid |W_u B^+ tau| <= 1, lambda from the centre of the box.
std::unique_ptr<Bound> make_ellipsoid_bound(const Problem& problem);

enum class LoopMeasure { kPolytope, kSmallestEffort, kEllipsoid };

/// The L-infinity or L2 polytope or the ellipsoid, where joints follow from theta_r: of all
/// coordinates x of the posture, `LoopCoordinates`, with equations f(x) = 0,
///
///     U(lambda, nu) = s(lambda) + max over control points v and t in {low, high} of
///                     t (1 - lambda'a_v) - lambda'tau_v - nu'f_v
///
/// for any lambda and nu; the multiplier is [lambda; nu]. Where lambda'a_v > 0 at all control
/// points, the largest (s(lambda) - lambda'tau_v - nu'f_v)/lambda'a_v is a bound, too.
std::unique_ptr<Bound> make_loop_bound(const Problem& problem, LoopMeasure measure);

/// With W as wide as the base has free axes: h follows from the forces u of the thrusters on the
/// base, w = (J_b'W)^-1 (B_b u - tau_b). So beta = o_0 + o'u, and the joints exert tau_0 + A u.
/// With mu a number per joint and s(mu) the support of the joints' limits,
///
///     U(mu) = s(mu) + max over control points v and u within limits of o_0 - mu'tau_0 + (o -
///     A'mu)'u.
std::unique_ptr<Bound> make_any_wrench_bound(const Problem& problem);

/// -infinity for boxes in which two bodies collide throughout, else `high`. Of a pair, a point of
/// one body's core moves along a multi-affine path in the axes of the other's link: if its control
/// points are all within reach of the other's core, a convex set, so is the point. Null if the
/// robot has no cores.
std::unique_ptr<Bound> make_collision_bound(const Problem& problem);

}  // namespace maxwrench
