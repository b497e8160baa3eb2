#include "solvers/lp/exact/rational_elimination.h"

#include <algorithm>
#include <set>

namespace maxwrench {
namespace {

class RationalElimination {
 public:
  RationalElimination(std::vector<SparseRow> rows, RationalVector rhs)
      : rows_(std::move(rows)), rhs_(std::move(rhs)), users_(rows_.size()) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (const auto& entry : rows_[i]) users_[at(entry.first)].insert(static_cast<int>(i));
    }
  }

  /// Returns nothing if M is singular.
  std::optional<RationalVector> solve() {
    std::vector<std::pair<int, int>> pivots;
    std::vector<char> done(rows_.size());
    for (std::size_t step = 0; step < rows_.size(); ++step) {
      int row = -1;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (done[i]) continue;
        if (row < 0 || rows_[i].size() < rows_[at(row)].size()) row = static_cast<int>(i);
      }
      if (rows_[at(row)].empty()) return {};
      const int column = rarest(rows_[at(row)]);
      done[at(row)] = 1;
      pivots.emplace_back(row, column);
      eliminate(row, column, done);
    }
    return substitute(pivots);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  int rarest(const SparseRow& row) const {
    return std::min_element(row.begin(), row.end(),
                            [&](const auto& a, const auto& b) {
                              return users_[at(a.first)].size() < users_[at(b.first)].size();
                            })
        ->first;
  }

  void eliminate(int row, int column, const std::vector<char>& done) {
    const SparseRow& pivot = rows_[at(row)];
    for (const auto& entry : pivot) users_[at(entry.first)].erase(row);
    const std::set<int> others = users_[at(column)];
    for (const int other : others) {
      if (done[at(other)]) continue;
      const mpq_class factor = rows_[at(other)][column] / pivot.at(column);
      for (const auto& [j, value] : pivot) {
        mpq_class& to = rows_[at(other)][j];
        to -= factor * value;
        if (to == 0) {
          rows_[at(other)].erase(j);
          users_[at(j)].erase(other);
        } else {
          users_[at(j)].insert(other);
        }
      }
      rhs_[at(other)] -= factor * rhs_[at(row)];
    }
  }

  RationalVector substitute(const std::vector<std::pair<int, int>>& pivots) const {
    RationalVector x(rows_.size());
    for (auto it = pivots.rbegin(); it != pivots.rend(); ++it) {
      const auto& [row, column] = *it;
      mpq_class sum = rhs_[at(row)];
      for (const auto& [j, value] : rows_[at(row)]) {
        if (j != column) sum -= value * x[at(j)];
      }
      x[at(column)] = sum / rows_[at(row)].at(column);
    }
    return x;
  }

  std::vector<SparseRow> rows_;
  RationalVector rhs_;
  std::vector<std::set<int>> users_;  ///< for each column, the remaining rows that contain it
};

}  // namespace

std::optional<RationalVector> solve_rational(std::vector<SparseRow> rows, RationalVector rhs) {
  return RationalElimination(std::move(rows), std::move(rhs)).solve();
}

}  // namespace maxwrench
