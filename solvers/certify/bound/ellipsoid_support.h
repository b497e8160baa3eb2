#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lib/math/extended.h"
#include "solvers/certify/bound/bounds.h"

namespace maxwrench {

/// The ellipsoid |K tau| <= 1 with K = W_u B^+. With Q = K'K = L L', its support function is
/// s(lambda) = |L^-1 lambda|.
class EllipsoidSupport {
 public:
  explicit EllipsoidSupport(const Eigen::MatrixXd& K) {
    const MatrixX<Extended> wide = K.cast<Extended>();
    const MatrixX<Extended> Q = wide.transpose() * wide;
    const MatrixX<Extended> L = Q.llt().matrixL();
    const MatrixX<Extended> one = MatrixX<Extended>::Identity(Q.rows(), Q.cols());
    L_inverse_ = L.triangularView<Eigen::Lower>().solve(one).cast<double>();
    Q_ = Q.cast<double>();
  }

  double of(const Eigen::VectorXd& lambda) {
    reach_.noalias() = L_inverse_ * lambda;
    sizes_.noalias() = L_inverse_.cwiseAbs() * lambda.cwiseAbs();
    return reach_.norm();
  }
  /// The largest rounding error of the last value.
  double rounding() const { return kBoundRounding * sizes_.sum(); }

  /// Sets lambda to the normal Q (tau + t a), scaled to lambda'a = 1, at the t where the ray leaves
  /// the ellipsoid, or at `low` if that is farther out.
  void aim(const Eigen::VectorXd& tau, const Eigen::VectorXd& a, double low,
           Eigen::VectorXd& lambda) {
    constexpr double kLeast = 1e-6;
    lambda.noalias() = Q_ * a;
    sizes_.noalias() = Q_ * tau;
    const double aa = a.dot(lambda), at = tau.dot(lambda);
    const double square = at * at - aa * (tau.dot(sizes_) - 1);
    const double t = std::max(low, (std::sqrt(std::max(square, kLeast * aa)) - at) / aa);
    lambda = (sizes_ + t * lambda) / std::max(at + t * aa, kLeast * std::sqrt(aa));
  }

 private:
  Eigen::MatrixXd Q_, L_inverse_;
  Eigen::VectorXd reach_, sizes_;
};

}  // namespace maxwrench
