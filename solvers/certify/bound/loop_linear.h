#pragma once

#include "maxwrench/bound.h"
#include "solvers/certify/bound/equation_points.h"

namespace maxwrench {

/// The equations over a box, expanded about its centre m. With s_i = sin(x_i - m_i) for turning
/// coordinates and x_i - m_i for sliding ones, |s_i| <= w_i,
///
///     f(x) = f_0 + D s + rest,   |rest| <= rho.
///
/// The expansion uses the coefficients of f in (1, cos(x_i - m_i) less the middle of its range,
/// s_i). The bound rho sums up those of higher order.
class LoopLinear {
 public:
  explicit LoopLinear(const LoopModel& model);

  /// Cuts off slices of the box that hold no x with f(x) = 0, one after the other. Returns false if
  /// the whole box holds none. Control points prove what the expansion suggests of each slice.
  /// `cuts` may be null.
  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts);
  /// Computes M for rows M f. The first `rank` rows are each one s_i/w_i plus a linear combination
  /// of others; the remaining rows are almost zero.
  void precondition(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  const Eigen::MatrixXd& M() const { return M_; }
  int rank() const { return rank_; }

 private:
  void expand(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  void turn(const MultiAffine& f, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  void gather(const LoopPart& part);
  void eliminate();
  /// A limit of one u_j, and the row that it follows from: i for row i of f, m + i for row i of M
  /// f.
  struct Limit {
    int axis = 0, row = 0;
    bool upper = false;
    bool operator==(const Limit& o) const { return axis == o.axis && upper == o.upper; }
  };
  bool propagate(const Eigen::MatrixXd& A, const Eigen::VectorXd& e, const Eigen::VectorXd& rho,
                 int first_row);
  void limit(const Limit& by, double value);
  bool propagate_all();
  void set_multiplier(int row);
  bool excludes(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int row, int axis,
                std::vector<BoxCut>* cuts);
  bool slice(const Limit& by, Eigen::VectorXd& lower, Eigen::VectorXd& upper,
             std::vector<BoxCut>* cuts);

  const LoopModel& model_;
  Eigen::MatrixXd coefficients_, D_, A_, M_;
  Eigen::VectorXd weights_, turned_, f_0_, rho_, w_, low_, high_, e_, reduced_rho_;
  EquationPoints points_;
  std::vector<Limit> limits_;  ///< in the order in which they were found
  BoxCut cut_;
  Eigen::VectorXd centre_, radius_, slice_lower_, slice_upper_;
  int refuted_ = 0;  ///< the row that no u of the box satisfies
  int rank_ = 0;
  double gain_ = 0;
};

}  // namespace maxwrench
