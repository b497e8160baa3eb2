#include "drawing/scatter.h"

#include <algorithm>
#include <cmath>

#include "drawing/axes.h"
#include "drawing/legend.h"
#include "drawing/named_curves.h"

namespace maxwrench {
namespace {

// px
constexpr double kScatterLeft = 52, kScatterTop = 12, kScatterHeight = 200, kScatterBottom = 44,
                 kScatterRight = 14;

bool can_be_drawn(const Eigen::Vector2d& point) {
  return point.allFinite() && point.minCoeff() > 0;
}

/// A logarithmic axis for one coordinate of all points, a third of a decade wider on each side.
Axis axis_around(const ScatterPanel& panel, int coordinate, double from, double to,
                 const std::string& name) {
  double low = kInfinity, high = -kInfinity;
  for (const ScatterSet& set : panel.sets) {
    for (const Eigen::Vector2d& point : set.points) {
      if (!can_be_drawn(point)) continue;
      low = std::min(low, std::log10(point[coordinate]));
      high = std::max(high, std::log10(point[coordinate]));
    }
  }
  return make_axis(low - 0.3, high + 0.3, from, to, name);
}

/// Ticks at powers of ten, and on a short axis also at 2 and 5 times these.
std::vector<Tick> decade_ticks(const Axis& axis) {
  std::vector<Tick> ticks;
  const bool is_short = axis.high - axis.low < 2;
  for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade) {
    for (const int factor : {1, 2, 5}) {
      const double value = decade + std::log10(factor);
      if (value < axis.low || value > axis.high || (factor > 1 && !is_short)) continue;
      ticks.push_back(
          {value, factor == 1 ? decade_label(decade) : with_minus(factor * std::pow(10, decade))});
    }
  }
  return ticks;
}

}  // namespace

std::string draw_scatter(const ScatterPanel& panel) {
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; i < panel.sets.size(); ++i) {
    const CurveStyle style = curve_style(i);
    legend.push_back({panel.sets[i].name, [style](Svg& svg, const Eigen::Vector2d& left) {
                        draw_mark(svg, left + Eigen::Vector2d(kLegendMark / 2, 0), style);
                      }});
  }
  const Eigen::Vector2d corner(kScatterLeft, kScatterTop + kScatterHeight + kScatterBottom);
  const double wide = kPageWidth - kScatterLeft - kScatterRight;
  Svg svg(kPageWidth, corner.y() + draw_legend(nullptr, legend, corner, wide) + 8);
  const Axis x = axis_around(panel, 0, kScatterLeft, kPageWidth - kScatterRight, panel.x_axis);
  const Axis y = axis_around(panel, 1, kScatterTop + kScatterHeight, kScatterTop, panel.y_axis);
  draw_x_axis(svg, x, y, decade_ticks(x), panel.x_axis);
  draw_y_axis(svg, x, y, decade_ticks(y), panel.y_axis);
  draw_frame(svg, x, y);
  for (std::size_t i = 0; i < panel.sets.size(); ++i) {
    for (const Eigen::Vector2d& point : panel.sets[i].points) {
      if (!can_be_drawn(point)) continue;
      draw_mark(svg, {x(std::log10(point.x())), y(std::log10(point.y()))}, curve_style(i));
    }
  }
  draw_legend(&svg, legend, corner, wide);
  return svg.str();
}

}  // namespace maxwrench
