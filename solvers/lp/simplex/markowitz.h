#pragma once

#include <vector>

#include "solvers/lp/simplex/inverse.h"
#include "solvers/lp/simplex/lines.h"
#include "solvers/lp/simplex/model.h"

namespace maxwrench::simplex {

/// Gaussian elimination of a sparse basis matrix B that chooses its pivots by Markowitz' rule with
/// threshold pivoting: among the entries of at least a tenth of the largest in their row, it looks
/// for the one that causes the least fill-in, (row count - 1) (column count - 1) new entries at
/// most. Columns and rows with a single entry come first, because they cause none.
///
/// Step k eliminates `rows[k]` and `positions[k]`. With rows and columns in this order, B = L U. L
/// has a unit diagonal, and U the diagonal `pivots`; neither diagonal is stored in the lines.
class Markowitz {
 public:
  void resize(int rows);
  /// Lists the columns without an acceptable pivot in `singular`, with the rows that remain; the
  /// result is false if there are any, and then L and U are not complete.
  bool factorise(const Model& model, const std::vector<int>& head, double singular_tolerance,
                 std::vector<Replacement>& singular);

  std::vector<int> rows, positions;
  std::vector<double> pivots;
  Lines l_columns, u_rows;  // by steps

 private:
  struct Entry {
    int position;
    double value;
  };
  /// Lists of the remaining rows or columns by their number of entries.
  struct Buckets {
    std::vector<int> first, next, previous, bucket;
    void resize(int count);
    void clear();
    void remove(int item);
    void move(int item, int count);
  };
  struct Choice {
    int row = -1, position = -1;
    double cost = 0, size = 0;
  };
  void load(const Model& model, const std::vector<int>& head);
  bool choose(Choice& best);
  bool try_column(int position, Choice& best);
  bool try_row(int row, Choice& best);
  double largest_of_row(int row);
  void eliminate(int row, int position);
  void subtract_pivot_row(int row, double factor);
  static void erase(std::vector<int>& list, int item);
  void renumber();

  int m_ = 0;
  double singular_tolerance_ = 0;
  std::vector<std::vector<Entry>> rows_;
  std::vector<std::vector<int>> columns_;  // the rows of the entries
  Buckets row_buckets_, column_buckets_;
  std::vector<double> row_largest_;  // negative: not known
  std::vector<double> work_;         // the pivot row by positions
  std::vector<char> in_pivot_row_;
  std::vector<Entry> pivot_row_;
  std::vector<int> step_;
};

}  // namespace maxwrench::simplex
