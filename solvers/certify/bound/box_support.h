#pragma once

#include "maxwrench/zonotope.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {

/// The support function of {B u} within the limits of u: s(lambda) = max over u of lambda'B u. With
/// `identity`, B is the identity, and s is the support function of the limits themselves.
class BoxSupport {
 public:
  /// Keeps a reference to the set.
  BoxSupport(const Zonotope& set, bool identity)
      : set_(set),
        B_(identity ? Eigen::MatrixXd::Identity(set.actuators(), set.actuators()) : set.B) {}

  const Eigen::MatrixXd& B() const { return B_; }

  double of(const Eigen::VectorXd& lambda) { return of(lambda, set_); }
  /// The same within the limits of another set, of the same B.
  double of(const Eigen::VectorXd& lambda, const Zonotope& other) {
    farthest_ = other.u_min.cwiseAbs().cwiseMax(other.u_max.cwiseAbs());
    slope_.noalias() = B_.transpose() * lambda;
    sizes_.noalias() = B_.cwiseAbs().transpose() * lambda.cwiseAbs();
    return (slope_.array() * other.u_min.array()).max(slope_.array() * other.u_max.array()).sum();
  }
  /// The largest rounding error of the last value.
  double rounding() const { return kBoundRounding * sizes_.dot(farthest_); }

 private:
  const Zonotope& set_;
  Eigen::MatrixXd B_;
  Eigen::VectorXd farthest_, slope_, sizes_;
};

}  // namespace maxwrench
