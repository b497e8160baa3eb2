#pragma once

#include "solvers/plan/normal_matrix.h"

namespace maxwrench {

struct Forms;
struct Side;

/// Directions of the embedding, one a column: of the variables X and, where the forms have slacks,
/// of the sizes sigma that these are paid by, |s| <= sigma. They come from its normal equations,
///
///     H (X, sigma) = (X + phi's map of G, sigma),
///
/// with the weights theta of both sides of the forms. Of a slack s both sides depend on its sigma,
/// which stands in no other form: it is eliminated beforehand.
class Directions {
 public:
  void reserve(const Forms& forms, int columns);
  /// At new theta of both sides, whose sums `weight` has: what is left of the slacks' weights.
  void eliminate(const Forms& forms, const Side& low, const Side& high);
  void factor(const Forms& forms, double least_pivot);
  /// Solves for `count` columns from `first` on, in place; of G, phi of the answer is left (less
  /// sigma for the upper and plus it for the lower sides).
  void solve(const Forms& forms, int first, int count);

  Eigen::MatrixXd X, sigma;
  Eigen::MatrixXd G;  ///< of the forms: what is mapped to X, then phi at their upper sides
  const Eigen::MatrixXd& low() const { return split_ ? G_low : G; }  ///< at their lower sides
  Eigen::MatrixXd G_low;                                             ///< if it is not G
  Eigen::VectorXd weight;                                            ///< of each form, in H

 private:
  NormalMatrix matrix_;
  bool split_ = false;
  Eigen::VectorXd s_phi_, s_diagonal_;
};

}  // namespace maxwrench
