#pragma once

#include <Eigen/Cholesky>

#include "maxwrench/zonotope.h"

namespace maxwrench {

/// Limits of z = [t; h] over a box, from B u = tau + A z and the limits of u. For any matrix P,
///
///     z = P (B u - tau) - (P A - 1) z,   so   |z| <= b + E |z|
///
/// with the largest |P (B u - tau)| and |P A - 1| of the box as b and E. If a Z > 0 has
/// b + E Z < Z, then (1 - E)^-1 >= 0 exists, and |z| <= Z.
class FreeLimits {
 public:
  /// `sizes`: magnitudes of [tau A], n×(2 + k).
  FreeLimits(const Zonotope& set, const Eigen::MatrixXd& sizes);

  /// From tau and A at the centre, the largest deviations `off` of [tau A] from it in the box, and
  /// a number that |t| does not exceed. Returns false if no limits are found.
  bool find(const Eigen::VectorXd& tau, const Eigen::MatrixXd& A, const Eigen::MatrixXd& off,
            double most_t);
  /// [|t|; |h|].
  const Eigen::VectorXd& Z() const { return Z_; }
  /// The P with which they were found.
  const Eigen::MatrixXd& P() const { return P_; }
  /// Limits of |h - P (B u - tau)| at the centre's tau, for another P with the rows of h only.
  void rest(const Eigen::MatrixXd& P, const Eigen::MatrixXd& A, const Eigen::MatrixXd& off,
            Eigen::VectorXd& R);
  /// Magnitudes of P B u, one for each row of P.
  void reach(const Eigen::MatrixXd& P, Eigen::VectorXd& most) const;

 private:
  void find_inverse(const Eigen::MatrixXd& A);
  bool solve(Eigen::Index from, double known);

  const Zonotope& set_;
  Eigen::MatrixXd rounding_;  ///< of [tau A]
  Eigen::VectorXd farthest_, scales_;
  Eigen::MatrixXd scaled_, normal_, P_, PB_, E_, I_E_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
  Eigen::VectorXd b_, Z_, own_, next_;
};

}  // namespace maxwrench
