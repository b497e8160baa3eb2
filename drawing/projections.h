#pragma once

#include <string>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// So many groups have colours of their own; more would begin again.
inline constexpr std::size_t kBoxColours = 6;

struct BoxAxis {
  std::string name, unit;
  double lower = 0, upper = 0;  ///< limits of the coordinate
};

/// Boxes in d coordinates that look alike.
struct BoxGroup {
  std::string name;   ///< in the legend
  bool grey = false;  ///< no colour of its own
  std::vector<Eigen::VectorXd> lower, upper;
  Eigen::VectorXd mark = {};  ///< a point that is marked; empty: none
};

/// The projections of boxes on each pair of coordinates as SVG, a triangle of panels, of one
/// coordinate a strip. What is smaller lies above. The axes hold all boxes, not all between the
/// limits. Throws std::invalid_argument without boxes.
std::string draw_projections(const std::string& title, const std::vector<BoxAxis>& axes,
                             const std::vector<BoxGroup>& groups);

}  // namespace maxwrench
