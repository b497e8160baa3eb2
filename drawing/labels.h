#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drawing/svg.h"

namespace maxwrench {

/// A few words beside a place of the picture.
struct Label {
  std::vector<std::string> lines;
  Eigen::Vector2d at;  ///< px, the place
  std::string colour;
  bool bold = false;
};

/// A label with its place on the picture [px].
struct PlacedLabel {
  Label label;
  Eigen::AlignedBox2d box;
};

/// Finds places for labels, the most important first, so that none overlaps another. A label is
/// near its place and, if it can, on free ground. One without any place is left out.
///
/// @param labels   the labels
/// @param bounds   px, where labels may be
/// @param covered  the share of a box [px] that the picture covers, from 0 to 1
std::vector<PlacedLabel> place_labels(
    const std::vector<Label>& labels, const Eigen::AlignedBox2d& bounds,
    const std::function<double(const Eigen::AlignedBox2d&)>& covered);

/// Draws labels, with lines to their places where these are not beside them.
void draw_labels(Svg& svg, const std::vector<PlacedLabel>& labels);

}  // namespace maxwrench
