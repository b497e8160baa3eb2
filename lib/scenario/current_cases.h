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

  /// A bound of |n'tau| over all cases and all postures within the limits of prismatic joints. It
  /// is not finite if nothing limits their arms.
  double most(const Eigen::VectorXd& n) const;

  /// Moves to a posture, which must stay as it is until the next call. This and the calls below
  /// allocate nothing after the first.
  void set(const Posture& posture);
  /// Chooses n and computes a, M and w.
  void aim(const Eigen::VectorXd& n);
  /// A bound of |n'tau| over all cases, from the largest speed.
  double bound() const { return bound_; }
  /// Returns the largest side n'tau of all cases, with the first case that has it. The side is 1 or
  /// -1. Directions are estimated in single precision first: only those that rounding may have kept
  /// from being the worst are computed.
  double worst(double side, int& which);

 private:
  /// What the water does to a body.
  struct Body {
    std::size_t link = 0;
    Pose<double> frame;                 ///< link -> body
    bool turned = false;                ///< whether its axes are not those of the link
    Eigen::Vector3d linear, quadratic;  ///< drag along its axes
    bool has_linear = false;
    Eigen::Vector3d munk;  ///< added masses along its axes: zz - yy, xx - zz and yy - xx
    Pose<double> at;       ///< its pose relative to the base
    Eigen::Matrix3d E;     ///< its axes, in those of the world
  };
  /// Quadratic drag along an axis: w |e'V| e'V.
  template <class T>
  struct DragAxis {
    T w = 0;
    T e[3] = {0, 0, 0};
    T most = 0;  ///< |w| |e|^2
  };

  void pair_opposites(const LoadGroup& cases);
  void set_most();
  double farthest(std::size_t first, std::size_t link) const;
  Screw<double> base_twist(const Eigen::VectorXd& n) const;
  void move_links(const Eigen::VectorXd& n);
  void add(const Body& body);
  template <bool kHorizontal>
  void estimate();
  double larger(Eigen::Index i, double side, int& which) const;

  const Robot& robot_;
  std::vector<Body> bodies_;
  double speed_ = 0;                         ///< the largest of the currents
  bool horizontal_ = false;                  ///< whether no current has a part along z
  double most_force_ = 0, most_moment_ = 0;  ///< on the base
  Eigen::VectorXd most_of_joints_;
  /// Of each pair of opposite currents, then of each current alone: V, and the cases of V and -V
  /// (-1: none).
  Eigen::MatrixX3d V_;
  std::vector<int> forward_, backward_;

  const Posture* posture_ = nullptr;
  std::vector<Screw<double>> links_;  ///< twists of the links by n
  // a, M and w, in world axes. Where all currents are horizontal, parts along z are left out.
  Eigen::Vector3d a_;
  Eigen::Matrix<double, 6, 1> m_;  ///< factors of xx, yy, zz, xy, xz and yz in V'M V
  std::vector<DragAxis<double>> axes_;
  double bound_ = 0;

  // Estimates: V divided by the speed, and both parts of n'tau divided by the bound.
  Eigen::ArrayX3f U_;      ///< with further rows of zeros
  Eigen::ArrayXf mirror_;  ///< -1 of a pair, 1 of a current alone
  std::vector<DragAxis<float>> estimated_axes_;
  Eigen::ArrayXf odd_, even_, total_;
  bool estimated_ = false;  ///< whether they are those of n
};

}  // namespace maxwrench
