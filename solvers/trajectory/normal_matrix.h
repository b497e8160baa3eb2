#pragma once

#include <vector>

#include "solvers/trajectory/blocks.h"

namespace maxwrench {

struct Forms;

/// H = sum_f theta_f phi_f phi_f' over the forms of a trajectory, factored by stages. Only the
/// rates and commands couple the blocks K_i of the instants (K_i+1,i). The border z = (t, y) comes
/// last.
///
/// A pivot below the share `least_pivot` of its diagonal belongs to a direction that no form
/// contains, and is left out.
class NormalMatrix {
 public:
  /// Allocates storage for the shape of these forms.
  void reserve(const Forms& forms);
  void factor(const Forms& forms, const Eigen::VectorXd& theta, double least_pivot);
  /// X = H^-1 X, column by column.
  void solve(const Forms& forms, Columns X) const;

 private:
  void assemble(const Forms& forms, const Eigen::VectorXd& theta);
  void add_commands(const Forms& forms, const Eigen::VectorXd& theta);
  template <int D>
  void assemble_stage(const Forms& forms, const Eigen::VectorXd& theta, int i);
  template <int D>
  void factor_stage(const Forms& forms, int i);
  template <int D, int Next>
  void factor_coupling(const Forms& forms, int i);
  template <int D>
  void couple(const Forms& forms, const Eigen::VectorXd& theta, int i);
  template <int D>
  void forward(const Forms& forms, Columns X, int i) const;
  template <int D>
  void backward(const Forms& forms, Columns X, int i) const;
  void border(const Forms& forms, const Eigen::VectorXd& theta);
  void border_commands(const Forms& forms, int i);
  void border_limits(const Forms& forms, const Eigen::VectorXd& theta);

  double least_pivot_ = 0;
  std::vector<int> K0_, S0_, E0_;  ///< where the blocks of each stage begin
  Eigen::VectorXd K_;              ///< d×d, then its factor L with inverse diagonal
  Eigen::VectorXd S_;              ///< d_i+1 × d_i, then K_i+1,i L_i^-T
  Eigen::VectorXd E_;              ///< d×b by rows, then L_i^-1 E_i
  Eigen::MatrixXd H_;              ///< b×b, then its factor
  Eigen::VectorXd weight_;         ///< theta, with that of rates and commands added to the efforts'
  Eigen::MatrixXd coupling_;  ///< rated×(N-1): weights of the products of neighbouring efforts
  Eigen::VectorXd weighted_, row_;
  RowMatrix stack_;
};

}  // namespace maxwrench
