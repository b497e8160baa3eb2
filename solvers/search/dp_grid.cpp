#include "solvers/search/dp_grid.h"

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

constexpr double kStepSlack = 1e-9;  // [rad or m] of the differences, for rounding

/// The points of a coordinate.
int grid_points_of(double lower, double upper, int points) { return lower < upper ? points : 1; }

/// Cells that a coordinate may move.
int cells_within(double lower, double upper, int points, double step) {
  const int own = grid_points_of(lower, upper, points);
  if (own == 1) return 0;
  const double cell = (upper - lower) / (own - 1);
  return static_cast<int>(std::min<double>(own - 1, std::floor((step + kStepSlack) / cell)));
}

}  // namespace

ControlGrid::Size ControlGrid::size(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                    int points, const Eigen::VectorXd& step) {
  Size size;
  for (Eigen::Index j = 0; j < lower.size(); ++j) {
    const int own = grid_points_of(lower[j], upper[j], points);
    const int reach = cells_within(lower[j], upper[j], points, step[j]);
    size.cells *= own;
    // Of all cells, 2 reach + 1 neighbours each, less those beyond the ends.
    size.pairs *= own * (2.0 * reach + 1) - reach * (reach + 1.0);
  }
  return size;
}

ControlGrid::ControlGrid(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int points,
                         const Eigen::VectorXd& step, const Eigen::VectorXd& given)
    : points_(points), step_(step) {
  const Eigen::Index r = lower.size();
  std::vector<int> own(static_cast<std::size_t>(r)), reach(own);
  cells_ = 1;
  for (Eigen::Index j = 0; j < r; ++j) {
    const auto k = static_cast<std::size_t>(j);
    own[k] = grid_points_of(lower[j], upper[j], points);
    reach[k] = cells_within(lower[j], upper[j], points, step[j]);
    cells_ *= own[k];
  }
  at_.resize(r, cells_ + (given.size() > 0 ? 1 : 0));
  if (given.size() > 0) at_.col(cells_) = given;
  std::vector<int> index(static_cast<std::size_t>(r), 0), other(index);
  const auto number = [&](const std::vector<int>& of) {
    int cell = 0;
    for (std::size_t k = 0; k < of.size(); ++k) cell = cell * own[k] + of[k];
    return cell;
  };
  const auto next = [&](std::vector<int>& of, const auto& low, const auto& high) {
    for (std::size_t k = of.size(); k-- > 0;) {
      if (++of[k] <= high(k)) return true;
      of[k] = low(k);
    }
    return false;
  };
  const auto none = [](std::size_t) { return 0; };
  const auto last = [&](std::size_t k) { return own[k] - 1; };
  do {
    const int cell = number(index);
    for (Eigen::Index j = 0; j < r; ++j) {
      const auto k = static_cast<std::size_t>(j);
      const double share = own[k] == 1 ? 0 : static_cast<double>(index[k]) / (own[k] - 1);
      at_(j, cell) = index[k] == own[k] - 1 ? upper[j] : lower[j] + share * (upper[j] - lower[j]);
      if (own[k] == 1) at_(j, cell) = lower[j];
    }
    first_.push_back(static_cast<long>(to_.size()));
    const auto low = [&](std::size_t k) { return std::max(0, index[k] - reach[k]); };
    const auto high = [&](std::size_t k) { return std::min(own[k] - 1, index[k] + reach[k]); };
    for (std::size_t k = 0; k < other.size(); ++k) other[k] = low(k);
    do {
      to_.push_back(number(other));
    } while (next(other, low, high));
  } while (next(index, none, last));
  if (given.size() > 0) {  // only as a start: it leads to cells, and none leads to it
    first_.push_back(static_cast<long>(to_.size()));
    for (int cell = 0; cell <= cells_; ++cell) {
      if (near(cells_, cell)) to_.push_back(cell);
    }
  }
  first_.push_back(static_cast<long>(to_.size()));
}

bool ControlGrid::near(int a, int b) const {
  return ((at_.col(a) - at_.col(b)).array().abs() <= step_.array() + kStepSlack).all();
}

long ControlGrid::pair(int from, int to) const {
  const auto begin = to_.begin() + first(from), end = to_.begin() + first(from + 1);
  return std::lower_bound(begin, end, to) - to_.begin();
}

}  // namespace maxwrench
