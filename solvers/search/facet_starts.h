#pragma once

#include <functional>
#include <limits>
#include <string>

#include "lib/search/facet_program.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// A `FacetProgram` as a local solver gets it, in y = (x, w/s), x in the unit cube of the bounds:
///
///     max c_y'y   subject to   row_min <= rows(y) <= row_max,   lower <= y <= upper.
///
/// Rows are in their units; s_k is how much of column k alone the start might bear, or more if w
/// is. Points are counted as evaluations of the probe, which
/// keeps one for the end.
class FacetView {
 public:
  /// All outlive this.
  FacetView(Probe& probe, FacetProgram& program, const Box& box);

  /// Sets out at one of the IK solutions of theta_r, which counts as an evaluation; false if there
  /// are no more so many.
  bool set_out(const Eigen::VectorXd& theta_r, int ik_solution);
  const Eigen::VectorXd& start() const { return start_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  const Eigen::VectorXd& c_y() const { return c_y_; }
  const Eigen::VectorXd& row_min() const { return row_min_; }
  const Eigen::VectorXd& row_max() const { return row_max_; }

  /// Whether no evaluation is left but the one for the end.
  bool ended() const { return probe_.left() < 2; }
  /// Evaluates the rows at y, once for each y in a row. False where there is no posture, or
  /// `ended`.
  bool look(const Eigen::VectorXd& y);
  const Eigen::VectorXd& rows() const { return rows_; }
  /// At the last y, where `look` was true. f×(d + k), by rows.
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Jacobian& jacobian();

  Eigen::VectorXd theta_r(const Eigen::VectorXd& y) const { return box_.theta_r(y.head(d_)); }

 private:
  void scale(const Eigen::VectorXd& w);

  Probe& probe_;
  const Box& box_;
  FacetProgram& program_;
  Eigen::Index d_;
  Eigen::VectorXd unit_, w_scale_;
  Eigen::VectorXd start_, lower_, upper_, c_y_, row_min_, row_max_;
  Eigen::VectorXd y_, rows_;
  bool valid_ = false, linear_ = false;
  Jacobian jacobian_;
};

/// Where a local solve ended, and the library's word for it.
struct FacetEnd {
  Eigen::VectorXd y;
  std::string status;
};

/// A local solve from `view.start()`.
using FacetSolve = std::function<FacetEnd(FacetView& view)>;

/// Local solves from many postures, first `options.starts`, or without any `options.start`, then
/// random ones: from each of the IK solutions of one. The objective is evaluated at the end of
/// each, and that alone counts as found. Each start counts as an evaluation, with or without a
/// posture, and so does each of its IK solutions, each point at which a solve asks for rows, and
/// each end. Runs in up to eight parts side by side, one for each 200 evaluations of the budget,
/// and ends after `most` solves or a few more. Throws std::invalid_argument, with `name`, if the
/// objective has no facets.
SearchResult search_from_facet_starts(const char* name, Objective& objective,
                                      const SearchOptions& options, const FacetSolve& solve,
                                      long most = std::numeric_limits<long>::max());

/// One of these local solves, from an IK solution of theta_r (`FacetProgram::ik_solutions`): the
/// value at its end, -infinity if there is none. At least three evaluations are left. `status`, if
/// given, gets the library's word.
double solve_from(Probe& probe, FacetProgram& program, const Box& box,
                  const Eigen::VectorXd& theta_r, int ik_solution, const FacetSolve& solve,
                  std::string* status = nullptr);

}  // namespace maxwrench
