#include "solvers/lp/tableau.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

/// How far a row may be missed by rounding, relative to one plus its bounds.
constexpr double kFeasibilityTolerance = 1e-9;
/// What an accepted optimum satisfies its multipliers to.
constexpr double kAccepted = 1e-10;
/// Smaller entries of the tableau, whose pivots are near one, are rounding.
constexpr double kZero = 1e-11;
/// Keeps a row without entries from a division by zero.
constexpr double kTiny = 1e-20;

/// Rows of the tableau are padded to whole chunks, so that the loops over them need no remainder.
constexpr int kChunk = 4;

/// x += a y over n entries, n a multiple of the chunk.
inline void add_multiple(double* __restrict x, double a, const double* __restrict y, int n) {
  for (int i = 0; i < n; i += kChunk) {
    for (int lane = 0; lane < kChunk; ++lane) x[i + lane] += a * y[i + lane];
  }
}

double magnitude(double bound) { return std::isfinite(bound) ? std::abs(bound) : 0; }

}  // namespace

void Tableau::resize(int rows, int columns) {
  if (rows == rows_ && columns == columns_) return;
  rows_ = rows;
  columns_ = columns;
  stride_ = (columns + kChunk - 1) / kChunk * kChunk;
  G_.assign(static_cast<std::size_t>(stride_) * rows, 0);
  T_.assign(static_cast<std::size_t>(stride_) * (rows + 1), 0);
  dependent_.assign(rows, {});
  basis_.assign(columns, {});
  value_.assign(rows, 0);
  side_.assign(stride_, 1);
  ratio_.assign(stride_, 0);
  for (std::vector<double>* v : {&point_, &y_, &slack_}) v->assign(rows + columns, 0);
  low.resize(rows + columns);
  high.resize(rows + columns);
  c.resize(columns);
  x.resize(columns);
  multipliers.resize(rows);
}

/// How far a row is violated beyond its slack, squared over its squared norm; negative if it holds.
double Tableau::excess(int i) const {
  const Line& line = dependent_[i];
  const double missed = std::max(value_[i] - line.high, line.low - value_[i]) - line.slack;
  return missed * std::abs(missed) * line.weight;
}

/// Dependent row i enters the basis at position j, whose row becomes dependent. y is exchanged as
/// the rows are.
void Tableau::exchange(int i, int j) {
  double* const pivot = T(i);
  const double inverse = 1 / pivot[j];
  for (int k = 0; k < stride_; ++k) pivot[k] *= -inverse;
  // Column j is written last: a processor waits when it loads a whole chunk just after a part of it
  // was stored.
  for (int other = 0; other <= rows_; ++other) {
    if (other == i) continue;
    double* const row = T(other);
    const double factor = row[j];
    add_multiple(row, factor, pivot, stride_);
    row[j] = factor * inverse;
  }
  pivot[j] = inverse;
  std::swap(dependent_[i], basis_[j]);
}

/// Position j of the basis moves by `step`.
void Tableau::move(int j, double step) {
  for (int i = 0; i < rows_; ++i) value_[i] += step * T(i)[j];
}

/// The unit rows as far as they have two finite bounds, for the others rows that do, the largest
/// entry of their column each time. False if there are no such rows.
bool Tableau::start() {
  std::copy(G_.begin(), G_.end(), T_.begin());
  std::copy(c.data(), c.data() + columns_, T(rows_));
  for (int row = 0; row < rows_ + columns_; ++row) {
    Line& line = row < rows_ ? dependent_[row] : basis_[row - rows_];
    const double size = std::max(magnitude(low[row]), magnitude(high[row]));
    slack_[row] = kFeasibilityTolerance * (1 + size);
    line = {row, low[row], high[row], slack_[row], 1};
    if (line.low > line.high + line.slack) return false;
  }
  for (int i = 0; i < rows_; ++i) {
    double sums[kChunk] = {};
    for (int j = 0; j < stride_; j += kChunk) {
      for (int lane = 0; lane < kChunk; ++lane) sums[lane] += T(i)[j + lane] * T(i)[j + lane];
    }
    dependent_[i].weight = 1 / (sums[0] + sums[1] + (sums[2] + sums[3]) + kTiny);
  }
  for (int j = 0; j < columns_; ++j) {
    if (std::isfinite(basis_[j].high - basis_[j].low)) continue;
    int best = -1;
    double largest = kZero;
    for (int i = 0; i < rows_; ++i) {
      if (std::abs(T(i)[j]) <= largest) continue;
      if (!std::isfinite(dependent_[i].high - dependent_[i].low)) continue;
      largest = std::abs(T(i)[j]);
      best = i;
    }
    if (best < 0) return false;
    exchange(best, j);
  }
  for (int j = 0; j < columns_; ++j) {
    side_[j] = T(rows_)[j] >= 0 ? 1 : -1;
    ratio_[j] = bound(j);
  }
  for (int i = 0; i < rows_; ++i) {
    double sum = 0;
    for (int j = 0; j < columns_; ++j) sum += T(i)[j] * ratio_[j];
    value_[i] = sum;
  }
  return true;
}

