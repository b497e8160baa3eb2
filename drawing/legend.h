#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drawing/svg.h"

namespace maxwrench {

/// The meaning of a mark in a picture.
struct LegendEntry {
  std::string text;
  /// Draws the mark between `left` and `left` + (kLegendMark, 0).
  std::function<void(Svg&, const Eigen::Vector2d& left)> mark;
};

inline constexpr double kLegendMark = 28;  ///< px
inline constexpr double kLegendLine = 16;  ///< px

/// Draws the entries in rows of `columns`; a long text takes several columns. Returns the height.
/// Without `svg` it draws nothing.
double draw_legend(Svg* svg, const std::vector<LegendEntry>& entries, const Eigen::Vector2d& corner,
                   double width, int columns = 3);

/// The style of the i-th of several curves. Marks and dashes distinguish the curves without
/// colours.
struct CurveStyle {
  const char* colour;
  const char* dash;
  Mark mark;
  bool open;  ///< the mark is white inside
};
CurveStyle curve_style(std::size_t i);
void draw_mark(Svg& svg, const Eigen::Vector2d& at, const CurveStyle& style);

LegendEntry legend_entry(const std::string& text, const CurveStyle& style);

}  // namespace maxwrench
