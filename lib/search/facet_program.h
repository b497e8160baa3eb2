#pragma once

#include <memory>
#include <vector>

#include "lib/search/facet_side.h"
#include "maxwrench/objective.h"

namespace maxwrench {

struct Problem;

/// The value of `linf_polytope` over all theta_r as one smooth program, on one IK solution of the
/// dependent coordinates. With the facets b_min <= N'tau <= b_max of {B u}:
///
///     max c_w'w   over theta_r and w, subject to
///     b_min <= N'(tau_d(theta_r) + J'W(theta_r) w) <= b_max,   w_min <= w <= w_max,
///     0 <= clearance of each pair of bodies (theta_r),
///     q_min <= dependent joints (theta_r) <= q_max
///
/// (eq:reducedDynamics; w and J'W are those of `WrenchProgram` and include the second contact). The
/// rows are the f facet pairs [N; N m], the pairs of bodies whose distance is known [m], and the
/// dependent joints, including those of the second arm [rad; m]. At fixed theta_r the optimum is
/// that of the lower level. The program has no rows for pairs of bodies that have a collision test
/// but no distance. Of a list of scenarios, w is the factor of its wrenches, and the first rows are
/// those of `ScenarioRows`.
class FacetProgram {
 public:
  /// Keeps a reference to the problem, whose actuation must have facets. `make` makes
  /// linf_polytope.
  FacetProgram(const Problem& problem, Wrench wrench, const MeasureMaker& make,
               bool check_collision = true);
  FacetProgram(const Problem&&, Wrench, const MeasureMaker&, bool = true) = delete;
  ~FacetProgram();

  const Eigen::VectorXd& c_w() const;      ///< k
  const Eigen::VectorXd& w_min() const;    ///< k
  const Eigen::VectorXd& w_max() const;    ///< k
  const Eigen::VectorXd& row_min() const;  ///< for clearances one nanometre
  const Eigen::VectorXd& row_max() const;
  const Eigen::VectorXd& row_unit() const;  ///< half the width of a row or pair; 0.1 m: a clearance
  /// The number of rows of forces, which come first, and the facet of each.
  Eigen::Index force_rows() const;
  FacetSide facet(Eigen::Index row) const;
  const std::vector<int>& pairs() const;      ///< of the rows of clearances, see `CollisionChecker`
  const std::vector<int>& following() const;  ///< of the rows of dependent joints

  /// The number of postures at theta_r that are valid apart from collisions.
  int ik_solutions(const Eigen::VectorXd& theta_r);
  /// Starts from the posture `ik_solution` at theta_r. `w` is set to the lower level's answer there
  /// or, if there is none, to the point within the limits nearest to zero. False if theta_r has
  /// fewer postures, which may happen where IK solutions appear or end.
  bool set_out(const Eigen::VectorXd& theta_r, int ik_solution, Eigen::VectorXd& w);

  /// The rows at (theta_r, w), on the IK solution whose joints are nearest to those of the last
  /// `linearize` or `set_out`, whichever came later. False if theta_r has no valid posture.
  bool evaluate(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& w);
  const Eigen::VectorXd& rows() const;

  /// The exact derivatives of the rows at the point and on the IK solution of the last `evaluate`,
  /// which must have returned true.
  void linearize();
  const Eigen::MatrixXd& by_theta_r() const;  ///< rows×r
  const Eigen::MatrixXd& by_w() const;        ///< rows×k

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// An objective over postures that may have a facet program, for searches that solve it.
class FacetObjective : public Objective {
 public:
  /// A new program, or null if the objective is not the optimum of the wrench program or {B u} has
  /// too many facets.
  virtual std::unique_ptr<FacetProgram> make_facet_program() const = 0;
};

/// Whether a static problem has a facet program that suits solvers with dense matrices: at most 200
/// facet pairs, and 1200 rows of a list of scenarios.
bool has_facet_program(const Problem& problem, Wrench wrench);

}  // namespace maxwrench
