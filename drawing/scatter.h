#pragma once

#include <span>
#include <string>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

struct ScatterSet {
  std::string name;
  std::vector<Eigen::Vector2d> points;
};

struct ScatterPanel {
  std::string x_axis, y_axis;
  std::vector<ScatterSet> sets;
};

/// Draws a panel as SVG, with both axes logarithmic. Sets differ in mark and colour. Points that
/// are not positive and finite are left out. Throws std::invalid_argument if none is left.
std::string draw_scatter(const ScatterPanel& panel);

}  // namespace maxwrench
