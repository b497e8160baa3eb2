#include "solvers/lp/tableau.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

/// How far a row may be missed by rounding, relative to one plus its bounds.
constexpr double kFeasibilityTolerance = 1e-9;
/// What an accepted optimum satisfies its rows and its multipliers to.
constexpr double kAccepted = 1e-10;
/// Smaller entries of the tableau, whose pivots are near one, are rounding.
constexpr double kZero = 1e-11;

/// Columns of the tableau are padded to whole chunks, so that the loops over them need no
/// remainder.
constexpr int kChunk = 4;

/// x += a y over n entries, n a multiple of the chunk.
inline void add_multiple(double* __restrict x, double a, const double* __restrict y, int n) {
  for (int i = 0; i < n; i += kChunk) {
    for (int lane = 0; lane < kChunk; ++lane) x[i + lane] += a * y[i + lane];
  }
}

/// Keeps a row without entries from a division by zero.
constexpr double kTiny = 1e-20;

double magnitude(double bound) { return std::isfinite(bound) ? std::abs(bound) : 0; }

}  // namespace

void Tableau::resize(int rows, int columns) {
  if (rows == rows_ && columns == columns_) return;
  rows_ = rows;
  columns_ = columns;
  total_ = rows + columns;
  stride_ = (total_ + kChunk - 1) / kChunk * kChunk;
  const std::size_t size = static_cast<std::size_t>(stride_) * columns;
  G_.assign(size, 0);
  T_.assign(size, 0);
  for (int j = 0; j < columns; ++j) entry(rows + j, j) = 1;
  value_.assign(stride_, 0);
  slack_.assign(total_, 0);
  weight_.assign(total_, 1);
  in_basis_.assign(total_, 0);
  r_.assign(columns, 0);
  side_.assign(columns, 1);
  work_.assign(columns, 0);
  candidates_.assign(columns, 0);
  basis.assign(columns, -1);
  low.resize(total_);
  high.resize(total_);
  for (Eigen::VectorXd* v : {&c, &w, &y}) v->resize(columns);
}

/// How far a row is violated beyond its slack, over the norm of its gradient; negative if it holds.
double Tableau::excess(int row) const {
  const double missed = std::max(value_[row] - high[row], low[row] - value_[row]);
  return (missed - slack_[row]) * weight_[row];
}

double Tableau::violation(int row) const {
  const double above = value_[row] - high[row];
  const double below = value_[row] - low[row];
  return above > slack_[row] ? above : below < -slack_[row] ? below : 0;
}

/// Row enters the basis at position `column`; y follows the same elimination as T.
void Tableau::pivot(int row, int column) {
  double* const pivot_column = &T_[column * stride_];
  const double inverse = 1 / pivot_column[row];
  for (int i = 0; i < stride_; ++i) pivot_column[i] *= inverse;
  y[column] *= inverse;
  for (int j = 0; j < columns_; ++j) {
    if (j == column) continue;
    double* const other = &T_[j * stride_];
    const double factor = other[row];
    if (factor == 0) continue;
    add_multiple(other, -factor, pivot_column, stride_);
    other[row] = 0;
    y[j] -= factor * y[column];
  }
  pivot_column[row] = 1;
  if (basis[column] >= 0) in_basis_[basis[column]] = 0;
  basis[column] = row;
  in_basis_[row] = 1;
}

void Tableau::move(int column, double step) {
  add_multiple(value_.data(), step, &T_[column * stride_], stride_);
}

