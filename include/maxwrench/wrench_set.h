#pragma once

#include <string>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

/// @file
/// The sets of wrenches that a robot can exert at one posture, as bodies of up to three dimensions.

namespace maxwrench {

struct Posture;
struct Problem;

/// The options of `force_polytope`.
struct WrenchSetOptions {
  /// The directions of the set (6×k), 1 to 3 independent columns [force; torque] in world axes.
  ///
  /// A point f (k) of the set stands for the wrench E f. The default is the force, fx, fy, fz; the
  /// last three columns of the identity are the torque.
  Matrix6Xd E = Matrix6Xd::Identity(6, 3);
  Wrench wrench = Wrench::kPure;          ///< the wrenches that are allowed beside those of E
  std::string measure = "linf_polytope";  ///< "linf_polytope" or "l2_polytope"
  /// The solver of the linear programs, one that supports several wrench columns. Empty: the first
  /// one.
  std::string solver = "";
  int most_facets = 10000;  ///< largest number of facets to examine; at least 4
};

/// A convex polytope of wrenches with its vertices and facets.
///
/// Its dimension q may be less than k, the number of columns of E. The points satisfy
///
///     normals'f <= offsets,   flat_normals'f = flat_offsets
///
/// The status is
///
/// * kOptimal, if the set is complete and verified;
/// * kInfeasible, if it is empty: no efforts balance the posture with any wrench of the set;
/// * kUnbounded, if it contains a ray, see `ray`;
/// * kInvalidPosture, if the posture is invalid;
/// * kBudgetExhausted, if it is not complete after `WrenchSetOptions::most_facets` facets;
/// * kNumericalError, if a linear program has no verdict that the data confirm, or the facets found
///   do not close.
///
/// Only with kOptimal there are vertices and facets.
struct WrenchSet : Verdict {
  int dimension = 0;  ///< q, the dimension of the affine hull: 0 for a point, at most k
  /// The vertices (k×V) [N or N m]. For q = 2 they are in order around the set: counterclockwise
  /// for k = 2, and about `flat_normals` for k = 3.
  Eigen::MatrixXd vertices;
  Eigen::MatrixXd efforts;  ///< efforts that exert each vertex (m×V) [N or N m]
  Matrix6Xd wrenches;       ///< wrench of the first contact at each vertex (6×V), in world axes
  Eigen::MatrixXd normals;  ///< outward unit normals of the facets (k×F), within the affine hull
  Eigen::VectorXd offsets;  ///< largest normal'f over the set, for each facet (F)
  /// The vertices of each facet, as indices (F). For q = 3 they are in order, counterclockwise as
  /// seen from outside. For q = 2, facet i joins vertex i with the next one. For q = 1 they are the
  /// two ends.
  std::vector<std::vector<int>> faces;
  /// Triangles of the surface, or of the polygon if q = 2 (3×T): indices of vertices, in the order
  /// of `faces`.
  Eigen::Matrix3Xi triangles;
  Eigen::MatrixXd flat_normals;  ///< orthonormal directions in which the set is flat (k×(k - q))
  Eigen::VectorXd flat_offsets;  ///< value of flat_normal'f on the set (k - q)
  double volume = 0;    ///< volume, area or length for q = 3, 2, 1 [N^q or (N m)^q]; 0 for a point
  Eigen::VectorXd ray;  ///< kUnbounded: a unit direction (k) in which the set has no end
  /// The largest residual of all linear programs, which give each vertex and prove each facet.
  Residual residual;
  int programs = 0;  ///< number of linear programs
};

/// Computes the set of wrenches that a robot can exert at rest at a posture.
///
/// For linf_polytope the set is
///
///     kPure:  {f : B u - J'E f = tau_d, u_min <= u <= u_max}
///     kAny:   {f : B u - J'(E f + N g) = tau_d, u_min <= u <= u_max, g free}
///
/// where N is an orthonormal basis of what remains of W_any orthogonal to E. It is the force
/// polytope of the literature. With a second contact, J_2'C_2 w_2 within its limits is subtracted
/// on the left as well. For l2_polytope, u = B^+ (tau_d + J'h) instead. Let c = E e. The largest x
/// with x e in the set is beta of kPure. If E'E = I and W_any contains E, the largest e'f is beta
/// of kAny. The tolerance is 1e-9 of the size of the set.
///
/// @param task     the task, of which robot, W_any and second contact count
/// @param posture  a posture of the task
/// @param options  directions, allowed wrenches, measure and solver
/// @throws std::invalid_argument, which names key, value and what was expected, if an option is
///         wrong, the posture is of another robot, or the measure does not support the robot.
WrenchSet force_polytope(const Problem& task, const Posture& posture,
                         const WrenchSetOptions& options = {});

/// An ellipsoid of wrenches.
///
/// It consists of the points centre + axes y with sum (y_i / radii_i)^2 <= 1. The status is as that
/// of a `WrenchSet`.
struct WrenchEllipsoid : Verdict {
  Eigen::VectorXd centre;  ///< centre (k) [N or N m]
  Eigen::MatrixXd axes;    ///< orthonormal principal axes (k×k), longest first; det(axes) = 1
  Eigen::VectorXd radii;   ///< radius along each axis (k) [N or N m]
  double volume = 0;       ///< volume, area or length for k = 3, 2, 1
  Eigen::VectorXd ray;     ///< kUnbounded: a unit direction (k) in which the set has no end

  /// Returns the shape matrix S (k×k): the points are those with (f - centre)'S^-1(f - centre)
  /// <= 1.
  Eigen::MatrixXd shape() const;
};

/// Computes the ellipsoid of wrenches of beta_1 (eq:transmissionUVMS) at a posture.
///
/// With weights W_u of one over the smaller of each actuator's two absolute limits, it is
///
///     kPure:  {f : |W_u B^+ (tau_d + J'E f)| <= 1}
///     kAny:   its projection, as for `force_polytope`
///
/// Let c = E e. The largest x with x e in the ellipsoid is beta of the measure `ellipsoid` if that
/// has a value, which also requires that the ellipsoid contains 0.
///
/// @param task     the task
/// @param posture  a posture of the task
/// @param E        the directions, as `WrenchSetOptions::E`
/// @param wrench   the allowed wrenches
/// @throws std::invalid_argument as `force_polytope`, and if B does not have full row rank, an
///         actuator cannot act in both directions, or a force of the second contact has a limit.
WrenchEllipsoid force_ellipsoid(const Problem& task, const Posture& posture,
                                const Matrix6Xd& E = Matrix6Xd::Identity(6, 3),
                                Wrench wrench = Wrench::kPure);

}  // namespace maxwrench
