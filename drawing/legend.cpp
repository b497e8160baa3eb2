#include "drawing/legend.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kAfterMark = 5;  // px

// Colours of Okabe and Ito, which colour-blind readers can distinguish; none is as light as their
// yellow.
constexpr CurveStyle kCurveStyles[] = {
    {"#222222", "", Mark::kCircle, false},         {"#C77F00", "7 2", Mark::kSquare, true},
    {"#0072B2", "", Mark::kTriangle, false},       {"#009E73", "2 2", Mark::kDiamond, true},
    {"#CC4E00", "7 2 2 2", Mark::kFlipped, false}, {"#CC79A7", "", Mark::kSquare, false},
    {"#3A9BD9", "4 2", Mark::kCircle, true},       {"#8A7A00", "", Mark::kCross, false},
    {"#777777", "7 2 2 2", Mark::kTriangle, true}, {"#5A2A82", "4 2", Mark::kDiamond, false},
    {"#222222", "2 2", Mark::kFlipped, true},      {"#0072B2", "7 2", Mark::kSquare, false}};

}  // namespace

double draw_legend(Svg* svg, const std::vector<LegendEntry>& entries, const Point& corner,
                   double width, int columns) {
  const double column = width / columns;
  int row = 0, next = 0;
  for (const LegendEntry& entry : entries) {
    const double length = kLegendMark + 2 * kAfterMark + text_width(entry.text, Font().size);
    const int span = std::clamp(static_cast<int>(std::ceil(length / column)), 1, columns);
    if (next + span > columns) {
      ++row;
      next = 0;
    }
    const Point left = corner + Point(next * column, (row + 0.5) * kLegendLine);
    next += span;
    if (svg == nullptr) continue;
    entry.mark(*svg, left);
    svg->text(left + Point(kLegendMark + kAfterMark, 4), entry.text, {});
  }
  return entries.empty() ? 0 : (row + 1) * kLegendLine;
}

CurveStyle curve_style(std::size_t i) { return kCurveStyles[i % std::size(kCurveStyles)]; }

void draw_mark(Svg& svg, const Point& at, const CurveStyle& style) {
  svg.mark(at, style.mark, 3.4,
           {.stroke = style.colour, .width = 1.2, .fill = style.open ? "#ffffff" : style.colour});
}

LegendEntry legend_entry(const std::string& text, const CurveStyle& style) {
  return {text, [style](Svg& svg, const Point& left) {
            svg.line(left, left + Point(kLegendMark, 0),
                     {.stroke = style.colour, .width = 1.6, .dash = style.dash});
            draw_mark(svg, left + Point(kLegendMark / 2, 0), style);
          }};
}

}  // namespace maxwrench
