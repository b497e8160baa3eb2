#pragma once

#include <optional>

#include "lib/robot/kinematics.h"
#include "maxwrench/problem.h"
#include "solvers/certify/bound/multi_affine.h"

namespace maxwrench {

/// How the forces of a second contact enter the rows of tau.
enum class ContactForces {
  kShares,  ///< as coordinates of x
  kOfBase   ///< as what the thrusters and the loads leave on the base: `levers`
};

/// With more thrusters, patterns of their limits and control points would not be one `int`.
inline constexpr std::size_t kMostPatternThrusters = 12;

/// Whether a second contact has all three forces, without limits, and no torques, on a base that
/// moves along all six axes, by few thrusters. The base's linear axes then determine the forces.
bool base_determines_forces(const Problem& problem);

/// The index in theta_r of the first joint of the chain, if it turns about the yaw of a parked base
/// that also moves along x and y; else none. The base can turn in place of this joint: x and y make
/// up for the shift, and from this joint on the chain is where it was. So no value depends on it,
/// apart from collisions with the base. Proofs leave it out.
std::optional<int> coordinate_about_yaw(const Problem& problem);
/// The same for `make_capability_bound`, which leaves it out for a single wrench and linf_polytope.
std::optional<int> left_out_coordinate(const Problem& problem, const std::string& measure,
                                       Wrench wrench);

/// All coordinates x of a posture:
///
///     x = [theta_r; dependent joints; joints of a second arm; yaw; shares of contact forces].
///
/// The yaw is the base's, if it is free and the base does not follow in closed form. A share omega
/// in [0, 1] of a component of the second contact's wrench stands for
///
///     w = w_min + omega (w_max - w_min) + t (v_min + omega (v_max - v_min)),
///
/// with t the value, at least zero if v is not zero. A component that has no limit of its own is
/// bounded by what the base's linear axes can bear in addition to t c.
///
/// The coordinate about the yaw can be left out of the chain. Its joint then rests, and the yaw is
/// that of a base that has turned in its place.
///
/// The chain has this order: the second arm's joints; from the world to the end effector, the yaw,
/// the joints from the base outward and the free coordinates of the pose; the regrasp coordinates;
/// the shares. Angles are within one turn.
struct LoopCoordinates {
  struct Stretch {
    int from = 0, to = 0;
    int count() const { return to - from; }
  };

  /// Throws std::invalid_argument with one line if shares have no limits. With `kOfBase` there are
  /// no shares. `about_yaw`: the coordinate to leave out, or none.
  explicit LoopCoordinates(const Problem& problem, ContactForces forces = ContactForces::kShares,
                           std::optional<int> about_yaw = std::nullopt);

  Coordinates chain;  ///< as indices into x
  Stretch second, yaw, first, free, regrasp, shares;
  std::vector<int> joints;         ///< of the robot, in `first`
  int left_out = -1;               ///< the coordinate that is left out, or -1
  std::optional<int> resting;      ///< its joint, which comes before these
  bool base_is_dependent = false;  ///< its pose follows from the joints in closed form
  Eigen::VectorXd lower, upper;    ///< limits of x
  Eigen::VectorXd w_min, w_max;    ///< of the second contact's w, finite
  Eigen::VectorXd v_min, v_max;    ///< change of these limits per unit of t
  bool forces_grow() const { return (v_min.array() != v_max.array()).any(); }

 private:
  void add(int at, bool turns, double low, double high);
  void add_joint(const Problem& problem, int at, int joint);
  void limit_forces(const Problem& problem);
};

/// The parts of a posture at any x, in the precision of `Extended`. All of them are multi-affine.
/// Weight and contact force load joint i only through the joints behind it, and are turned once by
/// each of them, from the end effector's pose. They load the base through its yaw.
///
/// If x is a posture, the pose of the base in its mount satisfies, unless it follows in closed
/// form,
///
///     Rz(yaw) T_1(q_1) ... T_k(q_k) = mount^-1 X(s) (T_k+1(q_k+1) ... T_n(q_n))^-1
///
/// in all rows of the rotation, and in those of the position that no free axis moves. The second
/// end effector is at the contact, T_e2(q_2) = T_e1(q_1) X(s)^-1 F(s_2), in position or in position
/// and rotation.
class LoopPosture {
 public:
  /// Keeps references to both.
  LoopPosture(const Problem& problem, const LoopCoordinates& coordinates);

  /// Other wrenches of the task, 6×k, whose J'W `columns` returns.
  void carry(const Matrix6Xd& W) { W_ = W; }
  void set(const ExtendedVector& x);

  /// [tau_d; J'c], 2n.
  const ExtendedVector& loads() const { return loads_; }
  /// J'W of `carry`, n×k.
  const MatrixX<Extended>& columns() const { return columns_; }
  /// J_2'C_2 w_2, n, at t = 0; and its change per unit of t.
  ExtendedVector forces() const { return forces(w_); }
  ExtendedVector forces_by_t() const { return forces(v_); }
  /// A (n×3): the second contact's force F, in base axes, adds A F to tau. The first rows of A are
  /// the identity, and A depends on the second arm's joints only. The base's linear rows give F =
  /// B_f u - tau_f - t a_f.
  MatrixX<Extended> levers() const;
  /// The rows of the left and the right side of the base's equations, with k joints on the left.
  ExtendedVector left(int k) const;
  ExtendedVector right(int k) const;
  /// The rows of the second contact's equations: the side of the second arm, and that of the pose
  /// that it touches.
  ExtendedVector touching() const;
  ExtendedVector touched() const;

 private:
  ExtendedVector rows_of(const Pose<Extended>& pose) const;
  ExtendedVector contact_rows(const Pose<Extended>& pose) const;
  ExtendedVector forces(const ExtendedVector& w) const;
  Pose<Extended> link(int k) const;
  void set_contact(const ExtendedVector& x);
  void set_loads(const Matrix3<Extended>& from_tip);

  const Problem& problem_;
  const LoopCoordinates& coordinates_;
  const EndEffector& tip_;
  Kinematics<Extended> kinematics_;
  Pose<Extended> yaw_, pose_, target_;  ///< of the base; X(s); mount^-1 X(s)
  Pose<Extended> contact_;              ///< F(s_2)
  Matrix3<Extended> R_base_;
  ExtendedVector q_, loads_, tau_, w_, v_;
  Matrix6X<Extended> J_;
  Matrix6Xd W_ = Matrix6Xd(6, 0);
  MatrixX<Extended> columns_;
};

}  // namespace maxwrench
