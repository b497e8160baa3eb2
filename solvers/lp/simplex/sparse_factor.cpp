#include "solvers/lp/simplex/sparse_factor.h"

#include <algorithm>
#include <cmath>

namespace maxwrench::simplex {
namespace {

/// Smaller entries of s and w are what rounding left of a zero.
constexpr double kDropUpdate = 1e-14;

inline void scatter(const Lines& lines, int k, double f, double* x) {
  const int* const index = lines.index.data();
  const double* const value = lines.value.data();
  for (int e = lines.start[k]; e < lines.start[k + 1]; ++e) x[index[e]] -= f * value[e];
}

}  // namespace

void SparseFactor::resize(int rows, int max_updates) {
  m_ = rows;
  lu_.resize(rows);
  inverse_.resize(rows);
  step_.resize(rows);
  x_.assign(rows, 0);
  spike_.assign(rows, 0);
  updates_.reserve(max_updates);
}

bool SparseFactor::factorise(const Model& model, const std::vector<int>& head,
                             double singular_tolerance, std::vector<Replacement>& singular) {
  updates_.clear();
  for (auto* v : {&s_index_, &w_index_}) v->clear();
  for (auto* v : {&s_value_, &w_value_}) v->clear();
  if (!lu_.factorise(model, head, singular_tolerance, singular)) return false;
  l_rows_.transpose(lu_.l_columns);
  u_columns_.transpose(lu_.u_rows);
  for (int k = 0; k < m_; ++k) {
    inverse_[k] = 1 / lu_.pivots[k];
    step_[lu_.positions[k]] = k;
  }
  return true;
}

void SparseFactor::ftran(const double* a, double* z) const {
  solve_lower(a);
  solve_upper(z);
}

void SparseFactor::ftran_entering(const double* a, double* z) {
  solve_lower(a);
  spike_ = x_;
  solve_upper(z);
}

/// x = (L T_1 ... T_u)^-1 a.
void SparseFactor::solve_lower(const double* a) const {
  double* const x = x_.data();
  for (int k = 0; k < m_; ++k) x[k] = a[lu_.rows[k]];
  for (int k = 0; k < m_; ++k) {
    if (x[k] != 0) scatter(lu_.l_columns, k, x[k], x);
  }
  int s = 0, w = 0;
  for (const auto& [s_end, w_end, inverse] : updates_) {
    double sum = 0;
    for (; w < w_end; ++w) sum += w_value_[w] * x[w_index_[w]];
    if (sum != 0) {
      sum *= inverse;
      for (; s < s_end; ++s) x[s_index_[s]] -= sum * s_value_[s];
    }
    s = s_end;
  }
}

/// z = U^-1 x.
void SparseFactor::solve_upper(double* z) const {
  double* const x = x_.data();
  for (int k = m_ - 1; k >= 0; --k) {
    if (x[k] != 0) scatter(u_columns_, k, x[k] *= inverse_[k], x);
  }
  for (int k = 0; k < m_; ++k) z[lu_.positions[k]] = x[k];
}

void SparseFactor::btran(const double* c, double* y) const {
  for (int k = 0; k < m_; ++k) x_[k] = c[lu_.positions[k]];
  solve_upper_transposed(0);
  solve_lower_transposed(y);
}

void SparseFactor::row(int position, double* y) const {
  std::fill(x_.begin(), x_.end(), 0.0);
  x_[step_[position]] = 1;
  solve_upper_transposed(step_[position]);
  solve_lower_transposed(y);
}

/// x = U^-T x, where the entries before `first` are zero.
void SparseFactor::solve_upper_transposed(int first) const {
  double* const x = x_.data();
  for (int k = first; k < m_; ++k) {
    if (x[k] != 0) scatter(lu_.u_rows, k, x[k] *= inverse_[k], x);
  }
}

/// y = (L T_1 ... T_u)^-T x.
void SparseFactor::solve_lower_transposed(double* y) const {
  double* const x = x_.data();
  for (int u = static_cast<int>(updates_.size()) - 1; u >= 0; --u) {
    const int s_begin = u > 0 ? updates_[u - 1].s_end : 0;
    const int w_begin = u > 0 ? updates_[u - 1].w_end : 0;
    double sum = 0;
    for (int s = s_begin; s < updates_[u].s_end; ++s) sum += s_value_[s] * x[s_index_[s]];
    if (sum == 0) continue;
    sum *= updates_[u].inverse;
    for (int w = w_begin; w < updates_[u].w_end; ++w) x[w_index_[w]] -= sum * w_value_[w];
  }
  for (int k = m_ - 1; k >= 0; --k) {
    if (x[k] != 0) scatter(l_rows_, k, x[k], x);
  }
  for (int k = 0; k < m_; ++k) y[lu_.rows[k]] = x[k];
}

void SparseFactor::update(int position, double pivot) {
  const int p = step_[position];
  spike_[p] -= lu_.pivots[p];
  for (int e = u_columns_.start[p]; e < u_columns_.start[p + 1]; ++e) {
    spike_[u_columns_.index[e]] -= u_columns_.value[e];
  }
  std::fill(x_.begin(), x_.end(), 0.0);
  x_[p] = 1;
  solve_upper_transposed(p);
  const auto store = [&](const std::vector<double>& from, std::vector<int>& index,
                         std::vector<double>& value) {
    for (int k = 0; k < m_; ++k) {
      if (std::abs(from[k]) <= kDropUpdate) continue;  // keeps NaN
      index.push_back(k);
      value.push_back(from[k]);
    }
  };
  store(spike_, s_index_, s_value_);
  store(x_, w_index_, w_value_);
  updates_.push_back(
      {static_cast<int>(s_index_.size()), static_cast<int>(w_index_.size()), 1 / pivot});
}

}  // namespace maxwrench::simplex