/// The unit rows if all have two finite bounds; otherwise k rows that do, the largest entry of the
/// next column each time. Each rests on the bound that its multiplier asks for. False if there are
/// no such rows.
bool Tableau::start() {
  std::copy(G_.begin(), G_.end(), T_.begin());
  std::fill(in_basis_.begin(), in_basis_.end(), 0);
  std::fill(basis.begin(), basis.end(), -1);
  std::fill(value_.begin(), value_.end(), 0.0);
  y = c;
  for (int i = 0; i < rows_; ++i) weight_[i] = 0;
  for (int j = 0; j < columns_; ++j) {
    for (int i = 0; i < rows_; ++i) weight_[i] += given(i, j) * given(i, j);
  }
  for (int i = 0; i < rows_; ++i) weight_[i] = 1 / std::sqrt(weight_[i] + kTiny);
  bool boxed = true;
  for (int i = rows_; i < total_; ++i) boxed = boxed && std::isfinite(high[i] - low[i]);
  for (int j = 0; j < columns_ && boxed; ++j) {
    basis[j] = rows_ + j;
    in_basis_[rows_ + j] = 1;
  }
  for (int j = 0; j < columns_ && !boxed; ++j) {
    int best = -1;
    double largest = kZero;
    for (int i = 0; i < total_; ++i) {
      if (in_basis_[i] || std::abs(at(i, j)) <= largest) continue;
      if (!std::isfinite(high[i] - low[i])) continue;
      largest = std::abs(at(i, j));
      best = i;
    }
    if (best < 0) return false;
    pivot(best, j);
  }
  for (int j = 0; j < columns_; ++j) {
    const int row = basis[j];
    side_[j] = y[j] >= 0 ? 1 : -1;
    r_[j] = y[j] >= 0 ? high[row] : low[row];
    move(j, r_[j]);
  }
  return true;
}

/// The row that is violated most, in units of its own size; -1 if none is. `first`: the violated
/// one of lowest index instead, which cannot cycle.
int Tableau::violated_row(bool first) const {
  double worst = 0;
  for (int i = 0; i < total_; ++i) worst = std::max(worst, excess(i));
  if (worst == 0) return -1;
  int row = 0;
  while (first ? excess(row) <= 0 : excess(row) != worst) ++row;
  return row;
}

/// The dual ratio test. As the multiplier of `row` grows, those of the basis reach zero one by one;
/// such a row flips to its other bound, which shortens the gap that `row` has to close, until the
/// next flip would more than close it. Returns the position that leaves, or -1 if all flips leave a
/// gap: then no w satisfies the rows.
int Tableau::leaving(int row, double& gap, bool first) {
  const double side = gap > 0 ? 1 : -1;
  // No branches here: which columns block is a matter of chance.
  int count = 0;
  for (int j = 0; j < columns_; ++j) {
    const double a = side * side_[j] * at(row, j);
    work_[j] = std::max(side_[j] * y[j], 0.0) / a;
    candidates_[count] = j;
    count += a > kZero;
  }
  while (count > 0) {
    int best = 0;
    for (int i = 1; i < count; ++i) {
      if (comes_before(candidates_[i], candidates_[best], row, first)) best = i;
    }
    const int next = candidates_[best];
    candidates_[best] = candidates_[--count];
    const int out = basis[next];
    const double step = side_[next] * (low[out] - high[out]);
    const double left = gap + at(row, next) * step;
    if (!(side * left > slack_[row])) return next;
    move(next, step);
    side_[next] = -side_[next];
    r_[next] = side_[next] > 0 ? high[out] : low[out];
    gap = left;
  }
  return -1;
}

/// Whether the multiplier at position i reaches zero before that at j; of two that tie the larger
/// pivot is safer, and the lower index cannot cycle.
bool Tableau::comes_before(int i, int j, int row, bool first) const {
  if (work_[i] != work_[j]) return work_[i] < work_[j];
  if (first) return basis[i] < basis[j];
  return std::abs(at(row, i)) > std::abs(at(row, j));
}

