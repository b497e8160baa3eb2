#pragma once

#include <memory>

#include "maxwrench/types.h"

namespace maxwrench {

struct Problem;

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
  ~TransferDynamics();

  /// n, the number of joints.
  int joints() const { return static_cast<int>(f_.size()); }
  /// Computes f, g and the derivatives of f. Units: rad or m, s, kg.
  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double m);

  const Eigen::VectorXd& f() const { return f_; }  ///< n [N, N m]
  const Eigen::VectorXd& g() const { return g_; }  ///< n, by m
  const Eigen::MatrixXd& by_q() const;             ///< n×n
  const Eigen::MatrixXd& by_v() const;             ///< n×n
  const Eigen::MatrixXd& M() const;                ///< n×n, by a, symmetric

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
  Eigen::VectorXd f_, g_;
};

}  // namespace maxwrench
