#pragma once

#include <vector>

#include "maxwrench/trajectory_program.h"
#include "solvers/wrench/tableau.h"

namespace maxwrench {

/// Bordered max-min programs of one wrench column, in t and y alone, without effort rates, which
/// couple instants, without slacks, and with only the facets that limit t from above. As B u fills
/// its zonotope, instant i allows t if, for all facet pairs j,
///
///     |s_ij| t - sigma_ij n_j'G_i y <= sigma_ij (b_j - n_j'tau_d,i),
///     s_ij = n_j'(J'W)_i / c_w,i,  sigma_ij = sign(s_ij),  b_j the bound on that side.
///
/// So t is an upper bound of the program's value, and equal to it where the omitted parts do not
/// matter. A dual simplex (`Tableau`) solves it with the rows that are likely to matter, adds the
/// rows that its answer violates, and repeats until there are none.
class BorderedFacets {
 public:
  /// Whether the program is of this kind. It may have rates and slacks, which are ignored.
  static bool suits(const TrajectoryProgram& program);
  /// Sets value, y and the multipliers lambda, pi, nu, whose limits and signs are verified; sets no
  /// efforts. Returns false if there is no verified optimum.
  bool solve(const TrajectoryProgram& program, TrajectorySolution& solution);

 private:
  /// low <= slope t + pull'y <= high.
  struct Row {
    int instant = -1;  ///< -1: a row of R
    int index = 0;     ///< the facet pair, or the row of R
    double side = 0;   ///< sigma; 0 where t does not matter
    double slope = 0;  ///< |s|
    double low = 0, high = 0;
    double reach = 0;  ///< how far y can change pull'y
    bool used = false;
  };

  void collect(const TrajectoryProgram& program);
  void add_facets(const TrajectoryProgram& program, int instant);
  void choose();
  bool add_violated(const Eigen::VectorXd& x);
  void load(const TrajectoryProgram& program);
  void read(const TrajectoryProgram& program, TrajectorySolution& solution) const;

  std::vector<Row> rows_;
  Eigen::MatrixXd y_slopes_;  ///< p×(rows)
  Eigen::VectorXd y_values_;
  Tableau tableau_;
  double most_ = 0;  ///< no y permits a larger t
};

}  // namespace maxwrench
