#include "solvers/lp/simplex/model.h"

#include <algorithm>
#include <cmath>

#include "lib/math/farkas.h"

namespace maxwrench::simplex {
namespace {

constexpr int kGeometricPasses = 4;

double power_of_two_near(double x) {
  int exponent;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, exponent - 1);
}

}  // namespace

bool Model::load(const LinearProgram& program) {
  const int n = static_cast<int>(program.c.size());
  if (program.b.size() != program.rows() || n != program.cols() || program.l.size() != n ||
      program.u.size() != n) {
    return false;
  }
  resize(program.rows(), n, static_cast<int>(program.A.nonZeros()));
  if (!copy(program)) return false;
  choose_scales();
  if (scaled) apply_matrix_scales();
  apply_vector_scales();
  const double entries = start[total] - rows;
  sparse = rows >= kSparseRows && entries <= kSparseDensity * rows * cols;
  if (sparse) copy_by_rows();
  return true;
}

void Model::resize(int new_rows, int new_cols, int entries) {
  index.resize(std::max<std::size_t>(index.size(), new_rows + entries));
  value.resize(index.size());
  if (new_rows == rows && new_cols == cols && !start.empty()) return;
  rows = new_rows;
  cols = new_cols;
  total = rows + cols;
  start.resize(total + 1);
  b.resize(rows);
  for (auto* v : {&cost, &lower, &upper}) v->resize(total);
  fixed.resize(total);
  row_scale.resize(rows);
  row_max_.resize(rows);
  row_min_.resize(rows);
  col_scale.resize(cols);
  col_max_.resize(cols);
  col_min_.resize(cols);
  for (int i = 0; i < rows; ++i) {
    start[i] = i;
    index[i] = i;
    value[i] = 1;
    cost[i] = lower[i] = upper[i] = 0;
    fixed[i] = 1;
  }
}

/// Also computes the data for scaling: the largest magnitude of each row and column.
bool Model::copy(const LinearProgram& program) {
  const auto& A = program.A;
  const int* const outer = A.outerIndexPtr();
  const int* const inner = A.innerIndexPtr();
  const double* const entries = A.valuePtr();
  std::fill(row_max_.begin(), row_max_.end(), 0.0);
  double poison = 0;  // becomes NaN if an entry is not finite
  int k = rows;
  crossing = false;
  for (int j = 0; j < cols; ++j) {
    const int end = A.isCompressed() ? outer[j + 1] : outer[j] + A.innerNonZeroPtr()[j];
    double largest = 0;
    start[rows + j] = k;
    for (int e = outer[j]; e < end; ++e) {
      const double a = entries[e];
      if (a == 0) continue;
      const int i = inner[e];
      const double magnitude = std::abs(a);
      poison += a * 0;
      index[k] = i;
      value[k++] = a;
      largest = std::max(largest, magnitude);
      row_max_[i] = std::max(row_max_[i], magnitude);
    }
    col_max_[j] = largest;
    const double l = program.l[j], u = program.u[j];
    if (std::isnan(l) || std::isnan(u) || l == kInfinity || u == -kInfinity) return false;
    crossing |= l > u;
    poison += program.c[j] * 0;
    cost[rows + j] = -program.c[j];
    lower[rows + j] = l > -kInfiniteBound ? l : -kInfinity;
    upper[rows + j] = u < kInfiniteBound ? u : kInfinity;
    fixed[rows + j] = l == u;
  }
  start[total] = k;
  for (int i = 0; i < rows; ++i) {
    poison += program.b[i] * 0;
    b[i] = program.b[i];
  }
  return poison == 0;
}

