#include "solvers/wrench/tableau.h"

#include <algorithm>
#include <cmath>

#include "solvers/wrench/padded.h"

namespace maxwrench {
namespace {

/// The violation of a row that rounding may cause, relative to one plus its bounds.
constexpr double kFeasibilityTolerance = 1e-9;
/// Smaller entries of the tableau, whose pivots are near one, are rounding errors.
constexpr double kZero = 1e-11;
/// The least share of a row's squared norm that is accepted as first pivot.
constexpr double kSmallPivot = 1e-8;
/// Prevents a division by zero for a row without entries.
constexpr double kLeastDivisor = 1e-20;

/// The number of scores that are compared together.
constexpr int kScores = 4;

double magnitude(double bound) { return std::isfinite(bound) ? std::abs(bound) : 0; }

}  // namespace

void Tableau::Lines::resize(int count) {
  row.assign(count, 0);
  for (std::vector<double>* v : {&low, &high, &slack, &weight, &tight}) v->assign(count, 0);
}

inline void Tableau::Lines::exchange(int i, Lines& other, int j) {
  std::swap(row[i], other.row[j]);
  std::swap(low[i], other.low[j]);
  std::swap(high[i], other.high[j]);
  std::swap(slack[i], other.slack[j]);
  std::swap(weight[i], other.weight[j]);
  std::swap(tight[i], other.tight[j]);
}

void Tableau::resize(int rows, int columns) {
  if (rows == rows_ && columns == columns_) return;
  rows_ = rows;
  columns_ = columns;
  stride_ = padded(columns);
  G_.assign(static_cast<std::size_t>(stride_) * rows, 0);
  T_.assign(static_cast<std::size_t>(stride_) * (rows + 1), 0);
  dependent_.resize(rows);
  basis_.resize(columns);
  value_.assign(rows, 0);
  score_.assign((rows + kScores - 1) / kScores * kScores, -1);
  used_.reserve(columns + 1);
  side_.assign(stride_, 1);
  ratio_.assign(stride_, 0);
  for (std::vector<double>* v : {&point_, &y_, &slack_}) v->assign(rows + columns, 0);
  low.resize(rows + columns);
  high.resize(rows + columns);
  c.resize(columns);
  x.resize(columns);
  multipliers.resize(rows);
}

/// Dependent row i enters the basis at position j, and the row there becomes dependent. y is
/// updated like the rows.
void Tableau::exchange(int i, int j) {
  double* const pivot = T(i);
  const double inverse = 1 / pivot[j];
  for (int k = 0; k < stride_; ++k) pivot[k] *= -inverse;
  // Column j is written last: a processor stalls if it loads a whole chunk just after a part of it
  // was stored.
  with_length(stride_, [&](auto n) {
    double* row = T_.data();
    for (int other = 0; other <= rows_; ++other, row += n) {
      if (other == i) continue;
      const double factor = row[j];
      add_multiple(row, factor, pivot, n);
      row[j] = factor * inverse;
    }
  });
  pivot[j] = inverse;
  dependent_.exchange(i, basis_, j);
}

/// products_i = sum_j rows_ij factors_j over the f rows and the columns of a tableau.
void Tableau::multiply(const double* __restrict rows, const double* __restrict factors,
                       double* __restrict products) const {
  with_length(stride_, [&](auto n) {
    for (int i = 0; i < rows_; ++i) products[i] = dot(rows + i * n, factors, n);
  });
}

/// Position j of the basis moves by `step`.
void Tableau::move(int j, double step) {
  for (int i = 0; i < rows_; ++i) value_[i] += step * T(i)[j];
}

/// Initialises the rows of G as dependent, and the unit rows as basis.
void Tableau::read() {
  measured_ = false;
  std::copy(G_.begin(), G_.end(), T_.begin());
  std::copy(c.data(), c.data() + columns_, T(rows_));
  for (int row = 0; row < rows_ + columns_; ++row) {
    const double size = std::max(magnitude(low[row]), magnitude(high[row]));
    slack_[row] = kFeasibilityTolerance * (1 + size);
  }
  for (int i = 0; i < rows_; ++i) {
    dependent_.row[i] = i;
    dependent_.low[i] = low[i];
    dependent_.high[i] = high[i];
    dependent_.slack[i] = slack_[i];
  }
  for (int j = 0; j < columns_; ++j) {
    basis_.row[j] = rows_ + j;
    basis_.low[j] = low[rows_ + j];
    basis_.high[j] = high[rows_ + j];
    basis_.slack[j] = slack_[rows_ + j];
  }
}

/// The first row with the highest score, -1 if none is above `least`. It avoids conditional jumps,
/// because the row cannot be predicted.
int Tableau::highest(double least) const {
  double most[kScores] = {least, least, least, least};
  for (std::size_t i = 0; i < score_.size(); i += kScores) {
    for (int pack = 0; pack < kScores; ++pack) {
      most[pack] = score_[i + pack] > most[pack] ? score_[i + pack] : most[pack];
    }
  }
  const double best = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  if (!(best > least)) return -1;
  int row = 0;
  while (score_[row] != best) ++row;
  return row;
}

/// Computes `weight` and `tight` of all rows before the first exchange; many programs need none.
/// Rows of the initial basis are not accepted as pivots once they have left it.
void Tableau::measure() {
  measured_ = true;
  std::fill(basis_.weight.begin(), basis_.weight.end(), 1.0);
  std::fill(basis_.tight.begin(), basis_.tight.end(), 0.0);
  with_length(stride_, [&](auto n) {
    for (int i = 0; i < rows_; ++i) {
      const double* const row = T_.data() + i * n;
      dependent_.weight[i] = 1 / (dot(row, row, n) + kLeastDivisor);
      dependent_.tight[i] = 1 / (dependent_.high[i] - dependent_.low[i] + kLeastDivisor);
    }
  });
}

/// Whether the sign of y_j selects a finite bound; sets side_ to that bound.
bool Tableau::rests(int j) {
  const double y = T(rows_)[j];
  const bool up = y > 0 || (y == 0 && std::isfinite(basis_.high[j]));
  side_[j] = up ? 1 : -1;
  return std::isfinite(bound(j));
}

/// Makes a dual feasible basis. A column without a finite bound for its y is exchanged for the row
/// of G that limits it most, by its two finite bounds. Returns false if there is no such row.
bool Tableau::start() {
  read();
  for (int row = 0; row < rows_ + columns_; ++row) {
    if (low[row] > high[row] + slack_[row]) return false;
  }
  for (int j = 0; j < columns_;) {
    if (rests(j)) {
      ++j;
      continue;
    }
    if (!measured_) measure();
    for (int i = 0; i < rows_; ++i) {
      const double entry = T(i)[j];
      const bool fit = entry * entry * dependent_.weight[i] > kSmallPivot;
      score_[i] = fit ? std::abs(entry) * dependent_.tight[i] : 0;
    }
    const int best = highest(0);
    if (best < 0) return false;
    exchange(best, j);
    j = 0;  // all y have changed
  }
  std::fill(ratio_.begin(), ratio_.end(), 0.0);
  for (int j = 0; j < columns_; ++j) ratio_[j] = bound(j);
  multiply(T_.data(), ratio_.data(), value_.data());
  return true;
}

/// The dependent row with the largest violation, in units of its own size; -1 if none is violated.
/// With `first`, the violated row of lowest index, which cannot cycle.
int Tableau::violated(bool first) {
  bool any = false;
  for (int i = 0; i < rows_; ++i) {
    const double over = value_[i] - dependent_.high[i], under = dependent_.low[i] - value_[i];
    const double missed = (over > under ? over : under) - dependent_.slack[i];
    score_[i] = missed * std::abs(missed);
    any |= missed > 0;
  }
  if (!any) return -1;
  if (!measured_) measure();
  for (int i = 0; i < rows_; ++i) score_[i] *= dependent_.weight[i];
  if (first) {
    for (int i = 0; i < rows_; ++i) {
      if (score_[i] > 0) score_[i] = 1.0 / (1 + dependent_.row[i]);
    }
  }
  return highest(0);
}

/// The dual ratio test. As the multiplier of dependent row i grows, those of the basis reach zero
/// one by one. Such a row flips to its other bound, which shortens the gap that row i must close,
/// until the next flip would more than close it. Returns the position that leaves, or -1 if a gap
/// remains after all flips: then no x satisfies the rows.
int Tableau::leaving(int i, double& gap, bool first) {
  const double side = gap > 0 ? 1 : -1;
  const double* const y = T(rows_);
  const double* const row = T(i);
  // Here and below there are no conditional jumps, because the positions that block cannot be
  // predicted.
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
    const double step = side_[next] * (basis_.low[next] - basis_.high[next]);
    const double left = gap + row[next] * step;
    if (!(side * left > dependent_.slack[i])) return next;
    move(next, step);
    side_[next] = -side_[next];
    ratio_[next] = kInfinity;
    gap = left;
  }
}

/// Of the positions whose multipliers reach zero together, the largest pivot is the safest; the
/// lowest index cannot cycle.
int Tableau::first_of(double ratio, int i, bool first) const {
  int best = 0;
  while (ratio_[best] != ratio) ++best;
  for (int j = best + 1; j < columns_; ++j) {
    if (ratio_[j] != ratio) continue;
    const bool before =
        first ? basis_.row[j] < basis_.row[best] : std::abs(T(i)[j]) > std::abs(T(i)[best]);
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
    const double side = value_[i] > dependent_.high[i] ? 1 : -1;
    const double target = side > 0 ? dependent_.high[i] : dependent_.low[i];
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

}  // namespace maxwrench
