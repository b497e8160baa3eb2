#pragma once

#include <vector>

#include "lib/robot/kinematics.h"

namespace maxwrench {

/// The derivatives of functions of J and tau_d by the joint positions, while the end effector keeps
/// its pose and the base moves. Reverse accumulation: the cost grows with n, not with n times the
/// number of directions. Allocates nothing after the first call.
///
/// In world axes about the end effector, which rests, velocity i is a screw s_i = [v_i; w_i],
/// column i of J. A body that moves with the screw x moves the screws on it by ds = x (×) s = [w_x
/// × v_s + v_x × w_s; w_x × w_s]. With the field G = [0, 0, -g] the load is tau_i = -G'p_i, p_i =
/// m_i v_i + w_i × c_i, where m_i is the wet mass that velocity i carries and c_i its first moment.
/// For seeds t = df/d tau_d and [a_i; b_i] = df/dJ_i let
///
///     y_i = -[w_i × a_i; v_i × a_i + w_i × b_i] + [0; t_i p_i × G],
///
/// so that s'y_i is the change of f due to velocity i when the velocity and all that it carries
/// move by -s. If q_k grows and joint k carries the end effector, all that it does not carry moves
/// by -s_k. Any other joint moves what it carries by s_k. In both cases the moments c_i of the
/// velocities that carry k change as well, which adds -p_k'(sum over them of t_i G × w_i).
class PullBack {
 public:
  /// `second`: another end effector, whose velocities J_seed may also hold, or -1. The robot must
  /// outlive this object.
  PullBack(const Robot& robot, int end_effector, int second = -1);
  PullBack(const Robot&&, int, int = -1) = delete;

  /// gradient_k = d(t'tau_d + <J_seed, J>)/d q_k for all joints. J and J_seed are about the first
  /// end effector; columns of joints that carry neither end effector do not count. `kinematics`
  /// must be in the state of J, after `gravity_and_buoyancy`.
  void evaluate(const Kinematics<double>& kinematics, const Eigen::Matrix3d& R_base,
                const Matrix6Xd& J, const Eigen::VectorXd& t, const Matrix6Xd& J_seed,
                Eigen::VectorXd& gradient);

  /// The derivative of f at the last state by the twist of the robot as a whole, with all seeds at
  /// the same point: -(sum of all y).
  Vector6d by_twist() const {
    Vector6d slope;
    slope << -nodes_[0].y_v, -nodes_[0].y_w;
    return slope;
  }

 private:
  /// A link and the joint that moves it; index 0 is the base.
  struct Node {
    bool on_chain = false;  ///< carries the end effector
    bool seeded = false;    ///< carries the end effector or the second one
    Eigen::Vector3d v, w, p;
    Eigen::Vector3d y_v, y_w;  ///< sum of y over the link's own and all carried velocities
    Eigen::Vector3d load;      ///< sum of t_i G × w_i over the velocities that carry the link
  };
  void set_base(const Kinematics<double>& kinematics, const Eigen::Matrix3d& R_base,
                const Matrix6Xd& J, const Eigen::VectorXd& t, const Matrix6Xd& J_seed);
  void set_joint(const Kinematics<double>& kinematics, const Eigen::Matrix3d& R_base,
                 const Matrix6Xd& J, std::size_t joint);
  void collect_load(double t, Node& node) const;
  static void collect_seed(const Matrix6Xd& J_seed, Eigen::Index column, Node& node);

  const Robot* robot_;
  const EndEffector* end_effector_;
  Eigen::Vector3d p_e_;  ///< of the end effector, in base axes
  std::vector<Node> nodes_;
};

}  // namespace maxwrench
