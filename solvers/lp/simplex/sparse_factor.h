#pragma once

#include <vector>

#include "solvers/lp/simplex/markowitz.h"

namespace maxwrench::simplex {

/// Sparse factors of a large basis matrix, B = L T_1 ... T_u U, where each T_i belongs to one
/// update since L and U were computed:
///
///   T = I + s w',   s = (L T_1 ... T_(i-1))^-1 a - U e_p,   w = U^-T e_p
///
/// for a column a that replaces the one at position p. So L and U never change, and s and w are
/// sparser than B^-1 a, which the product form stores. (The middle product form: Q. Huangfu,
/// J. A. J. Hall, "Novel update techniques for the revised simplex method", 2015.)
class SparseFactor {
 public:
  void resize(int rows, int max_updates);
  bool factorise(const Model& model, const std::vector<int>& head, double singular_tolerance,
                 std::vector<Replacement>& singular);
  /// Solves B z = a. `a` is ordered by rows, z by positions.
  void ftran(const double* a, double* z) const;
  /// The same for a column that may enter: keeps what `update` needs.
  void ftran_entering(const double* a, double* z);
  /// Solves B'y = c. `c` is ordered by positions, y by rows.
  void btran(const double* c, double* y) const;
  /// Row `position` of B^-1.
  void row(int position, double* y) const;
  /// Replaces the column at `position` by the last column a of `ftran_entering`, where `pivot` is
  /// the entry of B^-1 a at this position.
  void update(int position, double pivot);

 private:
  struct Update {
    int s_end, w_end;
    double inverse;
  };
  void solve_lower(const double* a) const;
  void solve_upper(double* z) const;
  void solve_upper_transposed(int first) const;
  void solve_lower_transposed(double* y) const;

  int m_ = 0;
  Markowitz lu_;
  Lines l_rows_, u_columns_;
  std::vector<double> inverse_;    // of the pivots
  std::vector<int> step_;          // of each position
  mutable std::vector<double> x_;  // by steps
  std::vector<double> spike_;
  std::vector<Update> updates_;
  std::vector<int> s_index_, w_index_;
  std::vector<double> s_value_, w_value_;
};

}  // namespace maxwrench::simplex
