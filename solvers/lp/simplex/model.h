#pragma once

#include <vector>

#include "maxwrench/linear_program.h"
#include "solvers/lp/simplex/lines.h"

namespace maxwrench::simplex {

/// From this number of rows on, and up to this share of non-zero entries, a program gets sparse
/// factors, and the simplex uses the methods that pay only there. Single postures have at most a
/// few dozen rows. The programs of trajectories with 695 and 1,162 rows take as many pivots and a
/// third of the time. With more entries, dense factors are faster.
inline constexpr int kSparseRows = 600;
inline constexpr double kSparseDensity = 0.1;

/// The scaled program `min cost'x, [I A] x = b, lower <= x <= upper`. The logical variables 0..m-1
/// come first and are fixed at zero; they give every program a regular basis. Column j of the
/// program is variable m + j. All factors are powers of two, so scaling causes no rounding:
///
///   A_s = R A C,  b_s = t R b,  x_s = t C^-1 x,  cost = -k C c,  lambda = -R y / k.
struct Model {
  int rows = 0, cols = 0, total = 0;
  std::vector<int> start, index;
  std::vector<double> value;
  std::vector<double> b, cost, lower, upper;
  std::vector<char> fixed;
  /// Sparse programs only: the columns that are not fixed, by rows.
  Lines by_rows;
  std::vector<double> row_scale, col_scale;
  double rhs_scale = 1, cost_scale = 1;
  bool scaled = false;
  bool crossing = false;
  bool sparse = false;  ///< whether the program is within the limits above

  /// Copies and scales the program; drops explicit zeros. Returns false if the program is
  /// malformed.
  bool load(const LinearProgram& program);

 private:
  void resize(int new_rows, int new_cols, int entries);
  bool copy(const LinearProgram& program);
  void choose_scales();
  void apply_matrix_scales();
  void apply_vector_scales();
  void scale_costs();
  void copy_by_rows();

  std::vector<double> row_max_, col_max_, row_min_, col_min_;
};

}  // namespace maxwrench::simplex
