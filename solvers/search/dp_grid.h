#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// A regular grid of control points over the bounds of theta_r, both ends included, and the
/// neighbours of each: those which the speed limits let follow it. Cells are numbered, the first
/// coordinate slowest. A given point may be one more cell, after all others.
class ControlGrid {
 public:
  /// @param points  on each coordinate with lower < upper
  /// @param step    largest difference of neighbouring control points (r); may be infinite
  /// @param given   a point that need not be on the grid (r), or empty
  ControlGrid(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int points,
              const Eigen::VectorXd& step, const Eigen::VectorXd& given);

  /// Upper bounds of the number of cells and of the number of pairs of neighbours, without making
  /// the grid.
  struct Size {
    double cells = 1, pairs = 1;
  };
  static Size size(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int points,
                   const Eigen::VectorXd& step);

  int points() const { return points_; }
  /// Number of cells without the given point, which is the number of its cell.
  int cells() const { return cells_; }
  int given() const { return cells_; }
  auto at(int cell) const { return at_.col(cell); }

  /// The neighbours of a cell, itself included: `to(p)` for p from `first(cell)` to
  /// `first(cell + 1)` - 1, in the order of their numbers. p numbers the pairs of neighbours. The
  /// given point leads to cells, and no cell leads to it.
  long first(int cell) const { return first_[static_cast<std::size_t>(cell)]; }
  int to(long pair) const { return to_[static_cast<std::size_t>(pair)]; }
  long pairs() const { return static_cast<long>(to_.size()); }
  /// The number of a pair of neighbours.
  long pair(int from, int to) const;

 private:
  bool near(int a, int b) const;

  int points_, cells_;
  Eigen::MatrixXd at_;  ///< r×(cells + 1, if a point is given)
  Eigen::VectorXd step_;
  std::vector<long> first_;
  std::vector<int> to_;
};

}  // namespace maxwrench
