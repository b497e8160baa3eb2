#include "solvers/certify/bound/multiplier_program.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace maxwrench {
namespace {

constexpr double kBasisPivot = 1e-9;   ///< smaller pivots make a basis singular
constexpr double kStepPivot = 1e-10;   ///< smaller entries of a row are rounding errors
constexpr double kInfeasible = 1e-10;  ///< violation of a limit, as a share of the width

}  // namespace

MultiplierProgram::MultiplierProgram(const Eigen::MatrixXd& B, const Eigen::VectorXd& x_min,
                                     const Eigen::VectorXd& x_max, Eigen::Index most_points)
    : n_(B.rows()), m_(B.cols()), rows_(n_ + 1), first_(m_ + rows_) {
  const Eigen::Index most = first_ + most_points;
  A_ = Eigen::MatrixXd::Zero(most, rows_);
  A_.topLeftCorner(m_, n_) = -B.transpose();
  A_.middleRows(m_, rows_).setIdentity();
  A_.col(n_).tail(most_points).setOnes();
  c_ = Eigen::VectorXd::Zero(most);
  low_ = Eigen::VectorXd::Zero(most);
  low_.head(m_) = x_min;
  width_ = Eigen::VectorXd::Ones(most);
  width_.head(m_) = x_max - x_min;
  width_.segment(m_, rows_).setZero();
  d_ = alpha_ = rest_ = Eigen::VectorXd::Zero(most);
  high_.assign(static_cast<std::size_t>(most), 0);
  place_.assign(static_cast<std::size_t>(most), -1);
  basis_.assign(static_cast<std::size_t>(rows_), 0);
  inverse_ = work_ = RowMajor::Zero(rows_, rows_);
  x_ = y_ = best_y_ = change_ = column_ = Eigen::VectorXd::Zero(rows_);
  breaks_.reserve(static_cast<std::size_t>(most));
}

/// Inverts the basis by Gauss-Jordan elimination; returns false if it is singular.
bool MultiplierProgram::invert() {
  for (Eigen::Index i = 0; i < rows_; ++i) {
    work_.col(i) = A_.row(basis_[static_cast<std::size_t>(i)]);
  }
  inverse_.setIdentity();
  for (Eigen::Index k = 0; k < rows_; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < rows_; ++i) {
      if (std::abs(work_(i, k)) > std::abs(work_(pivot, k))) pivot = i;
    }
    if (!(std::abs(work_(pivot, k)) > kBasisPivot)) return false;
    if (pivot != k) {
      work_.row(k).swap(work_.row(pivot));
      inverse_.row(k).swap(inverse_.row(pivot));
    }
    const double scale = 1 / work_(k, k);
    work_.row(k) *= scale;
    inverse_.row(k) *= scale;
    for (Eigen::Index i = 0; i < rows_; ++i) {
      const double factor = work_(i, k);
      if (i == k || factor == 0) continue;
      work_.row(i).tail(rows_ - k) -= factor * work_.row(k).tail(rows_ - k);
      inverse_.row(i) -= factor * inverse_.row(k);
    }
  }
  return true;
}

/// Computes everything that depends on the basis.
void MultiplierProgram::price() {
  const Eigen::Index size = columns();
  std::fill(place_.begin(), place_.begin() + size, -1);
  y_.setZero();
  for (Eigen::Index i = 0; i < rows_; ++i) {
    const int column = basis_[static_cast<std::size_t>(i)];
    place_[static_cast<std::size_t>(column)] = static_cast<int>(i);
    if (c_[column] != 0) y_ += c_[column] * inverse_.row(i).transpose();
  }
  d_.head(size).noalias() = c_.head(size) - A_.topRows(size) * y_;
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto at = static_cast<std::size_t>(j);
    high_[at] = d_[j] > 0;
    if (place_[at] >= 0) d_[j] = 0;
    rest_[j] = place_[at] >= 0 ? 0 : low_[j] + (high_[at] ? width_[j] : 0);
  }
  change_.noalias() = -A_.topRows(size).transpose() * rest_.head(size);
  change_[n_] += 1;
  x_.noalias() = inverse_ * change_;
}

bool MultiplierProgram::begin(const std::vector<int>& basis) {
  if (basis.size() != basis_.size()) return false;
  for (const int column : basis) {
    if (column >= columns()) return false;
  }
  basis_ = basis;
  if (!invert()) return false;
  price();
  return true;
}

void MultiplierProgram::begin_cold() {
  for (Eigen::Index i = 0; i < rows_; ++i) {
    basis_[static_cast<std::size_t>(i)] = static_cast<int>(m_ + i);
  }
  inverse_.setIdentity();
  price();
}

/// U at the lambda of the basis.
double MultiplierProgram::value() const {
  double sum = y_[n_] + d_.segment(first_, points_).maxCoeff();
  for (Eigen::Index k = 0; k < m_; ++k) {
    sum += d_[k] * (d_[k] > 0 ? low_[k] + width_[k] : low_[k]);
  }
  return sum;
}