/// The dependent row that is violated most, in units of its own size; -1 if none is. `first`: the
/// violated one of lowest index instead, which cannot cycle.
int Tableau::violated(bool first) const {
  int worst = -1;
  double most = 0;
  for (int i = 0; i < rows_; ++i) {
    double missed = excess(i);
    if (first && missed > 0) missed = 1.0 / (1 + dependent_[i].row);
    worst = missed > most ? i : worst;
    most = std::max(missed, most);
  }
  return worst;
}

/// The dual ratio test. As the multiplier of dependent row i grows, those of the basis reach zero
/// one by one; such a row flips to its other bound, which shortens the gap that row i has to close,
/// until the next flip would more than close it. Returns the position that leaves, or -1 if all
/// flips leave a gap: then no x satisfies the rows.
int Tableau::leaving(int i, double& gap, bool first) {
  const double side = gap > 0 ? 1 : -1;
  const double* const y = T(rows_);
  const double* const row = T(i);
  // No branches here and below: which positions block is a matter of chance.
  for (int j = 0; j < stride_; ++j) {
    const double a = side * side_[j] * row[j];
    const double ratio = std::max(side_[j] * y[j], 0.0) / a;
    ratio_[j] = a > kZero ? ratio : kInfinity;
  }
  while (true) {
    double least = kInfinity;
    for (int j = 0; j < columns_; ++j) least = std::min(least, ratio_[j]);
    if (least == kInfinity) return -1;
    const int next = first_of(least, i, first);
    const double step = side_[next] * (basis_[next].low - basis_[next].high);
    const double left = gap + row[next] * step;
    if (!(side * left > dependent_[i].slack)) return next;
    move(next, step);
    side_[next] = -side_[next];
    ratio_[next] = kInfinity;
    gap = left;
  }
}

/// Of the positions whose multipliers reach zero together: the largest pivot is safest, the lowest
/// index cannot cycle.
int Tableau::first_of(double ratio, int i, bool first) const {
  int best = 0;
  while (ratio_[best] != ratio) ++best;
  for (int j = best + 1; j < columns_; ++j) {
    if (ratio_[j] != ratio) continue;
    const bool before =
        first ? basis_[j].row < basis_[best].row : std::abs(T(i)[j]) > std::abs(T(i)[best]);
    if (before) best = j;
  }
  return best;
}

Tableau::Outcome Tableau::solve() {
  iterations = 0;
  if (!start()) return Outcome::kUndecided;
  const int patience = 10 + 3 * (rows_ + columns_);
  const int limit = 10 * patience;
  while (true) {
    const bool first = iterations > patience;
    const int i = violated(first);
    if (i < 0) {
      fill();
      if (optimum_holds()) return Outcome::kOptimal;
      refine();
      return optimum_holds() ? Outcome::kOptimal : Outcome::kUndecided;
    }
    if (++iterations > limit) return Outcome::kUndecided;
    const Line& line = dependent_[i];
    const double side = value_[i] > line.high ? 1 : -1;
    const double target = side > 0 ? line.high : line.low;
    double gap = value_[i] - target;
    const int j = leaving(i, gap, first);
    if (j < 0) return prove_contradiction(i, side) ? Outcome::kInfeasible : Outcome::kUndecided;
    const double step = (target - value_[i]) / T(i)[j];
    const double left = bound(j) + step;
    move(j, step);
    exchange(i, j);
    value_[i] = left;
    side_[j] = side;
  }
}

