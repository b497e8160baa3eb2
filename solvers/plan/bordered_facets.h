#pragma once

#include <vector>

#include "maxwrench/plan_program.h"
#include "solvers/wrench/tableau.h"

namespace maxwrench {

/// Bordered max-min programs of one wrench column without slacks and rates, in t and y alone: as
/// B u fills its zonotope, instant i allows t exactly if
///
///     |s_ij| t - sigma_ij n_j'G_i y <= sigma_ij (b_j - n_j'tau_d,i)   for all facet pairs j,
///     s_ij = n_j'(J'W)_i / c_w,i,  sigma_ij = sign(s_ij),  b_j the bound on that side
///
/// and none of its facets on the other side is beyond t, which the caller checks. Facets that no y
/// within its bounds makes the tightest are left out; the rest is a dual simplex (`Tableau`).
class BorderedFacets {
 public:
  /// Sets value, y, lambda, pi, nu. False if there is no verified optimum.
  bool solve(const PlanProgram& program, PlanSolution& solution);

 private:
  struct Facet {
    int instant = 0, pair = 0;
    double side = 0;   ///< sigma; 0 where t does not matter
    double slope = 0;  ///< |s|
    double low = 0, high = 0;
    double reach = 0;  ///< how far y can move the row
  };

  void collect(const PlanProgram& program);
  void load(const PlanProgram& program);
  void read(const PlanProgram& program, PlanSolution& solution) const;

  std::vector<Facet> facets_;
  Eigen::MatrixXd pulls_;  ///< n_j'G_i, a column of p for each facet
  Tableau tableau_;
  double most_ = 0;  ///< no y allows more t
  int rows_ = 0;
};

}  // namespace maxwrench
