#pragma once

#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// Finds the edge of a convex set in the plane that is nearest to the origin, from its support
/// function alone: the unit direction d with the least h(d) = max d'x over the set.
///
/// The least h(d) is the radius of the largest disc about the origin in the set, or negative if the
/// set leaves out the origin. Of a polygon, d is the normal of an edge or one of the axes (of a
/// point or a segment). The caller answers questions for h, beginning with the four axes:
///
///     for (edge.start(); edge.asks();) { ... edge.answer(value, point); }
///
/// After that the chord between two known points that is nearest to the origin, by `inner`, is
/// pushed outwards along its normal, until no chord is nearer than the least h(d). So most of the
/// other edges are never asked for. It allocates nothing after the first polygons.
class NearestEdge {
 public:
  NearestEdge();

  /// Begins with another set.
  void start();
  /// Whether a direction is left whose support is needed; it is `direction` then.
  bool asks();
  /// The unit direction that is asked for.
  const Eigen::Vector2d& direction() const { return direction_; }
  /// Tells the support along `direction`, and a point where it is attained.
  void answer(double value, const Eigen::Vector2d& point);

  /// The least h(d) of the directions asked so far: an upper bound of the result.
  double value() const { return value_; }
  /// Its direction.
  const Eigen::Vector2d& normal() const { return normal_; }
  /// The least distance of a chord, a lower bound of the result. -infinity before four answers.
  double inner() const { return inner_; }

 private:
  /// A chord from this point to that of the next one, and whether it is an edge.
  struct Chord {
    Eigen::Vector2d from;
    bool is_edge = false;
  };

  /// The distance of a chord along its outward normal; infinite for a chord of no length.
  double distance(std::size_t chord, Eigen::Vector2d& normal) const;

  std::vector<Chord> chords_;  ///< counterclockwise
  std::size_t asked_ = 0;      ///< the chord whose normal is asked for
  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero(), normal_ = direction_;
  double value_ = kInfinity, inner_ = -kInfinity;
};

}  // namespace maxwrench
