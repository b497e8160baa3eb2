#include "solvers/lp/simplex/markowitz.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/linear_program.h"

namespace maxwrench::simplex {
namespace {

/// A pivot is at least this share of the largest entry of its row.
constexpr double kThreshold = 0.1;
/// Rows and columns that are searched for a better pivot.
constexpr int kMaxTries = 4;
/// Smaller entries after an elimination are what rounding left of a zero.
constexpr double kDrop = 1e-14;

}  // namespace

void Markowitz::Buckets::resize(int count) {
  for (auto* v : {&next, &previous, &bucket}) v->resize(count);
  first.resize(count + 1);
}

void Markowitz::Buckets::clear() {
  std::fill(first.begin(), first.end(), -1);
  std::fill(bucket.begin(), bucket.end(), -1);
}

void Markowitz::Buckets::remove(int item) {
  if (bucket[item] < 0) return;
  if (previous[item] >= 0) {
    next[previous[item]] = next[item];
  } else {
    first[bucket[item]] = next[item];
  }
  if (next[item] >= 0) previous[next[item]] = previous[item];
  bucket[item] = -1;
}

void Markowitz::Buckets::move(int item, int count) {
  if (bucket[item] == count) return;
  remove(item);
  previous[item] = -1;
  next[item] = first[count];
  if (first[count] >= 0) previous[first[count]] = item;
  first[count] = item;
  bucket[item] = count;
}

void Markowitz::resize(int rows_of_basis) {
  m_ = rows_of_basis;
  rows_.resize(m_);
  columns_.resize(m_);
  row_buckets_.resize(m_);
  column_buckets_.resize(m_);
  row_largest_.resize(m_);
  work_.resize(m_);
  in_pivot_row_.assign(m_, 0);
  step_.resize(m_);
}

void Markowitz::load(const Model& model, const std::vector<int>& head) {
  for (int i = 0; i < m_; ++i) rows_[i].clear();
  for (int p = 0; p < m_; ++p) {
    columns_[p].clear();
    for (int e = model.start[head[p]]; e < model.start[head[p] + 1]; ++e) {
      rows_[model.index[e]].push_back({p, model.value[e]});
      columns_[p].push_back(model.index[e]);
    }
  }
  row_buckets_.clear();
  column_buckets_.clear();
  for (int i = m_ - 1; i >= 0; --i) {
    row_buckets_.move(i, static_cast<int>(rows_[i].size()));
    column_buckets_.move(i, static_cast<int>(columns_[i].size()));
  }
  std::fill(row_largest_.begin(), row_largest_.end(), -1.0);
}

bool Markowitz::factorise(const Model& model, const std::vector<int>& head,
                          double singular_tolerance, std::vector<Replacement>& singular) {
  singular_tolerance_ = singular_tolerance;
  rows.clear();
  positions.clear();
  pivots.clear();
  l_columns.clear();
  u_rows.clear();
  load(model, head);
  for (Choice best; choose(best); best = {}) eliminate(best.row, best.position);
  if (static_cast<int>(rows.size()) == m_) {
    renumber();
    return true;
  }
  std::fill(step_.begin(), step_.end(), -1);
  for (const int p : positions) step_[p] = 0;
  for (int p = 0; p < m_; ++p) {
    if (step_[p] < 0) singular.push_back({p, -1});
  }
  std::fill(step_.begin(), step_.end(), -1);
  for (const int i : rows) step_[i] = 0;
  auto next = singular.begin();
  for (int i = 0; i < m_; ++i) {
    if (step_[i] < 0) (next++)->row = i;
  }
  return false;
}

/// The search of Suhl and Suhl (1990): by rising count, columns before rows, until a few lines have
/// offered a pivot or no other line can offer a better one.
bool Markowitz::choose(Choice& best) {
  best.cost = kInfinity;
  int tries = 0;
  for (int count = 1; count <= m_; ++count) {
    const double least = static_cast<double>(count - 1) * (count - 1);
    for (int p = column_buckets_.first[count], next; p >= 0; p = next) {
      next = column_buckets_.next[p];
      if (best.cost <= least) return true;
      // Without a pivot, the column waits until an elimination changes it.
      if (!try_column(p, best)) {
        column_buckets_.remove(p);
      } else if (++tries >= kMaxTries) {
        return true;
      }
    }
    for (int i = row_buckets_.first[count], next; i >= 0; i = next) {
      next = row_buckets_.next[i];
      if (best.cost <= least + count - 1) return true;
      if (!try_row(i, best)) {
        row_buckets_.remove(i);
      } else if (++tries >= kMaxTries) {
        return true;
      }
    }
  }
  return best.row >= 0;
}

/// A column's only entry has no alternative, so only its size counts.
bool Markowitz::try_column(int position, Choice& best) {
  const auto& list = columns_[position];
  bool found = false;
  for (const int i : list) {
    double size = 0;
    for (const Entry& entry : rows_[i]) {
      if (entry.position == position) size = std::abs(entry.value);
    }
    if (!(size > singular_tolerance_)) continue;
    if (list.size() > 1 && size < kThreshold * largest_of_row(i)) continue;
    found = true;
    const double cost =
        (static_cast<double>(list.size()) - 1) * (static_cast<double>(rows_[i].size()) - 1);
    if (cost < best.cost || (cost == best.cost && size > best.size)) {
      best = {i, position, cost, size};
    }
  }
  return found;
}

bool Markowitz::try_row(int row, Choice& best) {
  const double least = std::max(singular_tolerance_, kThreshold * largest_of_row(row));
  bool found = false;
  for (const auto& [position, value] : rows_[row]) {
    const double size = std::abs(value);
    if (!(size > singular_tolerance_) || size < least) continue;
    found = true;
    const double cost = (static_cast<double>(rows_[row].size()) - 1) *
                        (static_cast<double>(columns_[position].size()) - 1);
    if (cost < best.cost || (cost == best.cost && size > best.size)) {
      best = {row, position, cost, size};
    }
  }
  return found;
}

double Markowitz::largest_of_row(int row) {
  double& largest = row_largest_[row];
  if (largest >= 0) return largest;
  largest = 0;
  for (const Entry& entry : rows_[row]) largest = std::max(largest, std::abs(entry.value));
  return largest;
}

void Markowitz::eliminate(int row, int position) {
  pivot_row_.clear();
  double pivot = 0;
  for (const Entry& entry : rows_[row]) {
    if (entry.position == position) {
      pivot = entry.value;
      continue;
    }
    pivot_row_.push_back(entry);
    u_rows.index.push_back(entry.position);
    u_rows.value.push_back(entry.value);
    erase(columns_[entry.position], row);
    work_[entry.position] = entry.value;
    in_pivot_row_[entry.position] = 1;
  }
  for (const int i : columns_[position]) {
    if (i == row) continue;
    auto& list = rows_[i];
    const auto it = std::find_if(list.begin(), list.end(),
                                 [&](const Entry& entry) { return entry.position == position; });
    const double factor = it->value / pivot;
    *it = list.back();
    list.pop_back();
    l_columns.index.push_back(i);
    l_columns.value.push_back(factor);
    if (!pivot_row_.empty()) subtract_pivot_row(i, factor);
    row_largest_[i] = -1;
    row_buckets_.move(i, static_cast<int>(list.size()));
  }
  for (const Entry& entry : pivot_row_) {
    in_pivot_row_[entry.position] = 0;
    column_buckets_.move(entry.position, static_cast<int>(columns_[entry.position].size()));
  }
  rows_[row].clear();
  columns_[position].clear();
  row_buckets_.remove(row);
  column_buckets_.remove(position);
  rows.push_back(row);
  positions.push_back(position);
  pivots.push_back(pivot);
  l_columns.end_line();
  u_rows.end_line();
}

void Markowitz::subtract_pivot_row(int row, double factor) {
  auto& list = rows_[row];
  for (std::size_t e = 0; e < list.size();) {
    Entry& entry = list[e];
    if (!in_pivot_row_[entry.position]) {
      ++e;
      continue;
    }
    in_pivot_row_[entry.position] = 0;
    entry.value -= factor * work_[entry.position];
    if (!(std::abs(entry.value) <= kDrop)) {
      ++e;
      continue;
    }
    erase(columns_[entry.position], row);
    entry = list.back();
    list.pop_back();
  }
  for (const Entry& entry : pivot_row_) {
    char& fill = in_pivot_row_[entry.position];
    if (fill && !(std::abs(factor * entry.value) <= kDrop)) {
      list.push_back({entry.position, -factor * entry.value});
      columns_[entry.position].push_back(row);
    }
    fill = 1;
  }
}

void Markowitz::erase(std::vector<int>& list, int item) {
  const auto it = std::find(list.begin(), list.end(), item);
  *it = list.back();
  list.pop_back();
}

/// From rows and positions to steps.
void Markowitz::renumber() {
  for (int k = 0; k < m_; ++k) step_[rows[k]] = k;
  for (int& i : l_columns.index) i = step_[i];
  for (int k = 0; k < m_; ++k) step_[positions[k]] = k;
  for (int& p : u_rows.index) p = step_[p];
}

}  // namespace maxwrench::simplex
