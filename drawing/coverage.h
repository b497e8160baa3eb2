#pragma once

#include <vector>

#include "drawing/face.h"

namespace maxwrench {

/// Samples in an outline: all, and those that are hidden by what was covered before.
struct Samples {
  long all = 0, hidden = 0;
};

/// What opaque faces cover, as samples on a grid.
class Coverage {
 public:
  /// @param box   the part of the plane that counts
  /// @param step  the distance of samples
  Coverage(const Eigen::AlignedBox2d& box, double step);

  /// Covers a convex outline. Returns what of it was covered before.
  Samples cover(const std::vector<Eigen::Vector2d>& outline);
  /// What of a convex outline is covered.
  Samples samples(const std::vector<Eigen::Vector2d>& outline) const;
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

/// Faces in order, the farthest first.
struct VisibleFaces {
  std::vector<Face> seen;  ///< at least in part
  /// Hidden at least in part by faces that do not shine through, and do so; without lines.
  std::vector<Face> hidden;
};

/// Finds which faces are seen, by the samples of a grid.
///
/// @param ordered  the faces, the farthest first
/// @param step     the distance of samples [m], less than what the picture shows
VisibleFaces visible_faces(const std::vector<Face>& ordered, double step);

}  // namespace maxwrench
