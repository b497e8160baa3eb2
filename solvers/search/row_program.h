#pragma once

#include <Eigen/Core>

namespace maxwrench {

/// A smooth program in y with a linear objective, as local solvers need it:
///
///     max c_y'y   subject to   row_min <= rows(y) <= row_max,   lower <= y <= upper.
class RowProgram {
 public:
  /// By rows.
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  virtual ~RowProgram() = default;

  const Eigen::VectorXd& start() const { return start_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  const Eigen::VectorXd& c_y() const { return c_y_; }
  const Eigen::VectorXd& row_min() const { return row_min_; }
  const Eigen::VectorXd& row_max() const { return row_max_; }

  /// Whether no evaluation is left.
  virtual bool ended() const = 0;
  /// Evaluates the rows at y, once for repeated calls with the same y. Returns false if they have
  /// no values there, or if `ended`.
  virtual bool look(const Eigen::VectorXd& y) = 0;
  const Eigen::VectorXd& rows() const { return rows_; }
  /// The derivative of the rows at the last y for which `look` returned true.
  virtual const Jacobian& jacobian() = 0;

 protected:
  Eigen::VectorXd start_, lower_, upper_, c_y_, row_min_, row_max_, rows_;
};

}  // namespace maxwrench
