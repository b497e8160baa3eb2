#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// Finds the multiplier lambda (n) with the least
///
///     U(lambda) = sum_k max over the limits of x_k lambda'B_k + max_i (c_i - lambda'p_i)
///
/// by the dual simplex on the dual linear program, with weights mu of the points p_i:
///
///     max c'mu   subject to   P mu = B x,  sum mu = 1,  0 <= mu <= 1,  x_min <= x <= x_max.
///
/// All variables are boxed. So every basis is dual feasible once the nonbasic variables are at the
/// right limits, and the basis of a similar program is a good start. Any lambda proves a bound, so
/// the answer need not be exact. The matrices are small and dense. Nothing is allocated after the
/// constructor.
class MultiplierProgram {
 public:
  /// B is n×m. `most_points` is the largest number of points.
  MultiplierProgram(const Eigen::MatrixXd& B, const Eigen::VectorXd& x_min,
                    const Eigen::VectorXd& x_max, Eigen::Index most_points);

  /// Changes the limits of x_k.
  void set_limits(Eigen::Index k, double x_min, double x_max) {
    low_[k] = x_min;
    width_[k] = x_max - x_min;
  }
  /// Changes the first rows of B.
  void set_columns(const Eigen::MatrixXd& B) { A_.topLeftCorner(m_, B.rows()) = -B.transpose(); }
  void set_points(Eigen::Index count) { points_ = count; }
  Eigen::Index points() const { return points_; }
  /// The index of the first point in a basis.
  int first_point() const { return static_cast<int>(first_); }
  /// The entries p_ij of all points for fixed j, and c_i.
  auto row(Eigen::Index j) { return A_.col(j).segment(first_, points_); }
  auto costs() { return c_.segment(first_, points_); }

  /// Stops when U(lambda) <= enough, when the least U is reached, or after `steps`. Starts from
  /// `basis`, which is empty or the basis of a program with as many rows, and stores the last basis
  /// in it. Returns U(lambda), which may be off by rounding.
  double solve(double enough, int steps, std::vector<int>& basis, Eigen::VectorXd& lambda);
  /// The weight mu_i of a point where the last call ended. It is in [0, 1] if that call reached the
  /// least U.
  double weight(Eigen::Index i) const {
    const auto column = static_cast<std::size_t>(first_ + i);
    return place_[column] >= 0 ? x_[place_[column]] : high_[column] != 0 ? 1 : 0;
  }

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// A place along a dual edge where a reduced cost becomes zero.
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
  Eigen::MatrixXd A_;  ///< columns×rows: actuators, artificial variables, points
  Eigen::VectorXd c_, low_, width_, d_, alpha_, rest_;
  std::vector<char> high_;  ///< nonbasic at its upper limit
  std::vector<int> place_;  ///< position in the basis, or -1
  std::vector<int> basis_;
  RowMajor inverse_, work_;
  Eigen::VectorXd x_, y_, best_y_, change_, column_;
  std::vector<Break> breaks_;
  double sign_ = 1;
};

/// The indices of values above a limit; of the `most` largest ones, if there are more.
void list_largest(const Eigen::VectorXd& values, double above, std::size_t most,
                  std::vector<int>& indices);

}  // namespace maxwrench
