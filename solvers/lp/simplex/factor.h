#pragma once

#include <vector>

#include "solvers/lp/simplex/inverse.h"
#include "solvers/lp/simplex/model.h"
#include "solvers/lp/simplex/sparse_factor.h"

namespace maxwrench::simplex {

/// Factors of the basis matrix B, whose column at position p is the model's column head[p].
///
/// Rows and columns with a single entry are removed first, which leaves the block form
///
///   [ U  *  * ]    columns with one entry left, used unchanged
///   [ 0  L  0 ]    rows with one entry left, used unchanged
///   [ 0  *  D ]    the kernel, a dense LU with row exchanges
///
/// so fill-in occurs in D only. A pivot appends B^-1 times its column (product form). For a basis
/// of few rows, the explicit inverse is used instead, and for a large sparse one, sparse factors.
class Factor {
 public:
  void resize(int rows, int max_updates, bool sparse);

  /// Factors B from scratch; the order of `head` may change. If columns depend on others,
  /// `singular` lists them, and the result is false.
  bool factorise(const Model& model, std::vector<int>& head, double singular_tolerance);
  const std::vector<Replacement>& singular() const { return singular_; }

  /// Solves B z = a. Overwrites `a`, which is ordered by rows; z is ordered by positions.
  void ftran(double* a, double* z) const;
  /// The same for a column that `update` may then take into the basis.
  void ftran_entering(double* a, double* z);
  /// Solves B'y = c. Overwrites `c`, which is ordered by positions; y is ordered by rows.
  void btran(double* c, double* y) const;
  /// Row `position` of B^-1. Overwrites `c`, which is ordered by positions.
  void row(int position, double* c, double* y) const;
  /// Replaces the column at `position` by a column a with B^-1 a = alpha.
  void update(int position, const double* alpha);
  int updates() const { return updates_; }

 private:
  struct Pivot {
    int row, position, begin, end;
    double inverse;
  };
  void peel(const Model& model, double singular_tolerance);
  void peel_columns(const Model& model, double singular_tolerance);
  void peel_rows(const Model& model);
  void load_kernel(const Model& model);
  bool factorise_kernel(double singular_tolerance);
  void take_pivot(std::vector<Pivot>& list, int row, int position, double v);
  void solve_kernel(double* a, double* z) const;
  void solve_kernel_transposed(double* c, double* y) const;

  int m_ = 0, updates_ = 0, max_updates_ = 0, k_ = 0;
  bool small_ = false, large_ = false;  // which of `inverse_` and `sparse_` is used, if any
  Inverse inverse_;
  SparseFactor sparse_;
  const Model* model_ = nullptr;
  std::vector<int> begin_, end_;  // entries of the factored column at each position
  std::vector<Pivot> column_pivots_, row_pivots_;
  std::vector<int> kernel_rows_, kernel_positions_;
  std::vector<double> kernel_;  // column-major k×k, L below the diagonal with unit diagonal
  std::vector<double> inverse_diagonal_;
  mutable std::vector<double> work_;
  std::vector<double> etas_;
  std::vector<int> eta_positions_;
  std::vector<Replacement> singular_;
  // peeling
  std::vector<int> row_count_, column_count_, row_sum_, column_sum_, row_start_, row_list_, queue_;
  std::vector<char> row_done_, column_done_;
};

}  // namespace maxwrench::simplex
