#pragma once

#include "lib/trajectory/transfer_dynamics.h"

namespace maxwrench {

/// The index of a transfer that an extremal maximises.
///
///     m - integral of epsilon/2 sum_i (u_i/w_i)^2 + stiffness/2 sum_j excess_j^2 dt,
///
/// w_i the larger of actuator i's two absolute limits, excess_j = max(0, |v_j|/v_max,j - 1) and
/// likewise for positions beyond their limits, in rad or m.
struct TransferIndex {
  double epsilon = 1;    ///< weight of the efforts [kg/s], positive
  double stiffness = 0;  ///< weight of what exceeds the limits of joints and speeds [kg/s]
  double reach = 1;      ///< factor of the limits of efforts [-], positive
  double speeds = 1;     ///< factor of the limits of speeds [-], positive
};

/// The w_i.
Eigen::VectorXd effort_weights(const Problem& problem);

/// By how much x exceeds [low, high], with its sign.
inline double excess_of(double x, double low, double high) {
  return x > high ? x - high : x < low ? x - low : 0;
}

/// The canonical equations of Pontryagin's maximum principle for the largest payload of a transfer.
///
/// The state z has 4 n + 1 numbers: q, v, the costates p of q and lambda of v, and nu. With y =
/// M^-1 lambda, f = M a + h and the excess Pi,
///
///     H = -epsilon/2 sum_i (u_i/w_i)^2 - Pi(q, v) + p'v + lambda'a,   a = M^-1 (B u - h),
///     u_i = w_i^2 (B'y)_i / epsilon within its limits, which maximises H,
///     q' = v,  v' = a,  p' = Pi_q + f_q'y,  lambda' = Pi_v - p + f_v'y,  nu' = y'g.
///
/// m is constant and free, so its costate vanishes at the start and -1 at the end: nu, from 0, ends
/// at 1. At the limit epsilon = 0 each effort jumps between its limits where (B'y)_i changes sign.
///
/// `linearize` gives the derivatives of the right-hand sides. All first derivatives of f are exact;
/// the second ones that it needs are central differences of these. Use one object per thread.
class CanonicalEquations {
 public:
  /// The problem must outlive this object.
  ///
  /// @throws std::invalid_argument as `TransferDynamics`, and if an actuator has no finite limits.
  explicit CanonicalEquations(const Problem& problem);
  explicit CanonicalEquations(const Problem&&) = delete;

  int joints() const { return dynamics_.joints(); }
  int size() const { return 4 * joints() + 1; }
  void set_index(const TransferIndex& index);
  const TransferIndex& index() const { return index_; }

  /// The right-hand sides at z (4 n + 1). Returns whether they are finite.
  bool rates(const Eigen::VectorXd& z, double m, Eigen::VectorXd& z_dot);
  /// Also their derivatives, by z (square) and by m.
  bool linearize(const Eigen::VectorXd& z, double m, Eigen::VectorXd& z_dot, Eigen::MatrixXd& by_z,
                 Eigen::VectorXd& by_m);
  /// After either: the efforts, B'y, which they follow, and H.
  const Eigen::VectorXd& efforts() const { return u_; }
  const Eigen::VectorXd& switching() const { return s_; }
  double hamiltonian() const;
  /// H at z for given efforts, for checks.
  double hamiltonian(const Eigen::VectorXd& z, double m, const Eigen::VectorXd& u);

  /// Costates at which a motion of mass m needs the efforts of the maximum principle: lambda, for
  /// the motion q, v, a. p stays zero.
  Eigen::VectorXd costate_of(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             const Eigen::VectorXd& a, double m);

 private:
  void split(const Eigen::VectorXd& z);
  void set_efforts();
  void add_excess(Eigen::VectorXd& z_dot) const;
  double excess() const;
  void differentiate_slopes(double m);

  const Problem& problem_;
  TransferDynamics dynamics_, other_;
  TransferIndex index_;
  Eigen::VectorXd w_, v_max_, fastest_;  ///< fastest: v_max times its factor
  Eigen::VectorXd q_, v_, p_, lambda_, y_, u_, s_, a_, zero_;
  Eigen::LDLT<Eigen::MatrixXd> M_;
  Eigen::MatrixXd H_qq_, H_qv_, H_vq_, H_vv_, N_;  ///< N: of M y by q
};

}  // namespace maxwrench
