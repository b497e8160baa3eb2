#include "solvers/lp/simplex/inverse.h"

#include <algorithm>
#include <cmath>

namespace maxwrench::simplex {
namespace {

/// y += f x; the two must not overlap.
inline void add(int n, double f, const double* __restrict x, double* __restrict y) {
  for (int p = 0; p < n; ++p) y[p] += f * x[p];
}

}  // namespace

void Inverse::resize(int rows) {
  m_ = rows;
  inverse_.resize(static_cast<std::size_t>(m_) * m_);
  alpha_.resize(m_);
  pending_.reserve(m_);
  taken_.resize(m_);
}

bool Inverse::place(int variable, int row, std::vector<int>& head) {
  if (taken_[row]) return false;
  taken_[row] = 1;
  head[row] = variable;
  return true;
}

bool Inverse::invert(const Model& model, std::vector<int>& head, double singular_tolerance,
                     std::vector<Replacement>& singular) {
  std::fill(inverse_.begin(), inverse_.end(), 0.0);
  std::fill(taken_.begin(), taken_.end(), 0);
  for (int i = 0; i < m_; ++i) inverse_[i * m_ + i] = 1;
  pending_.assign(head.begin(), head.end());
  const auto left = [&](auto&& done) {
    pending_.erase(std::remove_if(pending_.begin(), pending_.end(), done), pending_.end());
  };
  left([&](int j) { return j < m_ && place(j, j, head); });
  left([&](int j) {
    const int e = model.start[j];
    if (model.start[j + 1] - e != 1 || std::abs(model.value[e]) <= singular_tolerance) return false;
    const int i = model.index[e];
    if (!place(j, i, head)) return false;
    inverse_[i * m_ + i] = 1 / model.value[e];
    return true;
  });
  left([&](int j) {
    std::fill(alpha_.begin(), alpha_.end(), 0.0);
    for (int e = model.start[j]; e < model.start[j + 1]; ++e) {
      add(m_, model.value[e], inverse_.data() + model.index[e] * m_, alpha_.data());
    }
    int best = -1;
    double largest = singular_tolerance;
    for (int p = 0; p < m_; ++p) {
      if (!taken_[p] && std::abs(alpha_[p]) > largest) largest = std::abs(alpha_[p]), best = p;
    }
    if (best < 0) return false;
    place(j, best, head);
    update(best, alpha_.data());
    return true;
  });
  for (int i = 0, k = 0; k < static_cast<int>(pending_.size()); ++i) {
    if (place(pending_[k], i, head)) singular.push_back({i, i}), ++k;
  }
  return pending_.empty();
}

void Inverse::ftran(const double* a, double* z) const {
  std::fill(z, z + m_, 0.0);
  for (int i = 0; i < m_; ++i) {
    const double f = a[i];
    if (f == 0) continue;
    add(m_, f, inverse_.data() + i * m_, z);
  }
}

void Inverse::btran(const double* c, double* y) const {
  for (int i = 0; i < m_; ++i) {
    const double* const column = inverse_.data() + i * m_;
    double even = 0, odd = 0;  // two chains of additions
    int p = 0;
    for (; p + 1 < m_; p += 2) {
      even += column[p] * c[p];
      odd += column[p + 1] * c[p + 1];
    }
    if (p < m_) even += column[p] * c[p];
    y[i] = even + odd;
  }
}

void Inverse::row(int position, double* y) const {
  for (int i = 0; i < m_; ++i) y[i] = inverse_[i * m_ + position];
}

void Inverse::update(int position, const double* alpha) {
  const double factor = 1 / alpha[position];
  for (int i = 0; i < m_; ++i) {
    double* const column = inverse_.data() + i * m_;
    if (column[position] == 0) continue;
    const double f = column[position] * factor;
    add(m_, -f, alpha, column);
    column[position] = f;
  }
}

}  // namespace maxwrench::simplex
