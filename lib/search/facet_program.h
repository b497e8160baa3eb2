#pragma once

#include <memory>

#include "maxwrench/objective.h"

namespace maxwrench {

struct Problem;

/// The value of `linf_polytope` at all theta_r as one smooth program, on one IK solution of what
/// follows from theta_r: with the facets b_min <= N'tau <= b_max of {B u},
///
///     max c_w'w   over theta_r and w, subject to
///     b_min <= N'(tau_d(theta_r) + J'W(theta_r) w) <= b_max,   w_min <= w <= w_max,
///     0 <= clearance of each pair of bodies (theta_r),   q_min <= joints that follow (theta_r) <=
///     q_max
///
/// (eq:reducedDynamics; w and J'W those of `WrenchProgram`, second contact included). Its rows are
/// the f facet pairs [N; N m], the pairs of bodies whose distance is known [m], and the joints that
/// follow [rad; m], dependent ones or those of the second arm. At fixed theta_r its optimum is the
/// lower level's. Collisions of pairs of which only a test is known are not in it.
class FacetProgram {
 public:
  /// Keeps a reference to the problem, whose actuation has facets. `make` makes linf_polytope.
  FacetProgram(const Problem& problem, Wrench wrench, const MeasureMaker& make,
               bool check_collision = true);
  FacetProgram(const Problem&&, Wrench, const MeasureMaker&, bool = true) = delete;
  ~FacetProgram();

  const Eigen::VectorXd& c_w() const;      ///< k
  const Eigen::VectorXd& w_min() const;    ///< k
  const Eigen::VectorXd& w_max() const;    ///< k
  const Eigen::VectorXd& row_min() const;  ///< of clearances a nanometre
  const Eigen::VectorXd& row_max() const;
  const Eigen::VectorXd& row_unit() const;  ///< much for a row: half the width of its bounds, 0.1 m

  /// How many postures theta_r has that are valid but for collisions.
  int ik_solutions(const Eigen::VectorXd& theta_r);
  /// Sets out from one of these; w gets the lower level's answer there, or, where it has none, what
  /// is nearest to zero within the limits.
  /// False if there are no more so many, which may happen where postures appear or end.
  bool set_out(const Eigen::VectorXd& theta_r, int ik_solution, Eigen::VectorXd& w);

  /// The rows at (theta_r, w): on the IK solution whose joints are nearest to those of the last
  /// `linearize`, or of `set_out` if that came later. False if theta_r has no valid posture.
  bool evaluate(const Eigen::VectorXd& theta_r, const Eigen::VectorXd& w);
  const Eigen::VectorXd& rows() const;

  /// The derivatives of the rows at the point of the last `evaluate`, which was true. Exact; on
  /// its IK solution.
  void linearize();
  const Eigen::MatrixXd& by_theta_r() const;  ///< rows×r
  const Eigen::MatrixXd& by_w() const;        ///< rows×k

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// An objective of postures, which may have such a program, for searches that solve it.
class FacetObjective : public Objective {
 public:
  /// A new one; null: f is no optimum of the wrench program, or {B u} has too many facets.
  virtual std::unique_ptr<FacetProgram> make_facet_program() const = 0;
};

/// Whether a static problem has such a program, of the size that solvers with dense matrices take
/// well: at most 200 facet pairs.
bool has_facet_program(const Problem& problem);

}  // namespace maxwrench