Tableau::Outcome Tableau::solve() {
  iterations = 0;
  for (int i = 0; i < total_; ++i) {
    slack_[i] = kFeasibilityTolerance * (1 + std::max(magnitude(low[i]), magnitude(high[i])));
    if (low[i] > high[i] + slack_[i]) return Outcome::kUndecided;
  }
  if (!start()) return Outcome::kUndecided;
  const int patience = 10 + 3 * (rows_ + columns_);
  const int limit = 10 * patience;
  while (true) {
    const bool first = iterations > patience;
    const int row = violated_row(first);
    if (row < 0) {
      refine();
      return optimum_holds() ? Outcome::kOptimal : Outcome::kUndecided;
    }
    if (++iterations > limit || in_basis_[row]) return Outcome::kUndecided;
    double gap = violation(row);
    const int column = leaving(row, gap, first);
    if (column < 0) {
      return contradiction_holds(row) ? Outcome::kInfeasible : Outcome::kUndecided;
    }
    const bool to_upper = gap > 0;
    pivot(row, column);
    side_[column] = to_upper ? 1 : -1;
    r_[column] = to_upper ? high[row] : low[row];
    move(column, r_[column] - value_[row]);
  }
}

/// One step of iterative refinement for w and y; the unit rows of the basis need none.
void Tableau::refine() {
  for (int j = 0; j < columns_; ++j) w[j] = value_[rows_ + j];
  for (int i = 0; i < columns_; ++i) {
    work_[i] = r_[i];
    if (basis[i] >= rows_) {
      work_[i] -= w[basis[i] - rows_];
      continue;
    }
    for (int j = 0; j < columns_; ++j) work_[i] -= given(basis[i], j) * w[j];
  }
  for (int i = 0; i < columns_; ++i) {
    if (work_[i] == 0) continue;
    for (int j = 0; j < columns_; ++j) w[j] += at(rows_ + j, i) * work_[i];
  }
  dual_residual();
  for (int i = 0; i < columns_; ++i) {
    const double* const inverse = &T_[i * stride_ + rows_];
    double sum = 0;
    for (int j = 0; j < columns_; ++j) sum += inverse[j] * work_[j];
    y[i] += sum;
    if (basis[i] >= rows_) w[basis[i] - rows_] = r_[i];
  }
}

/// work_ = c - [G; I]_B'y
void Tableau::dual_residual() {
  for (int j = 0; j < columns_; ++j) work_[j] = c[j];
  for (int i = 0; i < columns_; ++i) {
    if (basis[i] >= rows_) {
      work_[basis[i] - rows_] -= y[i];
      continue;
    }
    for (int j = 0; j < columns_; ++j) work_[j] -= given(basis[i], j) * y[i];
  }
}

bool Tableau::optimum_holds() {
  const double scale = y.cwiseAbs().maxCoeff();
  if (!std::isfinite(scale)) return false;
  for (int i = 0; i < columns_; ++i) {
    const bool fixed = low[basis[i]] == high[basis[i]];
    if (!fixed && side_[i] * y[i] < -kAccepted * scale) return false;
  }
  dual_residual();
  for (int j = 0; j < columns_; ++j) {
    if (!(std::abs(work_[j]) <= kAccepted * (std::abs(c[j]) + scale))) return false;
  }
  // Twice the slack: w was refined after the last look at the rows.
  const auto holds = [&](int row, double value) {
    return value <= high[row] + 2 * slack_[row] && value >= low[row] - 2 * slack_[row];
  };
  for (int i = 0; i < rows_; ++i) {
    double sum = 0;
    for (int j = 0; j < columns_; ++j) sum += given(i, j) * w[j];
    if (!holds(i, sum)) return false;
  }
  for (int j = 0; j < columns_; ++j) {
    if (!holds(rows_ + j, w[j])) return false;
  }
  return true;
}

/// Whether the row less sum T_row,i times the basic rows vanishes, so that the bounds of the basic
/// rows bound this one too: the ratio test found that they keep it away from its own.
bool Tableau::contradiction_holds(int row) const {
  for (int j = 0; j < columns_; ++j) {
    double sum = given(row, j);
    double size = std::abs(sum);
    for (int i = 0; i < columns_; ++i) {
      const double term = at(row, i) * given(basis[i], j);
      sum -= term;
      size += std::abs(term);
    }
    if (std::abs(sum) > kAccepted * size) return false;
  }
  return true;
}

}  // namespace maxwrench
