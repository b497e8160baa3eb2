#pragma once

#include <string>
#include <vector>

namespace maxwrench {

struct Bar {
  std::string name;
  double value = 0;
  std::vector<double> measured;  ///< to compare with, drawn as dashes
};

/// Bars in one unit on a scale of their own.
struct BarGroup {
  std::string unit;
  std::vector<Bar> bars;
};

/// Groups of bars side by side as SVG. `measured` says what the dashes are.
std::string draw_bars(const std::string& title, const std::vector<BarGroup>& groups,
                      const std::string& measured);

}  // namespace maxwrench
