#pragma once

#include <vector>

#include "lib/robot/spatial.h"
#include "maxwrench/robot.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

struct Posture;

/// What each of many currents adds to tau_d of a robot at rest, all at once.
///
/// The load is that of `CurrentLoad`. For the water's velocity V in base axes it is, coordinate by
/// coordinate, the sum of a linear form of V (linear drag), a quadratic form of V (the moment
/// V x (A V) of the added mass A) and of terms g |e'V| e'V, one for each axis e of each body
/// (quadratic drag). So the loads of all currents are one product of matrices.
class CurrentCases {
 public:
  /// Keeps the currents of the cases; their other loads do not count.
  CurrentCases(const Robot& robot, const LoadGroup& cases);
  CurrentCases(const Robot&& robot, const LoadGroup& cases) = delete;

  /// Writes the loads (cases×n) [N, N m] at a posture. Allocates nothing after the first call.
  void evaluate(const Posture& posture, Eigen::ArrayXXd& tau);

 private:
  using Screw = maxwrench::Screw<double>;
  /// An axis of a body that has quadratic drag along it.
  struct DragAxis {
    std::size_t link;
    Eigen::Vector3d at, along;  ///< in link axes
    double damping;
  };
  /// What a link and all that it carries contribute, in base axes.
  struct Composite {
    Eigen::Matrix3d added_mass;           ///< A
    Eigen::Matrix<double, 6, 3> damping;  ///< V to the wrench of linear drag at the base's origin
  };

  void set_coordinates(const Posture& posture);
  void set_composites(const Posture& posture);
  void set_forms();
  void set_terms(const Posture& posture);

  const Robot& robot_;
  std::vector<std::vector<int>> moving_;  ///< of each link: the coordinates that move it
  std::vector<Composite> own_;            ///< of each link alone, in link axes at its origin
  std::vector<DragAxis> axes_;
  std::vector<Screw> coordinates_;  ///< the twist per unit rate of each
  std::vector<Composite> carried_;
  Eigen::ArrayX3d currents_;  ///< in the world
  /// The components of V, their products xx, yy, zz, xy, xz, yz and |e'V| e'V of each axis, for
  /// each case.
  Eigen::MatrixXd terms_;
  Eigen::MatrixXd factors_;  ///< of the terms, for each coordinate
};

}  // namespace maxwrench
