#pragma once

#include "maxwrench/bound.h"
#include "solvers/certify/bound/equation_points.h"

namespace maxwrench {

/// The equations over a box, about its centre m: with s_i = sin(x_i - m_i) of turning coordinates,
/// x_i - m_i of sliding ones, |s_i| <= w_i,
///
///     f(x) = f_0 + D s + rest,   |rest| <= rho,
///
/// from the coefficients of f in (1, cos(x_i - m_i) less the middle of its range, s_i), of which
/// those of higher order are summed up.
class LoopLinear {
 public:
  explicit LoopLinear(const LoopModel& model);

  /// Cuts off what no x with f(x) = 0 of the box has, one slice after another; false: it has none.
  /// What the expansion says is proven of each slice by control points. `cuts` may be null.
  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts);
  /// Rows M f, the first `rank` of which are some s_i/w_i and a linear combination of others, and
  /// the others next to zero.
  void precondition(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  const Eigen::MatrixXd& M() const { return M_; }
  int rank() const { return rank_; }

 private:
  void expand(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  void turn(const MultiAffine& f, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  void gather(const LoopPart& part);
  void eliminate();
  /// A limit of one u_j, and the row that it follows from: of f, or, m more, of M f.
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
  int refuted_ = 0;  ///< the row that no u of the box fulfils
  int rank_ = 0;
  double gain_ = 0;
};

}  // namespace maxwrench
