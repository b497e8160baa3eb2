#pragma once

#include "maxwrench/types.h"
#include "maxwrench/zonotope.h"
#include "verify/interval.h"

namespace maxwrench {

/// Upper bounds that follow from the balance B u = tau + A z, z = [t; h], over a box, in which tau
/// and A are within `off` of given ones. Sums are rounded upward.
class FreeWrenchLimits {
 public:
  /// `tau` n, `A` n×(1 + k), `off` of [tau A] n×(2 + k). Keeps a reference to the set.
  FreeWrenchLimits(const Zonotope& set, Eigen::VectorXd tau, Eigen::MatrixXd A,
                   Eigen::MatrixXd off);

  /// Z >= |z| for all balances with |t| <= most_t; empty if none is found. For any P,
  ///
  ///     z = P (B u - tau) - (P A - 1) z,   so   |z| <= b + E |z|.
  ///
  /// If a Z > 0 has b + E Z < Z, then |z| <= Z. P is a left inverse of A.
  Eigen::VectorXd find(double most_t) const;

  /// h = M u - p + rho with |rho| <= R.
  struct Law {
    Eigen::MatrixXd M;     ///< k×m, near P B
    Eigen::VectorXd p, R;  ///< k; p is near P tau
  };
  /// The law of the P that makes h depend least on the efforts with small lambda'B, from |z| <= Z.
  Law law(const Eigen::VectorXd& lambda, const Eigen::VectorXd& Z) const;

 private:
  Eigen::MatrixXd left_inverse() const;
  Eigen::MatrixXd left_inverse(const Eigen::VectorXd& lambda) const;

  const Zonotope& set_;
  const Eigen::VectorXd tau_, farthest_;
  const Eigen::MatrixXd A_, off_;
};

}  // namespace maxwrench