/// Rows and columns whose largest entries are already near one are not scaled. Otherwise, after a
/// few passes of geometric scaling, every column is scaled so that its largest entry is near one.
/// Entries that are rounding noise compared with the largest entry of their column are ignored.
void Model::choose_scales() {
  const auto uneven = [](double x) { return x != 0 && (x < 0.01 || x > 100); };
  scaled = std::any_of(row_max_.begin(), row_max_.end(), uneven) ||
           std::any_of(col_max_.begin(), col_max_.end(), uneven);
  if (!scaled) return;
  std::fill(row_scale.begin(), row_scale.end(), 1.0);
  std::fill(col_scale.begin(), col_scale.end(), 1.0);
  for (int pass = 0; pass < kGeometricPasses; ++pass) {
    std::fill(row_max_.begin(), row_max_.end(), 0.0);
    std::fill(row_min_.begin(), row_min_.end(), kInfinity);
    for (int j = 0; j < cols; ++j) {
      double largest = 0, smallest = kInfinity;
      const int begin = start[rows + j], end = start[rows + j + 1];
      for (int k = begin; k < end; ++k) {
        const double a = std::abs(value[k]) * row_scale[index[k]];
        largest = std::max(largest, a);
        if (std::abs(value[k]) > 1e-11 * col_max_[j]) smallest = std::min(smallest, a);
      }
      if (largest == 0) continue;
      col_scale[j] = 1 / (pass + 1 < kGeometricPasses ? std::sqrt(largest * smallest) : largest);
      for (int k = begin; k < end; ++k) {
        if (std::abs(value[k]) <= 1e-11 * col_max_[j]) continue;
        const double a = std::abs(value[k]) * col_scale[j];
        row_max_[index[k]] = std::max(row_max_[index[k]], a);
        row_min_[index[k]] = std::min(row_min_[index[k]], a);
      }
    }
    if (pass + 1 == kGeometricPasses) break;
    for (int i = 0; i < rows; ++i) {
      if (row_max_[i] > 0) row_scale[i] = 1 / std::sqrt(row_max_[i] * row_min_[i]);
    }
  }
}

void Model::apply_matrix_scales() {
  for (double& r : row_scale) r = power_of_two_near(r);
  for (double& s : col_scale) s = power_of_two_near(s);
  for (int j = 0; j < cols; ++j) {
    const double s = col_scale[j];
    for (int k = start[rows + j]; k < start[rows + j + 1]; ++k) value[k] *= s * row_scale[index[k]];
    cost[rows + j] *= s;
    lower[rows + j] /= s;
    upper[rows + j] /= s;
  }
  for (int i = 0; i < rows; ++i) b[i] *= row_scale[i];
}

/// Tolerances are absolute, for quantities near one. So the geometric mean of the costs is scaled
/// to one, and right-hand sides and bounds if all of them are small.
void Model::apply_vector_scales() {
  double smallest_cost = kInfinity, largest_cost = 0, largest_bound = 0;
  for (int j = rows; j < total; ++j) {
    if (cost[j] != 0 && !fixed[j]) {
      largest_cost = std::max(largest_cost, std::abs(cost[j]));
      smallest_cost = std::min(smallest_cost, std::abs(cost[j]));
    }
    if (std::isfinite(lower[j])) largest_bound = std::max(largest_bound, std::abs(lower[j]));
    if (std::isfinite(upper[j])) largest_bound = std::max(largest_bound, std::abs(upper[j]));
  }
  for (int i = 0; i < rows; ++i) largest_bound = std::max(largest_bound, std::abs(b[i]));
  cost_scale = rhs_scale = 1;
  if (largest_cost > 0 && (smallest_cost < 0.25 || largest_cost > 16)) {
    scale_costs();
  }
  if (largest_bound > 0 && largest_bound < 0.25) {
    rhs_scale = 1 / power_of_two_near(largest_bound);
    for (int j = rows; j < total; ++j) {
      lower[j] *= rhs_scale;
      upper[j] *= rhs_scale;
    }
    for (int i = 0; i < rows; ++i) b[i] *= rhs_scale;
  }
}

void Model::copy_by_rows() {
  by_rows.sort(rows, [this](const auto& visit) {
    for (int j = total - 1; j >= rows; --j) {
      for (int e = start[j]; e < start[j + 1] && !fixed[j]; ++e) visit(index[e], j, value[e]);
    }
  });
}

void Model::scale_costs() {
  int exponents = 0, count = 0;
  for (int j = rows; j < total; ++j) {
    if (cost[j] == 0 || fixed[j]) continue;
    exponents += std::ilogb(cost[j]);
    ++count;
  }
  cost_scale = std::ldexp(1.0, -exponents / count);
  for (int j = rows; j < total; ++j) cost[j] *= cost_scale;
}

}  // namespace maxwrench::simplex
