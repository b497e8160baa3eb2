#pragma once

#include <vector>

#include "lib/robot/kinematics.h"
#include "lib/robot/spatial.h"

namespace maxwrench {

/// The derivatives of f = tau_d(theta, v, v_d) + J'h_e at a wrench h_e that is constant in the
/// world, in closed form (Singh, Russo, Wensing, "Efficient analytical derivatives of rigid-body
/// dynamics using spatial vector algebra", RA-L 2022; added mass, drag, buoyancy and h_e are
/// additions).
///
/// Link k loads its joints with F_k = I_k A_k + V_k x* I_k V_k + drag + weight. Take the axes of
/// the links that joint j carries. In these axes a turn of j leaves the links at rest and turns
/// their surroundings. It changes the twist of the parent p by psi_j = V_p x s_j and the
/// acceleration by A_p x s_j + V_p x psi_j - V_k x psi_j, and it turns the vertical and h_e by
/// -s_j. The derivative of F by V_k at constant A is
///
///     B_k Y = Y x* I_k V_k + V_k x* I_k Y - I_k (V_k x Y) + D_k Y.
///
/// The robot's current counts in V_0 and A_0, as in `Dynamics`. A turn x of the base changes all
/// V_k by Y = (x x R'v_c, 0), with X = 0.
///
/// A column of the derivatives is I_k X + B_k Y, with (X, Y) = (A_p x s_j + V_p x psi_j, psi_j) by
/// q_j, (2 psi_j, s_j) by the rate of q_j and (s_j, 0) by v_d. An entry is the product of a column
/// with s_i, summed over the links that both i and j carry. All entries take O(n^2), because each
/// body is summed over the links that it carries. Evaluation allocates nothing.
class DynamicsSlopes {
 public:
  /// The robot must outlive this object.
  explicit DynamicsSlopes(const Robot& robot);
  explicit DynamicsSlopes(const Robot&&) = delete;

  /// The arguments are those of `Dynamics`; h_e = [force; torque] in world axes at the end
  /// effector.
  void set(const Matrix3<double>& R_base, const Eigen::VectorXd& q, const Eigen::VectorXd& velocity,
           const Eigen::VectorXd& acceleration, const EndEffector& end_effector,
           const Vector6d& h_e);

  const Eigen::MatrixXd& by_turn() const { return by_turn_; }    ///< n×3, of the base, in its axes
  const Eigen::MatrixXd& by_q() const { return by_q_; }          ///< n×joints
  const Eigen::MatrixXd& by_v() const { return by_v_; }          ///< n×n
  const Eigen::MatrixXd& by_v_dot() const { return by_v_dot_; }  ///< n×n: M

 private:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  /// A link. After the summation, I, B and F are those of the link and all links that it carries.
  struct Body {
    Vector6d V, A, F;
    Matrix6d I, B;
  };
  /// A velocity: the link that it moves, its screw s, and the products of s with the matrices I and
  /// B of its row.
  struct Axis {
    std::size_t link;
    Vector6d s, I_s, B_s;
  };

  void set_axes();
  void set_motion(const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration);
  void set_body(std::size_t link);
  void add_drag(std::size_t link);
  void carry();
  void fill_velocities();
  void fill_places();
  void fill_turns();
  Vector6d turned_loads(std::size_t link, const Eigen::Vector3d& turn) const;
  bool carries(std::size_t link, std::size_t other) const { return carries_(link, other); }

  const Robot& robot_;
  Kinematics<double> kinematics_;
  std::vector<Inertia<double>> inertia_;
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> carries_;  ///< link by link; also itself
  std::vector<Body> bodies_;
  std::vector<Axis> axes_;
  std::size_t tool_link_ = 0;
  Eigen::Vector3d pull_, p_e_, force_, torque_, current_;  ///< in base axes
  Eigen::VectorXd weight_;
  Eigen::MatrixXd by_turn_, by_q_, by_v_, by_v_dot_;
};

}  // namespace maxwrench
