#pragma once

#include <vector>

#include "drawing/face.h"

namespace maxwrench {

/// What opaque faces cover, as samples on a grid.
class Coverage {
 public:
  /// @param box   the part of the plane that counts
  /// @param step  the distance of samples
  Coverage(const Eigen::AlignedBox2d& box, double step);

  /// Covers a convex outline. Returns whether any sample in it was free.
  bool cover(const std::vector<Eigen::Vector2d>& outline);
  /// Whether any sample in it is free.
  bool shows(const std::vector<Eigen::Vector2d>& outline) const;
  /// The share of the samples in a box that are covered; what is outside counts as free.
  double share(const Eigen::AlignedBox2d& box) const;

 private:
  template <class Visit>
  void visit(const std::vector<Eigen::Vector2d>& outline, const Visit& visit) const;

  Eigen::Vector2d corner_;
  double step_;
  int columns_, rows_;
  std::vector<bool> covered_;
};

/// Leaves out the faces that others hide at all samples of a grid.
///
/// @param ordered  the faces, the farthest first
/// @param step     the distance of samples [m], less than what the picture shows
std::vector<Face> visible_faces(const std::vector<Face>& ordered, double step);

}  // namespace maxwrench
