#pragma once

#include <functional>
#include <limits>
#include <string>

#include "lib/search/facet_program.h"
#include "solvers/search/probe.h"
#include "solvers/search/row_program.h"
#include "solvers/search/row_sqp.h"

namespace maxwrench {

/// A `FacetProgram` in the form of a local solver, in y = (x, w/s), with x in the unit cube of the
/// bounds:
///
///     max c_y'y   subject to   row_min <= rows(y) <= row_max,   lower <= y <= upper.
///
/// Each row is divided by its unit. The scale s_k is how much of wrench column k alone the start
/// can bear, or |w_k| if that is larger. Each point counts as an evaluation of the probe, which
/// reserves one for the end.
class FacetView final : public RowProgram {
 public:
  /// All arguments must outlive this.
  FacetView(Probe& probe, FacetProgram& program, const Box& box);

  /// Starts at an IK solution of theta_r, which counts as one evaluation. Returns false if theta_r
  /// has no solution of this number.
  bool set_out(const Eigen::VectorXd& theta_r, int ik_solution);

  /// Whether no evaluation is left except the reserved one.
  bool ended() const override { return probe_.left() < 2; }
  /// False if there is no posture, or if `ended`.
  bool look(const Eigen::VectorXd& y) override;
  /// f×(d + k)
  const Jacobian& jacobian() override;

  Eigen::VectorXd theta_r(const Eigen::VectorXd& y) const { return box_.theta_r(y.head(d_)); }

 private:
  void scale(const Eigen::VectorXd& w);

  Probe& probe_;
  const Box& box_;
  FacetProgram& program_;
  Eigen::Index d_;
  Eigen::VectorXd unit_, w_scale_;
  Eigen::VectorXd y_;
  bool valid_ = false, linear_ = false;
  Jacobian jacobian_;
};

/// Where a local solve ended, and the library's status.
using FacetEnd = RowEnd;

/// A local solve from `view.start()`.
using FacetSolve = std::function<FacetEnd(FacetView& view)>;

/// Local solves from many postures: first from `options.starts`, or from `options.start` if there
/// are none, then from random ones. Each posture is solved from all its IK solutions. The objective
/// is evaluated at the end of each solve, and only this value counts as found. Each of these counts
/// as an evaluation: a start, with or without a posture; an IK solution of a start; a point at
/// which a solve evaluates rows; and an end. Runs in up to eight parallel parts, one for each 200
/// evaluations of the budget. Ends after `most` solves or a few more. Throws std::invalid_argument,
/// with `name`, if the objective has no facets.
SearchResult search_from_facet_starts(const char* name, Objective& objective,
                                      const SearchOptions& options, const FacetSolve& solve,
                                      long most = std::numeric_limits<long>::max());

/// One of these local solves, from an IK solution of theta_r (`FacetProgram::ik_solutions`).
/// Returns the value at its end, -infinity if there is none. At least three evaluations must be
/// left. Stores the library's status in `status`, if given.
double solve_from(Probe& probe, FacetProgram& program, const Box& box,
                  const Eigen::VectorXd& theta_r, int ik_solution, const FacetSolve& solve,
                  std::string* status = nullptr);

}  // namespace maxwrench
