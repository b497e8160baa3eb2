#pragma once

#include <vector>

#include "solvers/lp/simplex/model.h"

namespace maxwrench::simplex {

/// A column of the basis that depends on the others, and a row left without a pivot.
struct Replacement {
  int position, row;
};

/// The explicit inverse of a small basis matrix. A row of it needs no computation, and a product is
/// a few contiguous additions. Below about 24 rows this is faster than triangular factors.
class Inverse {
 public:
  void resize(int rows);

  /// Inverts by exchanging one column of the identity after the other, columns with a single entry
  /// first. Reorders the columns of `head` by their pivot rows. Lists dependent columns in
  /// `singular`.
  bool invert(const Model& model, std::vector<int>& head, double singular_tolerance,
              std::vector<Replacement>& singular);
  void ftran(const double* a, double* z) const;
  void btran(const double* c, double* y) const;
  void row(int position, double* y) const;
  void update(int position, const double* alpha);

 private:
  bool place(int variable, int row, std::vector<int>& head);

  int m_ = 0;
  std::vector<double> inverse_;  // column-major m×m
  std::vector<double> alpha_;
  std::vector<int> pending_;
  std::vector<char> taken_;
};

}  // namespace maxwrench::simplex
