#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// max c'x  subject to  low <= [G; I] x <= high, by a dual simplex on a condensed tableau, for few
/// columns.
///
/// G is f×k; bounds may be infinite or equal. Of the f + k rows of [G; I], a basis contains k, and
/// x lies on their bounds. The tableau T (f×k) expresses the other rows, the dependent ones, by
/// those of the basis. A pivot exchanges a dependent row with one of the basis. y are the
/// multipliers of the basis: the objective is y'(rows of the basis). A basis is dual feasible if
/// the bound that the sign of y selects is finite in each of its rows, so there is no first phase.
/// With finite bounds on all of x, the unit rows are such a basis, and no pivot is needed. A free
/// column, or a bounded one whose y selects an infinite bound, is first exchanged for a row of G
/// with two finite bounds.
class Tableau {
 public:
  enum class Outcome { kOptimal, kInfeasible, kUndecided };

  /// Sizes the storage; allocates only when the sizes change. Call it before you fill `entry` (of
  /// G), `low`, `high` and `c`.
  void resize(int rows, int columns);
  double& entry(int row, int column) { return G_[row * stride_ + column]; }
  /// The entries of row i of G, `stride` of them (solvers/wrench/padded.h). Those beyond k are zero
  /// and must stay zero.
  double* row(int i) { return &G_[static_cast<std::size_t>(i) * stride_]; }
  int stride() const { return stride_; }

  /// Checks the result with G before it is returned; a result that fails is undecided.
  Outcome solve();

  Eigen::VectorXd low, high;  ///< f + k
  Eigen::VectorXd c;          ///< k
  Eigen::VectorXd x;          ///< k, the optimum
  /// f, of the rows of G. If optimal: their multipliers, positive at an upper bound. If infeasible:
  /// weights with which the rows add up to one that the bounds of x contradict (Farkas).
  Eigen::VectorXd multipliers;
  int iterations = 0;

 private:
  /// Rows of [G; I] with their bounds, in any order.
  struct Lines {
    std::vector<int> row;
    std::vector<double> low, high;
    std::vector<double> slack;   // violation that rounding may cause
    std::vector<double> weight;  // one over its squared norm
    std::vector<double> tight;   // one over the distance of its bounds
    void resize(int count);
    void exchange(int i, Lines& other, int j);
  };

  void read();
  void measure();
  bool start();
  bool rests(int j);
  int violated(bool first);
  int highest(double least) const;
  int leaving(int i, double& gap, bool first);
  int first_of(double ratio, int i, bool first) const;
  void exchange(int i, int j);
  void multiply(const double* rows, const double* factors, double* products) const;
  void move(int j, double step);
  double bound(int j) const { return side_[j] > 0 ? basis_.high[j] : basis_.low[j]; }
  void fill();
  void refine();
  bool optimum_holds();
  bool prove_contradiction(int i, double side);
  double given(int row, int column) const { return G_[row * stride_ + column]; }
  double* T(int i) { return &T_[static_cast<std::size_t>(i) * stride_]; }
  const double* T(int i) const { return &T_[static_cast<std::size_t>(i) * stride_]; }

  int rows_ = 0, columns_ = 0, stride_ = 0;
  std::vector<double> G_, T_;  // rows of `stride_` entries; the last one of T_ is y
  Lines dependent_, basis_;
  std::vector<double> value_;  // of the dependent rows
  std::vector<double> score_;  // of the dependent rows, padded to a whole chunk
  bool measured_ = false;      // weight and tight are known
  std::vector<int> used_;      // rows of G with a multiplier
  std::vector<double> side_;   // 1 if a row of the basis rests on its upper bound, else -1
  std::vector<double> ratio_;
  std::vector<double> point_, y_, slack_;  // of all rows of [G; I]
};

}  // namespace maxwrench
