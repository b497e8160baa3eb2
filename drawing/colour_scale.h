#pragma once

#include <cstdint>
#include <string>

#include "drawing/axes.h"

namespace maxwrench {

/// A colour for each value between two limits, from dark blue to yellow. Its lightness grows with
/// the value, so it can be told in grey and by colour-blind readers (viridis, van der Walt and
/// Smith 2015, by its values at quarters).
class ColourScale {
 public:
  /// Equal limits count as a little apart. Throws std::invalid_argument for limits that cannot be
  /// drawn.
  ColourScale(double low, double high);
  /// 0xRRGGBB.
  std::uint32_t operator()(double value) const;
  std::string text(double value) const;  ///< "#rrggbb"
  /// Draws the scale upwards from `foot`, with its ticks to the right and the name above.
  void draw(Svg& svg, const Eigen::Vector2d& foot, double height, const std::string& name) const;

 private:
  double low_, high_;
};

}  // namespace maxwrench
