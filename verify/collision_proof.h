#pragma once

#include <map>
#include <memory>

#include "verify/box_forms.h"
#include "verify/model.h"
#include "verify/nearest_means.h"

namespace maxwrench {

/// Proves that two bodies collide throughout a box of coordinates. Take a point of one core and its
/// path in the axes of the other core. At all control points of the path it must be closer to the
/// other core than the reach. The points that are this close form a convex set, so the whole path
/// is in it. If one of the cores is a hull, the point is chosen for the box, and a box without a
/// proof is cut into parts that have one. Not thread-safe: use one object for each thread.
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
    /// With a hull: the origin of the core's link, then the directions of the link's axes.
    std::vector<std::array<FormRow, 3>> points;
    std::vector<int> others, moving;  ///< coordinates of x that move none of the points, or some
    std::vector<Eigen::Vector3d> solid, other_solid;  ///< with a hull: corners of the cores
    bool into_hull = false;                           ///< whether the other core is a hull
  };
  enum class Answer { kYes, kUnknown, kNo };
  const std::vector<Movers>& movers(int pair);
  Answer with_hull(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                   const std::vector<Movers>& both);
  bool with_hull_in_parts(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                          const std::vector<Movers>& both, int& left);
  std::vector<Eigen::Vector3d> choose_points(const Movers& movers) const;
  bool stays_close(const Movers& movers, const Eigen::Vector3d& x);
  bool is_near_hull(const Movers& movers, const std::array<Narrow, 3>& x);
  Movers movers(const InnerBody& core, const InnerBody& other, double reach) const;
  bool set_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Movers& movers);
  bool is_close(const Movers& movers, const std::array<FormRow, 3>& point);
  bool may_be_close(const Movers& movers, const std::array<FormRow, 3>& point) const;

  const Problem& problem_;
  const FormModel& model_;
  BoxForms box_;
  std::map<int, std::vector<Movers>> known_;
  std::vector<double> terms_;  ///< products of terms at the centre of the box, rounded
  std::array<std::vector<Narrow>, 3> x_;
  WeightedMean mean_;  ///< the last one that was near
  Eigen::VectorXd lower_, upper_;
};

}  // namespace maxwrench
