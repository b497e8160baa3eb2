#include <algorithm>
#include <cmath>

#include "solvers/wrench/tableau.h"

// Checks the tableau's result with the given rows.

namespace maxwrench {
namespace {

/// The error that is accepted in conditions on the multipliers, relative to their size.
constexpr double kAccepted = 1e-10;

}  // namespace

/// Sets x and the multipliers from the tableau.
void Tableau::fill() {
  for (int j = 0; j < columns_; ++j) {
    point_[basis_.row[j]] = bound(j);
    y_[basis_.row[j]] = T(rows_)[j];
  }
  for (int i = 0; i < rows_; ++i) {
    point_[dependent_.row[i]] = value_[i];
    y_[dependent_.row[i]] = 0;
  }
  std::copy(point_.begin() + rows_, point_.begin() + rows_ + columns_, x.data());
  std::copy(y_.begin(), y_.begin() + rows_, multipliers.data());
}

/// One step of iterative refinement with G.
void Tableau::refine() {
  // The distances of the basis rows of G from their bounds correct the dependent columns of x.
  for (int j = 0; j < columns_; ++j) {
    if (basis_.row[j] >= rows_) continue;
    double missed = bound(j);
    for (int k = 0; k < columns_; ++k) missed -= given(basis_.row[j], k) * x[k];
    for (int i = 0; i < rows_; ++i) {
      if (dependent_.row[i] >= rows_) value_[i] += T(i)[j] * missed;
    }
  }
  // On the dependent columns, c minus the combination of rows by the multipliers should be zero.
  for (int i = 0; i < rows_; ++i) {
    const int column = dependent_.row[i] - rows_;
    if (column < 0) continue;
    double missed = c[column];
    for (int row = 0; row < rows_; ++row) missed -= given(row, column) * multipliers[row];
    for (int j = 0; j < columns_; ++j) {
      if (basis_.row[j] < rows_) T(rows_)[j] += T(i)[j] * missed;
    }
  }
  fill();
}

/// Whether all rows of [G; I] hold, and each row with a multiplier is on the bound that its sign
/// selects. The multiplier of a unit row is the remainder of c in its column.
bool Tableau::optimum_holds() {
  std::copy(c.data(), c.data() + columns_, y_.begin() + rows_);
  double scale = 0;
  for (int j = 0; j < columns_; ++j) {
    const int row = basis_.row[j];
    if (row >= rows_) continue;
    scale = std::max(scale, std::abs(multipliers[row]));
    for (int k = 0; k < columns_; ++k) y_[rows_ + k] -= multipliers[row] * given(row, k);
  }
  std::fill(ratio_.begin(), ratio_.end(), 0.0);
  std::copy(x.data(), x.data() + columns_, ratio_.begin());
  multiply(G_.data(), ratio_.data(), point_.data());
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

/// Dependent row i minus the sum of T_ij times the rows of the basis is zero, and the bounds of
/// these rows keep row i away from its own bound by the gap that the ratio test left. Returns false
/// if the combination is not zero.
bool Tableau::prove_contradiction(int i, double side) {
  multipliers.setZero();
  used_.clear();
  const auto set = [&](int row, double value) {
    if (row >= rows_) return;
    multipliers[row] = value;
    used_.push_back(row);
  };
  set(dependent_.row[i], side);
  for (int j = 0; j < columns_; ++j) set(basis_.row[j], -side * T(i)[j]);
  const auto vanishes = [&](int column, double own) {
    double sum = own;
    double size = std::abs(own);
    for (const int row : used_) {
      const double term = given(row, column) * multipliers[row];
      sum += term;
      size += std::abs(term);
    }
    return std::abs(sum) <= kAccepted * size;
  };
  for (int k = 0; k < rows_; ++k) {
    const int column = dependent_.row[k] - rows_;
    if (column >= 0 && !vanishes(column, k == i ? side : 0)) return false;
  }
  for (int j = 0; j < columns_; ++j) {
    const int column = basis_.row[j] - rows_;
    if (column >= 0 && !vanishes(column, -side * T(i)[j])) return false;
  }
  return true;
}

}  // namespace maxwrench
