#pragma once

#include <string>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The number of groups with different colours. Further groups repeat them.
inline constexpr std::size_t kBoxColours = 6;

struct BoxAxis {
  std::string name, unit;
  double lower = 0, upper = 0;  ///< limits of the coordinate
};

/// Boxes in d coordinates with the same style.
struct BoxGroup {
  std::string name;   ///< in the legend
  bool grey = false;  ///< drawn in grey instead of a colour
  std::vector<Eigen::VectorXd> lower, upper;
  Eigen::VectorXd mark = {};  ///< a point to mark; none if empty
};

/// Draws the projections of boxes on each pair of coordinates as SVG, a triangle of panels; for one
/// coordinate a strip. Smaller areas are drawn above larger ones. The axes cover all boxes, but not
/// all values between the limits. Throws std::invalid_argument if there are no boxes.
std::string draw_projections(const std::string& title, const std::vector<BoxAxis>& axes,
                             const std::vector<BoxGroup>& groups);

}  // namespace maxwrench
