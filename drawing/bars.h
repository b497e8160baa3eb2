#pragma once

#include <string>
#include <vector>

namespace maxwrench {

struct Bar {
  std::string name;
  double value = 0;
  std::vector<double> measured;  ///< values to compare with, drawn as dashes
};

/// Bars with a common unit and scale.
struct BarGroup {
  std::string unit;
  std::vector<Bar> bars;
};

/// Draws groups of bars side by side as SVG. `measured` is the legend text of the dashes.
std::string draw_bars(const std::string& title, const std::vector<BarGroup>& groups,
                      const std::string& measured);

}  // namespace maxwrench
