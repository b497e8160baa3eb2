#pragma once

#include "lib/bound/loop_model.h"

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

  /// Cuts off what no x with f(x) = 0 of the box has; false: it has none.
  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper);
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
  bool propagate(const Eigen::MatrixXd& A, const Eigen::VectorXd& e, const Eigen::VectorXd& rho);
  bool narrow(Eigen::VectorXd& lower, Eigen::VectorXd& upper);

  const LoopModel& model_;
  Eigen::MatrixXd coefficients_, D_, A_, M_;
  Eigen::VectorXd weights_, turned_, f_0_, rho_, w_, low_, high_, e_, reduced_rho_;
  int rank_ = 0;
  double gain_ = 0;
};

}  // namespace maxwrench
