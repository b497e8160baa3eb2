#pragma once

#include <vector>

#include "lib/types.h"

namespace maxwrench {

/// max c'w  subject to  low <= [G; I] w <= high, a dual simplex on the full tableau for few
/// columns.
///
/// G is f×k; bounds may be infinite or equal. A basis is k rows of [G; I], on whose bounds w lies;
/// the tableau is T = [G; I] times the inverse of those rows, so that its last k rows are that
/// inverse, and y = T_I'c are the multipliers. Every basis of rows with two finite bounds is dual
/// feasible once each row rests on the bound that the sign of its y asks for: there is no first
/// phase. With finite bounds on all of w the unit rows are that basis, and no pivot is needed.
class Tableau {
 public:
  enum class Outcome { kOptimal, kInfeasible, kUndecided };

  /// Sizes the storage; allocates only when the sizes change. Then fill `entry` (of G), `low`,
  /// `high` and `c`.
  void resize(int rows, int columns);
  double& entry(int row, int column) { return G_[column * stride_ + row]; }

  Outcome solve();

  Eigen::VectorXd low, high;  ///< f + k
  Eigen::VectorXd c;          ///< k
  Eigen::VectorXd w;          ///< k, the optimum
  Eigen::VectorXd y;          ///< k, the multiplier of row `basis[i]`, positive at its upper bound
  std::vector<int> basis;     ///< k rows of [G; I]
  int iterations = 0;

 private:
  bool start();
  int violated_row(bool first) const;
  int leaving(int row, double& gap, bool first);
  bool comes_before(int i, int j, int row, bool first) const;
  void pivot(int row, int column);
  void move(int column, double step);
  double excess(int row) const;
  double violation(int row) const;
  void refine();
  void dual_residual();
  bool optimum_holds();
  bool contradiction_holds(int row) const;
  double given(int row, int column) const { return G_[column * stride_ + row]; }
  double at(int row, int column) const { return T_[column * stride_ + row]; }

  int rows_ = 0, columns_ = 0, total_ = 0, stride_ = 0;
  std::vector<double> G_, T_;   // columns of `stride_` entries
  std::vector<double> value_;   // [G; I] w
  std::vector<double> slack_;   // how far a row may be missed by rounding
  std::vector<double> weight_;  // one over the norm of the rows
  std::vector<double> r_;       // the bound that the basic rows rest on
  std::vector<double> side_;    // 1 if that is the upper one, -1 if the lower
  std::vector<char> in_basis_;  // by rows
  std::vector<double> work_;
  std::vector<int> candidates_;
};

}  // namespace maxwrench
