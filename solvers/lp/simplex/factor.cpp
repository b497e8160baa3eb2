#include "solvers/lp/simplex/factor.h"

#include <algorithm>
#include <cmath>

namespace maxwrench::simplex {
namespace {

constexpr int kSmall = 24;

}  // namespace

void Factor::resize(int rows, int max_updates, bool sparse) {
  if (rows == m_ && max_updates == max_updates_ && sparse == large_) return;
  m_ = rows;
  max_updates_ = max_updates;
  small_ = rows <= kSmall;
  singular_.reserve(m_);
  large_ = sparse;
  if (small_) return inverse_.resize(rows);
  if (large_) return sparse_.resize(rows, max_updates);
  for (auto* v : {&begin_, &end_, &row_count_, &column_count_, &row_sum_, &column_sum_, &queue_}) {
    v->resize(m_);
  }
  row_start_.resize(m_ + 1);
  row_done_.resize(m_);
  column_done_.resize(m_);
  column_pivots_.reserve(m_);
  row_pivots_.reserve(m_);
  kernel_rows_.reserve(m_);
  kernel_positions_.reserve(m_);
  kernel_.reserve(static_cast<std::size_t>(m_) * m_);
  work_.resize(m_);
  inverse_diagonal_.resize(m_);
  etas_.resize(static_cast<std::size_t>(m_) * max_updates);
  eta_positions_.resize(max_updates);
}

bool Factor::factorise(const Model& model, std::vector<int>& head, double singular_tolerance) {
  model_ = &model;
  updates_ = 0;
  singular_.clear();
  if (small_) return inverse_.invert(model, head, singular_tolerance, singular_);
  if (large_) return sparse_.factorise(model, head, singular_tolerance, singular_);
  for (int p = 0; p < m_; ++p) {
    begin_[p] = model.start[head[p]];
    end_[p] = model.start[head[p] + 1];
  }
  peel(model, singular_tolerance);
  load_kernel(model);
  return factorise_kernel(singular_tolerance);
}

void Factor::peel(const Model& model, double singular_tolerance) {
  column_pivots_.clear();
  row_pivots_.clear();
  std::fill(row_count_.begin(), row_count_.end(), 0);
  std::fill(row_sum_.begin(), row_sum_.end(), 0);
  std::fill(row_done_.begin(), row_done_.end(), 0);
  std::fill(column_done_.begin(), column_done_.end(), 0);
  int entries = 0;
  for (int p = 0; p < m_; ++p) {
    int sum = 0;
    for (int e = begin_[p]; e < end_[p]; ++e) {
      const int i = model.index[e];
      ++row_count_[i];
      row_sum_[i] += p;
      sum += i;
    }
    column_sum_[p] = sum;
    column_count_[p] = end_[p] - begin_[p];
    entries += column_count_[p];
  }
  if (row_list_.size() < static_cast<std::size_t>(entries)) row_list_.resize(model.index.size());
  int begin = 0;
  for (int i = 0; i < m_; ++i) {
    begin += row_count_[i];
    row_start_[i] = begin;
  }
  row_start_[m_] = begin;
  for (int p = m_ - 1; p >= 0; --p) {
    for (int e = begin_[p]; e < end_[p]; ++e) row_list_[--row_start_[model.index[e]]] = p;
  }
  peel_columns(model, singular_tolerance);
  peel_rows(model);
}

void Factor::take_pivot(std::vector<Pivot>& list, int row, int position, double v) {
  list.push_back({row, position, begin_[position], end_[position], 1 / v});
  row_done_[row] = 1;
  column_done_[position] = 1;
}

/// Removes columns with a single entry in the remaining rows. The sum of such a column's remaining
/// row numbers is its row i.
void Factor::peel_columns(const Model& model, double singular_tolerance) {
  int tail = 0;
  for (int p = 0; p < m_; ++p) {
    if (column_count_[p] == 1) queue_[tail++] = p;
  }
  for (int t = 0; t < tail; ++t) {
    const int p = queue_[t];
    if (column_count_[p] != 1) continue;
    const int i = column_sum_[p];
    double v = 0, largest = 0;
    for (int e = begin_[p]; e < end_[p]; ++e) {
      if (model.index[e] == i) v = model.value[e];
      largest = std::max(largest, std::abs(model.value[e]));
    }
    // A tiny pivot is left to the kernel, which may find that the column is dependent.
    if (std::abs(v) <= singular_tolerance * 100 * largest) continue;
    take_pivot(column_pivots_, i, p, v);
    for (int e = row_start_[i]; e < row_start_[i + 1]; ++e) {
      const int q = row_list_[e];
      if (column_done_[q]) continue;
      column_sum_[q] -= i;
      if (--column_count_[q] == 1) queue_[tail++] = q;
    }
    for (int e = begin_[p]; e < end_[p]; ++e) {
      --row_count_[model.index[e]];
      row_sum_[model.index[e]] -= p;
    }
  }
}

/// Removes rows with a single entry in the remaining columns, at position p. The pivot must not be
/// small in its column, because the other entries are divided by it.
void Factor::peel_rows(const Model& model) {
  int tail = 0;
  for (int i = 0; i < m_; ++i) {
    if (!row_done_[i] && row_count_[i] == 1) queue_[tail++] = i;
  }
  for (int t = 0; t < tail; ++t) {
    const int i = queue_[t];
    if (row_count_[i] != 1) continue;
    const int p = row_sum_[i];
    double v = 0, largest = 0;
    for (int e = begin_[p]; e < end_[p]; ++e) {
      const int r = model.index[e];
      if (r == i) v = model.value[e];
      if (!row_done_[r]) largest = std::max(largest, std::abs(model.value[e]));
    }
    if (std::abs(v) < 0.05 * largest || v == 0) continue;
    take_pivot(row_pivots_, i, p, v);
    for (int e = begin_[p]; e < end_[p]; ++e) {
      const int r = model.index[e];
      if (row_done_[r]) continue;
      row_sum_[r] -= p;
      if (--row_count_[r] == 1) queue_[tail++] = r;
    }
  }
}

void Factor::load_kernel(const Model& model) {
  kernel_rows_.clear();
  kernel_positions_.clear();
  for (int i = 0; i < m_; ++i) {
    if (row_done_[i]) continue;
    row_sum_[i] = static_cast<int>(kernel_rows_.size());  // now the row's place in the kernel
    kernel_rows_.push_back(i);
  }
  for (int p = 0; p < m_; ++p) {
    if (!column_done_[p]) kernel_positions_.push_back(p);
  }
  k_ = static_cast<int>(kernel_rows_.size());
  kernel_.assign(static_cast<std::size_t>(k_) * k_, 0.0);
  for (int c = 0; c < k_; ++c) {
    const int p = kernel_positions_[c];
    double* const column = kernel_.data() + static_cast<std::size_t>(c) * k_;
    for (int e = begin_[p]; e < end_[p]; ++e) {
      const int i = model.index[e];
      if (!row_done_[i]) column[row_sum_[i]] = model.value[e];
    }
  }
}

/// Right-looking elimination. A column without an acceptable pivot is moved to the end and reported
/// with a remaining row.
bool Factor::factorise_kernel(double singular_tolerance) {
  const int k = k_;
  double* const a = kernel_.data();
  int last = k;
  for (int c = 0; c < last;) {
    double* const column = a + static_cast<std::size_t>(c) * k;
    int best = c;
    double largest = 0;
    for (int i = c; i < k; ++i) {
      if (std::abs(column[i]) > largest) largest = std::abs(column[i]), best = i;
    }
    if (!(largest > singular_tolerance)) {
      --last;
      std::swap_ranges(column, column + k, a + static_cast<std::size_t>(last) * k);
      std::swap(kernel_positions_[c], kernel_positions_[last]);
      continue;
    }
    if (best != c) {
      std::swap(kernel_rows_[c], kernel_rows_[best]);
      for (int j = 0; j < k; ++j) {
        std::swap(a[static_cast<std::size_t>(j) * k + c],
                  a[static_cast<std::size_t>(j) * k + best]);
      }
    }
    const double inverse = 1 / column[c];
    inverse_diagonal_[c] = inverse;
    for (int i = c + 1; i < k; ++i) column[i] *= inverse;
    for (int j = c + 1; j < k; ++j) {
      double* const other = a + static_cast<std::size_t>(j) * k;
      const double f = other[c];
      if (f == 0) continue;
      for (int i = c + 1; i < k; ++i) other[i] -= f * column[i];
    }
    ++c;
  }
  for (int c = last; c < k; ++c) singular_.push_back({kernel_positions_[c], kernel_rows_[c]});
  return last == k;
}

void Factor::solve_kernel(double* a, double* z) const {
  const int k = k_;
  double* const w = work_.data();
  for (int t = 0; t < k; ++t) w[t] = a[kernel_rows_[t]];
  for (int c = 0; c < k; ++c) {
    const double f = w[c];
    if (f == 0) continue;
    const double* const column = kernel_.data() + static_cast<std::size_t>(c) * k;
    for (int i = c + 1; i < k; ++i) w[i] -= f * column[i];
  }
  for (int c = k - 1; c >= 0; --c) {
    if (w[c] == 0) continue;
    const double* const column = kernel_.data() + static_cast<std::size_t>(c) * k;
    const double f = w[c] * inverse_diagonal_[c];
    w[c] = f;
    for (int i = 0; i < c; ++i) w[i] -= f * column[i];
  }
  for (int t = 0; t < k; ++t) {
    const int p = kernel_positions_[t];
    z[p] = w[t];
    if (w[t] == 0) continue;
    for (int e = begin_[p]; e < end_[p]; ++e) a[model_->index[e]] -= w[t] * model_->value[e];
  }
}

void Factor::ftran(double* a, double* z) const {
  if (small_) return inverse_.ftran(a, z);
  if (large_) return sparse_.ftran(a, z);
  const int* const index = model_->index.data();
  const double* const value = model_->value.data();
  const auto eliminate = [&](const Pivot& pivot) {
    const double f = a[pivot.row];
    if (f == 0) {
      z[pivot.position] = 0;
      return;
    }
    const double x = f * pivot.inverse;
    z[pivot.position] = x;
    for (int e = pivot.begin; e < pivot.end; ++e) a[index[e]] -= x * value[e];
  };
  for (const Pivot& pivot : row_pivots_) eliminate(pivot);
  solve_kernel(a, z);
  for (auto it = column_pivots_.rbegin(); it != column_pivots_.rend(); ++it) eliminate(*it);
  for (int u = 0; u < updates_; ++u) {
    const int r = eta_positions_[u];
    if (z[r] == 0) continue;
    const double* const eta = etas_.data() + static_cast<std::size_t>(u) * m_;
    const double f = z[r] / eta[r];
    for (int p = 0; p < m_; ++p) z[p] -= f * eta[p];
    z[r] = f;
  }
}

void Factor::ftran_entering(double* a, double* z) {
  if (large_) return sparse_.ftran_entering(a, z);
  ftran(a, z);
}

void Factor::solve_kernel_transposed(double* c, double* y) const {
  const int k = k_;
  double* const w = work_.data();
  for (int t = 0; t < k; ++t) {
    const int p = kernel_positions_[t];
    double sum = c[p];
    for (int e = begin_[p]; e < end_[p]; ++e) sum -= model_->value[e] * y[model_->index[e]];
    w[t] = sum;
  }
  for (int t = 0; t < k; ++t) {
    const double* const column = kernel_.data() + static_cast<std::size_t>(t) * k;
    double sum = w[t];
    for (int i = 0; i < t; ++i) sum -= column[i] * w[i];
    w[t] = sum * inverse_diagonal_[t];
  }
  for (int t = k - 1; t >= 0; --t) {
    const double* const column = kernel_.data() + static_cast<std::size_t>(t) * k;
    double sum = w[t];
    for (int i = t + 1; i < k; ++i) sum -= column[i] * w[i];
    w[t] = sum;
  }
  for (int t = 0; t < k; ++t) y[kernel_rows_[t]] = w[t];
}

void Factor::row(int position, double* c, double* y) const {
  if (small_) return inverse_.row(position, y);
  if (large_) return sparse_.row(position, y);
  std::fill(c, c + m_, 0.0);
  c[position] = 1;
  btran(c, y);
}

void Factor::btran(double* c, double* y) const {
  if (small_) return inverse_.btran(c, y);
  if (large_) return sparse_.btran(c, y);
  const int* const index = model_->index.data();
  const double* const value = model_->value.data();
  for (int u = updates_ - 1; u >= 0; --u) {
    const int r = eta_positions_[u];
    const double* const eta = etas_.data() + static_cast<std::size_t>(u) * m_;
    double sum = 0;
    for (int p = 0; p < m_; ++p) sum += eta[p] * c[p];
    c[r] += (c[r] - sum) / eta[r];
  }
  std::fill(y, y + m_, 0.0);
  const auto eliminate = [&](const Pivot& pivot) {
    double sum = c[pivot.position];
    for (int e = pivot.begin; e < pivot.end; ++e) sum -= value[e] * y[index[e]];
    y[pivot.row] = sum * pivot.inverse;
  };
  for (const Pivot& pivot : column_pivots_) eliminate(pivot);
  solve_kernel_transposed(c, y);
  for (auto it = row_pivots_.rbegin(); it != row_pivots_.rend(); ++it) eliminate(*it);
}

void Factor::update(int position, const double* alpha) {
  if (small_) {
    ++updates_;
    return inverse_.update(position, alpha);
  }
  if (large_) {
    ++updates_;
    return sparse_.update(position, alpha[position]);
  }
  std::copy(alpha, alpha + m_, etas_.begin() + static_cast<std::size_t>(updates_) * m_);
  eta_positions_[updates_++] = position;
}

}  // namespace maxwrench::simplex
