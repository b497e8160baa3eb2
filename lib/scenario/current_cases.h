#pragma once

#include <vector>

#include "lib/robot/spatial.h"
#include "maxwrench/robot.h"
#include "maxwrench/scenario.h"

namespace maxwrench {

struct Posture;

/// What each of many currents adds to tau_d of a robot at rest.
///
/// The load is that of `CurrentLoad`. For the water's velocity V in base axes it is, coordinate by
/// coordinate, the sum of a linear form of V (linear drag), a quadratic form of V (the moment
/// V x (A V) of the added mass A) and of terms g |e'V| e'V, one for each axis e of each body
/// (quadratic drag). So tau = F't with factors F of the posture and terms t of the current, and
/// bounds of t give bounds of tau without a look at any case.
class CurrentCases {
 public:
  /// Keeps the currents of the cases; their other loads do not count.
  CurrentCases(const Robot& robot, const LoadGroup& cases);
  CurrentCases(const Robot&& robot, const LoadGroup& cases) = delete;

  /// Moves to a posture, which must outlive the calls below. They allocate nothing after the first.
  void set(const Posture& posture);
  /// Writes an interval of each coordinate [N, N m], centre and half its width (n), that holds the
  /// loads of all cases. It may be wider than theirs.
  void bound(Eigen::ArrayXd& centre, Eigen::ArrayXd& half);
  /// Writes normal'tau of each case. The first call at a posture computes the terms of all cases.
  void project(const Eigen::Ref<const Eigen::VectorXd>& normal, Eigen::ArrayXd& values);

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
  void set_axes();
  void set_terms();
  double reach(const Eigen::Vector3d& along) const;

  const Robot& robot_;
  std::vector<std::vector<int>> moving_;  ///< of each link: the coordinates that move it
  std::vector<Composite> own_;            ///< of each link alone, in link axes at its origin
  std::vector<DragAxis> axes_;
  std::vector<Screw> coordinates_;  ///< the twist per unit rate of each
  std::vector<Composite> carried_;
  Eigen::ArrayX3d currents_;  ///< in the world
  double speed_ = 0;          ///< the largest of the currents
  Eigen::Vector3d used_;  ///< 1 for each axis of the world along which some current flows, else 0
  const Posture* posture_ = nullptr;
  Eigen::Matrix3Xd along_;  ///< each axis e, in base axes
  /// The components of V, their products xx, yy, zz, xy, xz, yz and |e'V| e'V of each axis, for
  /// each case.
  Eigen::MatrixXd terms_;
  bool has_terms_ = false;                    ///< whether `terms_` are those of the posture
  Eigen::MatrixXd factors_;                   ///< F: of the terms, for each coordinate
  Eigen::VectorXd middle_, width_, weights_;  ///< of each term: its bound, and its weight in a row
};

}  // namespace maxwrench
