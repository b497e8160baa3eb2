#pragma once

#include <map>
#include <memory>

#include "verify/box_forms.h"
#include "verify/model.h"

namespace maxwrench {

/// Shows that two bodies collide throughout a box of coordinates: a point of one core is, at all
/// control points of its path in the axes of the other core, closer to that than the reach; points
/// that are so close are a convex set. One object serves one thread.
class CollisionProof {
 public:
  /// Keeps references.
  CollisionProof(const Problem& problem, const FormModel& model)
      : problem_(problem), model_(model), box_(model.shape()) {}

  /// Whether it could be shown of a pair of the robot's `CollisionChecker`.
  bool collides(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int pair);

 private:
  /// Points of one core in the axes of the other one, coordinate by coordinate.
  struct Movers {
    Eigen::Vector3d half_sizes;  ///< of the other core
    double reach = 0;
    std::vector<std::array<FormRow, 3>> points;
  };
  const std::vector<Movers>& movers(int pair);
  Movers movers(const InscribedBox& core, const InscribedBox& other, double reach) const;
  bool is_close(const Movers& movers, const std::array<FormRow, 3>& point);
  bool may_be_close(const Movers& movers, const std::array<FormRow, 3>& point) const;

  const Problem& problem_;
  const FormModel& model_;
  BoxForms box_;
  std::map<int, std::vector<Movers>> known_;
  std::vector<double> terms_;  ///< products of terms at the centre of the box, rounded
  std::array<std::vector<Narrow>, 3> x_;
};

}  // namespace maxwrench
