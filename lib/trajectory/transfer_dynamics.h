#pragma once

#include <vector>

#include "lib/trajectory/motion_evaluator.h"
#include "maxwrench/problem.h"

namespace maxwrench {

/// The forces of a transfer at a point of its state space: with a = q'' and the mass m of the
/// payload,
///
///     f(q, v, a, m) = tau_d(q, v, a) + m g(q, v, a),   g = J'c,   B u = f,
///
/// where c is the wrench of 1 kg (`carried_wrench`). f is affine in a, f = M a + h, and in m. The
/// derivatives are those of `MotionEvaluator`, in closed form.
class TransferDynamics {
 public:
  /// The problem must outlive this object.
  ///
  /// @throws std::invalid_argument if the task is no transfer, or if the robot has joints that the
  ///         transfer does not move.
  explicit TransferDynamics(const Problem& problem);
  explicit TransferDynamics(const Problem&&) = delete;

  /// n, the number of joints.
  int joints() const { return static_cast<int>(Q_.cols()); }
  /// Computes f, g and the derivatives of f. Units: rad or m, s, kg.
  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double m);

  const Eigen::VectorXd& f() const { return f_; }                 ///< n [N, N m]
  const Eigen::VectorXd& g() const { return g_; }                 ///< n, by m
  const Eigen::MatrixXd& by_q() const { return slopes().place; }  ///< n×n
  const Eigen::MatrixXd& by_v() const { return slopes().rate; }   ///< n×n
  const Eigen::MatrixXd& M() const { return slopes().bend; }      ///< n×n, by a, symmetric

 private:
  const MotionSlopes& slopes() const { return slopes_.front(); }

  const Problem& problem_;
  MotionEvaluator motion_;
  std::vector<Instant> instants_;
  std::vector<MotionSlopes> slopes_;
  Eigen::MatrixXd Q_;  ///< 3×n: the rows q, v and a
  Eigen::VectorXd f_, g_;
};

}  // namespace maxwrench
