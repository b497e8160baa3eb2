#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drawing/svg.h"

namespace maxwrench {

/// What a mark of a picture means.
struct LegendEntry {
  std::string text;
  /// Draws the mark between `left` and `left` + (kLegendMark, 0).
  std::function<void(Svg&, const Eigen::Vector2d& left)> mark;
};

inline constexpr double kLegendMark = 28;  ///< px
inline constexpr double kLegendLine = 16;  ///< px

/// In rows of so many columns; a long text takes several of them. Returns the height; with no `svg`
/// it draws nothing.
double draw_legend(Svg* svg, const std::vector<LegendEntry>& entries, const Eigen::Vector2d& corner,
                   double width, int columns = 3);

/// How the i-th of several curves looks. Read in grey, marks and dashes tell them apart.
struct CurveStyle {
  const char* colour;
  const char* dash;
  Mark mark;
  bool open;  ///< the mark is white inside
};
CurveStyle curve_style(std::size_t i);
void draw_mark(Svg& svg, const Eigen::Vector2d& at, const CurveStyle& style);

/// The entry of a curve.
LegendEntry legend_entry(const std::string& text, const CurveStyle& style);

}  // namespace maxwrench
