#pragma once

#include "solvers/certify/trajectory/instant_bound.h"
#include "solvers/certify/trajectory/instant_loads.h"

namespace maxwrench {

/// The terms delta(q, q_dot) of `InstantLoads` that are quadratic in velocities, over a box of x =
/// [q; q_dot] with the centre m, half widths w:
///
///     delta in constant + sum_j G_j s_j + [low, high],
///
/// s_j = sin(x_j - m_j) for angles, x_j - m_j otherwise. By the mean value theorem this holds with
/// any G if [low, high] contains delta(m) - constant, plus (delta_j - G_j) times [-w_j, w_j],
/// delta_j an enclosure of the derivative over the box, plus what x_j - m_j exceeds the sine, times
/// G_j. G is the middle of delta_j. For rows whose plain enclosure is narrower, G = 0.
class QuadraticLoads {
 public:
  /// Keeps a reference to the instant.
  explicit QuadraticLoads(const PlanInstant& at);

  void enclose(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

  /// delta(m) - sum_j G_j m_j over the rates alone, so that G_j q_dot_j is the linear part.
  const Eigen::VectorXd& constant() const { return constant_; }
  const Eigen::MatrixXd& slopes() const { return G_; }  ///< n×2r
  const Eigen::VectorXd& low() const { return low_; }
  const Eigen::VectorXd& high() const { return high_; }
  /// The largest |s_j| of a coordinate of q.
  double reach(int j) const { return reach_[j]; }
  /// No sum of the magnitudes of a row's terms is larger.
  const Eigen::VectorXd& sizes() const { return sizes_; }

 private:
  const PlanInstant& at_;
  InstantLoads<Narrow> plain_;
  InstantLoads<NarrowDual> dual_;
  VectorX<Narrow> whole_, centre_;
  VectorX<NarrowDual> slopes_;
  Eigen::VectorXd constant_, low_, high_, reach_, sizes_;
  Eigen::MatrixXd G_;
};

}  // namespace maxwrench