/// x and the multipliers as the tableau has them.
void Tableau::fill() {
  for (int j = 0; j < columns_; ++j) {
    point_[basis_[j].row] = bound(j);
    y_[basis_[j].row] = T(rows_)[j];
  }
  for (int i = 0; i < rows_; ++i) {
    point_[dependent_[i].row] = value_[i];
    y_[dependent_[i].row] = 0;
  }
  std::copy(point_.begin() + rows_, point_.begin() + rows_ + columns_, x.data());
  std::copy(y_.begin(), y_.begin() + rows_, multipliers.data());
}

/// One step of iterative refinement by G.
void Tableau::refine() {
  // What the rows of G in the basis miss of their bounds moves the dependent columns of x.
  for (int j = 0; j < columns_; ++j) {
    if (basis_[j].row >= rows_) continue;
    double missed = bound(j);
    for (int k = 0; k < columns_; ++k) missed -= given(basis_[j].row, k) * x[k];
    for (int i = 0; i < rows_; ++i) {
      if (dependent_[i].row >= rows_) value_[i] += T(i)[j] * missed;
    }
  }
  // c less what the multipliers give vanishes on the dependent columns.
  for (int i = 0; i < rows_; ++i) {
    const int column = dependent_[i].row - rows_;
    if (column < 0) continue;
    double missed = c[column];
    for (int row = 0; row < rows_; ++row) missed -= given(row, column) * multipliers[row];
    for (int j = 0; j < columns_; ++j) {
      if (basis_[j].row < rows_) T(rows_)[j] += T(i)[j] * missed;
    }
  }
  fill();
}

/// Whether all rows of [G; I] hold and each either rests on the bound that its multiplier asks for
/// or has none. The multiplier of a unit row is what c leaves for its column.
bool Tableau::optimum_holds() {
  std::copy(c.data(), c.data() + columns_, y_.begin() + rows_);
  double scale = 0;
  for (int i = 0; i < rows_; ++i) {
    const double* const row = &G_[static_cast<std::size_t>(i) * stride_];
    double value = 0;
    for (int k = 0; k < columns_; ++k) {
      value += row[k] * x[k];
      y_[rows_ + k] -= multipliers[i] * row[k];
    }
    point_[i] = value;
    scale = std::max(scale, std::abs(multipliers[i]));
  }
  for (int k = 0; k < columns_; ++k) {
    scale = std::max({scale, std::abs(c[k]), std::abs(y_[rows_ + k])});
  }
  if (!std::isfinite(scale)) return false;
  bool holds = true;
  for (int row = 0; row < rows_ + columns_; ++row) {
    const double slack = 2 * slack_[row];
    const double value = point_[row];
    const double rest = y_[row] > 0 ? high[row] : low[row];
    const double missed = std::max(std::min(std::abs(value - rest), 1.0) - slack, 0.0);
    holds &= value <= high[row] + slack;
    holds &= value >= low[row] - slack;
    holds &= std::abs(y_[row]) * missed <= kAccepted * scale;
  }
  return holds;
}

/// Dependent row i less sum T_ij times the rows of the basis vanishes, and the bounds of the latter
/// keep it away from its own by the gap that the ratio test left. False if it does not vanish.
bool Tableau::prove_contradiction(int i, double side) {
  multipliers.setZero();
  const auto set = [&](int row, double value) {
    if (row < rows_) multipliers[row] = value;
  };
  set(dependent_[i].row, side);
  for (int j = 0; j < columns_; ++j) set(basis_[j].row, -side * T(i)[j]);
  const auto vanishes = [&](int column, double own) {
    double sum = own;
    double size = std::abs(own);
    for (int row = 0; row < rows_; ++row) {
      const double term = given(row, column) * multipliers[row];
      sum += term;
      size += std::abs(term);
    }
    return std::abs(sum) <= kAccepted * size;
  };
  for (int k = 0; k < rows_; ++k) {
    const int column = dependent_[k].row - rows_;
    if (column >= 0 && !vanishes(column, k == i ? side : 0)) return false;
  }
  for (int j = 0; j < columns_; ++j) {
    const int column = basis_[j].row - rows_;
    if (column >= 0 && !vanishes(column, -side * T(i)[j])) return false;
  }
  return true;
}

}  // namespace maxwrench
