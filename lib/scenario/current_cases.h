#pragma once

#include <vector>

#include "lib/robot/spatial.h"
#include "maxwrench/robot.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

struct Posture;

/// What each of many currents adds to tau_d of a robot at rest, along normals n: n'tau.
///
/// tau is that of `CurrentLoad`. n'tau is the power of the water's forces if the robot moves with
/// the velocities n. With the water's velocity V in world axes it is a'V + V'M V + sum_i w_i
/// |e_i'V| e_i'V: linear drag, the moment V x (A V) of the added mass A, and quadratic drag along
/// each axis e_i of each body. Opposite currents differ in the sign of the first and the last part.
class CurrentCases {
 public:
  /// Keeps the currents of the cases; their other loads do not count.
  CurrentCases(const Robot& robot, const LoadGroup& cases);
  CurrentCases(const Robot&& robot, const LoadGroup& cases) = delete;

  /// Bounds of |tau| [N, N m] over all cases and all postures within the limits of prismatic joints
  /// (n), which may be infinite.
  const Eigen::VectorXd& most() const { return most_; }

  /// Moves to a posture. This and the calls below allocate nothing after the first.
  void set(const Posture& posture);
  /// Chooses n and computes a, M and w.
  void aim(const Eigen::VectorXd& n);
  /// A bound of |n'tau| over all cases, from the largest speed.
  double bound() const;
  /// Returns the largest side n'tau of all cases, with the case that has it. The side is 1 or -1.
  double worst(double side, int& which);

 private:
  /// An axis of a body that has quadratic drag along it.
  struct DragAxis {
    std::size_t link;
    Eigen::Vector3d at, along;  ///< in link axes
    double damping;
    /// e, and the point of the body x e, in world axes.
    Eigen::Vector3d e = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  };
  /// What the water does to the bodies of a link.
  struct Water {
    std::size_t link = 0;
    Eigen::Matrix3d added_mass = Eigen::Matrix3d::Zero();  ///< A, in link axes
    /// V to the wrench of linear drag, at the link's origin.
    Eigen::Matrix<double, 6, 3> damping = Eigen::Matrix<double, 6, 3>::Zero();
    bool has_damping = false;
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();  ///< in world axes
  };

  void add_link(std::size_t link);
  void pair_opposites(const LoadGroup& cases);
  void set_most();
  double farthest(std::size_t first, std::size_t link) const;

  const Robot& robot_;
  std::vector<Water> water_;
  std::vector<DragAxis> axes_;
  double speed_ = 0;      ///< the largest of the currents
  Eigen::Vector3d used_;  ///< 1 for each axis of the world along which some current flows, else 0
  Eigen::VectorXd most_;
  /// Of each pair of opposite currents, then of each current alone: V, the products xx, yy, zz, xy,
  /// xz and yz of its components, and the cases of V and -V (-1: none).
  Eigen::ArrayX3d V_;
  Eigen::MatrixXd products_;
  std::vector<int> forward_, backward_;
  Eigen::Index pairs_ = 0;

  Eigen::Matrix3d R_;                          ///< of the base
  std::vector<Pose<double>> frames_;           ///< of the links, in world axes about the base
  std::vector<Screw<double>> joints_, links_;  ///< twist per unit rate of a joint; of links by n
  Eigen::Vector3d a_;
  Eigen::Matrix<double, 6, 1> m_;  ///< the factors of the products in V'M V
  Eigen::VectorXd w_;
  Eigen::ArrayXd odd_, even_, along_, total_;
};

}  // namespace maxwrench
