#pragma once

#include <map>
#include <memory>

#include "verify/box_forms.h"
#include "verify/model.h"

namespace maxwrench {

/// Proves that two bodies collide throughout a box of coordinates. Take a point of one core and its
/// path in the axes of the other core. At all control points of the path it must be closer to the
/// other core than the reach. The points that are this close form a convex set, so the whole path
/// is in it. Not thread-safe: use one object for each thread.
class CollisionProof {
 public:
  /// Keeps references to both.
  CollisionProof(const Problem& problem, const FormModel& model)
      : problem_(problem), model_(model), box_(model.shape()) {}

  /// Whether the proof succeeds for a pair of the robot's `CollisionChecker`.
  bool collides(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int pair);

 private:
  /// Points of one core in the axes of the other core, coordinate by coordinate.
  struct Movers {
    Eigen::Vector3d half_sizes;  ///< of the other core
    double reach = 0;
    std::vector<std::array<FormRow, 3>> points;
    std::vector<int> others;  ///< coordinates of x that move none of the points
  };
  const std::vector<Movers>& movers(int pair);
  Movers movers(const InscribedBox& core, const InscribedBox& other, double reach) const;
  bool set_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Movers& movers);
  bool is_close(const Movers& movers, const std::array<FormRow, 3>& point);
  bool may_be_close(const Movers& movers, const std::array<FormRow, 3>& point) const;

  const Problem& problem_;
  const FormModel& model_;
  BoxForms box_;
  std::map<int, std::vector<Movers>> known_;
  std::vector<double> terms_;  ///< products of terms at the centre of the box, rounded
  std::array<std::vector<Narrow>, 3> x_;
  Eigen::VectorXd lower_, upper_;
};

}  // namespace maxwrench
