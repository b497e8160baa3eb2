#pragma once

#include "maxwrench/zonotope.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {

/// The support function of {B u} within the limits of u: s(lambda) = max over u of lambda'B u. With
/// `identity`, B is the identity, and s is the support function of the limits themselves.
class BoxSupport {
 public:
  /// Keeps a reference to the limits.
  BoxSupport(const Zonotope& set, bool identity)
      : set_(set),
        B_(identity ? Eigen::MatrixXd::Identity(set.actuators(), set.actuators()) : set.B),
        farthest_(set.u_min.cwiseAbs().cwiseMax(set.u_max.cwiseAbs())) {}

  const Eigen::MatrixXd& B() const { return B_; }

  double of(const Eigen::VectorXd& lambda) {
    slope_.noalias() = B_.transpose() * lambda;
    sizes_.noalias() = B_.cwiseAbs().transpose() * lambda.cwiseAbs();
    return (slope_.array() * set_.u_min.array()).max(slope_.array() * set_.u_max.array()).sum();
  }
  /// The largest rounding error of the last value.
  double rounding() const { return kBoundRounding * sizes_.dot(farthest_); }

 private:
  const Zonotope& set_;
  Eigen::MatrixXd B_;
  Eigen::VectorXd farthest_, slope_, sizes_;
};

}  // namespace maxwrench