/// The row of the variable that is farthest beyond its limits, measured along its dual edge; -1 if
/// there is none. Sets the sign: 1 below the lower limit, -1 above the upper one.
int MultiplierProgram::leaving() const {
  int row = -1;
  double most = 0;
  for (Eigen::Index i = 0; i < rows_; ++i) {
    const int column = basis_[static_cast<std::size_t>(i)];
    const double by = std::max(low_[column] - x_[i], x_[i] - low_[column] - width_[column]);
    if (!(by > kInfeasible * (1 + width_[column]))) continue;
    const double score = by * by / inverse_.row(i).squaredNorm();
    if (score <= most) continue;
    most = score;
    row = static_cast<int>(i);
  }
  return row;
}

/// Moves a nonbasic variable to its other limit and accumulates what that changes.
void MultiplierProgram::flip(int column) {
  char& high = high_[static_cast<std::size_t>(column)];
  change_ += (high ? width_[column] : -width_[column]) * A_.row(column).transpose();
  high = !high;
}

/// The long-step ratio test. Passes reduced costs that become zero while the dual objective falls;
/// their variables change to their other limits. Returns -1 if the objective falls without end.
///
/// It ends at the latest where a variable takes up the whole slope by itself. Of thousands of
/// variables few become zero before the first of these.
int MultiplierProgram::entering(double slope) {
  breaks_.clear();
  double latest = kInfinity;
  const Eigen::Index size = columns();
  for (Eigen::Index j = 0; j < size; ++j) {
    const double alpha = sign_ * alpha_[j];
    const auto at = static_cast<std::size_t>(j);
    if (place_[at] >= 0 || width_[j] == 0) continue;
    if (high_[at] ? alpha < kStepPivot : alpha > -kStepPivot) continue;
    const double ratio = std::max(d_[j] / alpha, 0.0);
    if (ratio > latest) continue;
    if (std::abs(alpha) * width_[j] >= slope) latest = ratio;
    breaks_.push_back({ratio, static_cast<int>(j)});
  }
  std::erase_if(breaks_, [&](const Break& at) { return at.at > latest; });
  std::make_heap(breaks_.begin(), breaks_.end());
  change_.setZero();
  while (!breaks_.empty()) {
    const int column = breaks_.front().column;
    slope -= std::abs(alpha_[column]) * width_[column];
    if (slope <= 0) return column;
    flip(column);
    std::pop_heap(breaks_.begin(), breaks_.end());
    breaks_.pop_back();
  }
  return -1;
}

void MultiplierProgram::pivot(int row, int column) {
  const double theta = d_[column] / alpha_[column];
  const Eigen::Index size = columns();
  d_.head(size) -= theta * alpha_.head(size);
  y_ += theta * inverse_.row(row).transpose();
  const int gone = basis_[static_cast<std::size_t>(row)];
  const bool to_high = sign_ < 0;
  place_[static_cast<std::size_t>(gone)] = -1;
  place_[static_cast<std::size_t>(column)] = row;
  high_[static_cast<std::size_t>(gone)] = to_high;
  basis_[static_cast<std::size_t>(row)] = column;
  d_[column] = 0;
  column_.noalias() = inverse_ * A_.row(column).transpose();
  const double limit = low_[gone] + (to_high ? width_[gone] : 0);
  const double move = (x_[row] - limit) / column_[row];
  x_ -= move * column_;
  const bool was_high = high_[static_cast<std::size_t>(column)] != 0;
  x_[row] = low_[column] + (was_high ? width_[column] : 0) + move;
  inverse_.row(row) /= column_[row];
  for (Eigen::Index i = 0; i < rows_; ++i) {
    if (i != row && column_[i] != 0) inverse_.row(i) -= column_[i] * inverse_.row(row);
  }
}

/// One step of the dual simplex. Returns false if U falls without end along it; y_ is then far down
/// the edge.
bool MultiplierProgram::step(int row) {
  const int gone = basis_[static_cast<std::size_t>(row)];
  const double below = low_[gone] - x_[row], above = x_[row] - low_[gone] - width_[gone];
  sign_ = below > above ? 1 : -1;
  alpha_.head(columns()).noalias() = A_.topRows(columns()) * inverse_.row(row).transpose();
  const double slope = std::max(below, above);
  const int column = entering(slope);
  if (column < 0) {
    constexpr double kFar = 1e4;
    y_ += sign_ * kFar / slope * inverse_.row(row).transpose();
    return false;
  }
  x_.noalias() += inverse_ * change_;
  pivot(row, column);
  return true;
}

double MultiplierProgram::solve(double enough, int steps, std::vector<int>& basis,
                                Eigen::VectorXd& lambda) {
  if (!begin(basis)) begin_cold();
  double best = value();
  best_y_ = y_;
  for (int i = 0; i < steps && best > enough; ++i) {
    const int row = leaving();
    if (row < 0) break;
    const bool on = step(row);
    const double now = on ? value() : -kInfinity;
    if (now < best) {
      best = now;
      best_y_ = y_;
    }
    if (!on) break;
  }
  basis = basis_;
  lambda = best_y_.head(n_);
  return best;
}

void list_largest(const Eigen::VectorXd& values, double above, std::size_t most,
                  std::vector<int>& indices) {
  indices.clear();
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i] > above) indices.push_back(static_cast<int>(i));
  }
  if (indices.size() <= most) return;
  const auto end = indices.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(indices.begin(), end, indices.end(),
                   [&](int a, int b) { return values[a] > values[b]; });
  indices.resize(most);
}

}  // namespace maxwrench
