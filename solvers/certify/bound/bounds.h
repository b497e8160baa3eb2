#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "maxwrench/bound.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/multi_affine.h"

// The bounds that make up the bound of a capability.

namespace maxwrench {

/// The largest factor by which control points may exceed values. The terms for rounding rely on it.
inline constexpr double kMostSpread = 16;

/// The largest rounding error of a sum of products with a few factors each, after some hundred
/// operations, as a share of the sum of its magnitudes.
inline constexpr double kBoundRounding = 128 * std::numeric_limits<double>::epsilon();

/// The error of a ceiling, as a share of it: rotation matrices of rounded numbers are not exactly
/// rotations.
inline constexpr double kCeilingRounding = 1e-6;
/// [m] A ceiling is valid up to this far beyond the limits of sliding coordinates, like that of
/// `verify`.
inline constexpr double kCeilingMargin = 1;

/// A bound with W = c, of beta = max t subject to tau + t a in a convex set with the support
/// function s. For all coordinates x of the posture, `LoopCoordinates`, with equations f(x) = 0,
/// and for any lambda and nu, no value in [low, high] of a posture in the box exceeds
///
///     U(lambda, nu) = s(lambda) + max over control points v and t in {low, high} of
///                     t (1 - lambda'a_v) - lambda'tau_v - nu'f_v.
///
/// If the base follows in closed form, x is theta_r, and there are no equations. The lambda and nu
/// with the least U are used. In sign, lambda is minus the multiplier of the lower level. The
/// multiplier is [lambda; nu]. Where lambda'a_v > 0 at all control points, the largest
/// (s(lambda) - lambda'tau_v - nu'f_v)/lambda'a_v is also a bound. Where no useful limit
/// of the values is known, `EquationProgram` may exclude the box.
///
/// The convex set of linf_polytope is {B u}. For l2_polytope the program is the same with (I, B^+
/// a, B^+ tau). The ellipsoid is |W_u B^+ tau| <= 1, with lambda from the centre of the box.
/// `left_out`, only of linf_polytope: the coordinate about the yaw of a parked base, or none. The
/// rows of the base and of joints outside the chain then have lambda = 0.
std::unique_ptr<Bound> make_pure_bound(const Problem& problem, const std::string& measure,
                                       std::optional<int> left_out = std::nullopt);

/// For W with as many columns as the base has free axes. The forces u of the thrusters on the base
/// then determine h by w = (J_b'W)^-1 (B_b u - tau_b). So beta = o_0 + o'u, and the joints exert
/// tau_0 + A u. With one number mu per joint and the support function s(mu) of the joints' limits,
/// no value in the box exceeds
///
///     U(mu) = s(mu) + max over control points v and u within limits of
///             o_0 - mu'tau_0 + (o - A'mu)'u.
std::unique_ptr<Bound> make_any_wrench_bound(const Problem& problem);

/// For any wrenches with dependent joints. Let A(x) be J'W of the free components h across c. In
/// addition to `make_pure_bound`, lambda'A h has to be taken into account, which no fixed lambda
/// makes zero. With P, R and the centre m of the box as in `FreePoints`, the balance gives
/// h = P (B u - tau_m) + rho, |rho| <= R. For fixed u, t and rho all terms are multi-affine, so for
/// any lambda and nu no value in [low, high] of a posture in the box exceeds
///
///     U(lambda, nu) = max over control points v, t in {low, high}, u within limits and |rho| <= R
///                     of t (1 - lambda'a_v) + lambda'B u - lambda'tau_v - nu'f_v
///                        - lambda'A_v (P (B u - tau_m) + rho).
///
/// The multiplier is [lambda; nu; the lambda of the centre, from which P follows]. A box in which
/// nothing limits h has no bound, unless `EquationProgram` excludes it. `low` and `high` are at
/// most what limits t there, `FreeLimits`. Throws std::invalid_argument, with one line, for more
/// free components than the robot has coordinates, and for too many actuators.
std::unique_ptr<Bound> make_free_bound(const Problem& problem);

/// For a disc of wrenches E z, |z| <= beta, with any wrenches across it: P = {z : some efforts
/// balance E z and some free components} is convex, and beta is the least of its supports. So the
/// support along any direction d is a bound, and no value in the box exceeds
///
///     U(d, mu) = s(mu) + max over control points v and u within limits of
///                sum_i d_i o_0,i - mu'tau_0 + (sum_i d_i o_i - A'mu)'u,   |d| = 1,
///
/// with o_0, o, tau_0 and A of `make_any_wrench_bound` for each axis of E. W has the columns of E
/// and the free components. The program along d has one multiplier more, of the equation that the
/// wrench across d is zero; it turns d to the normal of the edge of P that the ray along d meets.
/// Directions begin with that of the larger box, and with the nearest edge at the centre of the
/// box. The multiplier is [d; mu].
std::unique_ptr<Bound> make_ball_any_bound(const Problem& problem, const Matrix6Xd& E);

/// A bound of linf_polytope of a list of scenarios, with pure wrenches. A value t of the list is a
/// factor of every scenario s, so for any lambda_s and nu
///
///     U = sum_s s_s(lambda_s) + max over control points v and t in {low, high} of
///         t (1 - sum_s lambda_s'a_s,v) - sum_s lambda_s'tau_s,v - nu'f_v
///
/// is a bound as above. It combines the facets of all scenarios that have to do with a box; all
/// others have lambda_s = 0. The multiplier is [numbers of s; lambda_s] of each scenario with
/// lambda_s, and nu. Throws std::invalid_argument, with one line, as `ListModel`. Any wrenches, a
/// load that always has a current, and forces of a second contact have the bound
/// `make_alone_list_bound`.
std::unique_ptr<Bound> make_list_bound(const Problem& problem, Wrench wrench);

/// Whether each load has a case without a current, so that such scenarios bound the list.
bool has_still_water(const ScenarioList& list);

/// A bound of linf_polytope of a list: a value of the list is a factor of every scenario, so it
/// does not exceed the bound of any scenario alone. The least of these is the bound; it stays above
/// the optimum where two scenarios meet in a ridge. A scenario in a current v_c is an instant of a
/// motion at -v_c through still water (`make_instant_bound`). The multiplier is [number of the
/// scenario; its own multiplier]; scenarios that only hold and those with infinite limits are left
/// out. Of a ball with any wrenches each scenario has `make_ball_any_bound`. With forces of a
/// second contact each scenario has the bound of an ordinary task, and x ends with the shares of
/// the contact forces of each scenario. Throws std::invalid_argument, with one line, for more than
/// 64 scenarios, and as the bounds of single tasks. With forces of a second contact also for a ball
/// of several axes, and a payload at a pose that is partly free. Without them for any wrenches in a
/// current, a payload, other balls, a pose that is partly free and dependent joints.
std::unique_ptr<Bound> make_alone_list_bound(const Problem& problem, Wrench wrench);

/// Magnitudes of tau and a in the six axes of the base, beyond the limits of sliding coordinates.
struct CeilingSizes {
  Eigen::VectorXd tau, a;
};
CeilingSizes ceiling_sizes(const Problem& problem);

/// t <= (sum_k max |u_k| |B_k| + |tau|) / |J'c|, where only the base's free axes count: the linear
/// ones for a force and the angular ones for a torque. On all three axes of that kind, |J'c| is the
/// length of the force or torque of c. The share of axes that are not free is subtracted from its
/// square. For tasks whose base follows in closed form, without forces of a second contact. Throws
/// std::invalid_argument, with one line, for a c that the free axes do not limit.
double pure_ceiling(const Problem& problem, const Vector6d& c, const Zonotope& set,
                    const CeilingSizes& sizes);

/// The same where the base determines the forces of a second contact: the base's angular rows give
/// t |c| <= |tau| + |K u|, with all magnitudes. Infinity if c has a force, which the contact can
/// bear.
double braced_ceiling(const Problem& problem);

/// `make_capability_bound` without a coordinate that is left out: boxes are cut along all of them.
std::unique_ptr<Bound> make_bound_of_all_coordinates(const Problem& problem,
                                                     const std::string& measure, Wrench wrench);

/// Returns -infinity for boxes throughout which two bodies collide, else `high`. For each pair of
/// bodies, a point of one body's core moves along a multi-affine path in the axes of the other's
/// link. The other's core, with its reach, is convex: if it contains all control points of the
/// path, it contains the point. Null if the robot has no cores.
///
/// The box of the coordinate `left_out` is wide. Where bodies collide at its middle throughout a
/// box, the box is cut along it.
std::unique_ptr<Bound> make_collision_bound(const Problem& problem,
                                            std::optional<int> left_out = std::nullopt);

/// The width of a box along its widest coordinate, except one of them; -1: all count.
inline double widest(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int except) {
  double most = 0;
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (i != except) most = std::max(most, upper[i] - lower[i]);
  }
  return most;
}

}  // namespace maxwrench
