#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// Finds the multiplier lambda (n) of the least
///
///     U(lambda) = sum_k max over the limits of x_k lambda'B_k + max_i (c_i - lambda'p_i)
///
/// by the dual simplex on the linear program that is its dual, with weights mu of the points p_i:
///
///     max c'mu   subject to   P mu = B x,  sum mu = 1,  0 <= mu <= 1,  x_min <= x <= x_max.
///
/// All variables are boxed, so every basis is dual feasible once the others rest at the right
/// limits, and a basis of a similar program is a good start. Any lambda serves as a proof, so the
/// answer need not be exact. Its matrices are small and dense; nothing is allocated after the
/// constructor.
class MultiplierProgram {
 public:
  /// B n×m; at most so many points.
  MultiplierProgram(const Eigen::MatrixXd& B, const Eigen::VectorXd& x_min,
                    const Eigen::VectorXd& x_max, Eigen::Index most_points);

  void set_points(Eigen::Index count) { points_ = count; }
  Eigen::Index points() const { return points_; }
  /// What a basis calls the first of them.
  int first_point() const { return static_cast<int>(first_); }
  /// Numbers p_ij of all points, j fixed, and c_i.
  auto row(Eigen::Index j) { return A_.col(j).segment(first_, points_); }
  auto costs() { return c_.segment(first_, points_); }

  /// Goes on until U(lambda) <= enough, the least is reached, or for `steps`. `basis`: where to
  /// start, empty or of a program with as many rows; gets the last one. Returns U(lambda), rounded.
  double solve(double enough, int steps, std::vector<int>& basis, Eigen::VectorXd& lambda);

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Where a step along a dual edge meets a reduced cost that becomes zero.
  struct Break {
    double at;
    int column;
    bool operator<(const Break& other) const {
      return at != other.at ? at > other.at : column > other.column;  // the first on top of a heap
    }
  };

  Eigen::Index columns() const { return first_ + points_; }
  bool invert();
  bool begin(const std::vector<int>& basis);
  void begin_cold();
  void price();
  double value() const;
  int leaving() const;
  bool step(int row);
  int entering(double slope);
  void flip(int column);
  void pivot(int row, int column);

  const Eigen::Index n_, m_, rows_, first_;  ///< rows_ = n + 1; the points' columns begin at first_
  Eigen::Index points_ = 0;
  Eigen::MatrixXd A_;  ///< columns×rows: actuators, artificial ones, points
  Eigen::VectorXd c_, low_, width_, d_, alpha_, rest_;
  std::vector<char> high_;  ///< rests at its upper limit
  std::vector<int> place_;  ///< in the basis, or -1
  std::vector<int> basis_;
  RowMajor inverse_, work_;
  Eigen::VectorXd x_, y_, best_y_, change_, column_;
  std::vector<Break> breaks_;
  double sign_ = 1;
};

}  // namespace maxwrench
