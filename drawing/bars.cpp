#include "drawing/bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/axes.h"
#include "drawing/legend.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kAxisWidth = 54, kBarsTop = 34, kBarsHeight = 200, kBarsBelow = 24, kBarsRight = 8,
                 kWidestSlot = 60;
const Paint& ours() {
  static const Paint kOurs{.stroke = "#0072B2", .width = 1, .fill = "#A9CDE6"};
  return kOurs;
}
const Paint& measured_paint() {
  static const Paint kMeasured{.stroke = "#111111", .width = 1.8, .dash = "4 2"};
  return kMeasured;
}

/// Draws one group with its axis.
class GroupWriter {
 public:
  /// `left`: the left edge of the group's part of the picture.
  GroupWriter(Svg& svg, const BarGroup& group, double left, double slot)
      : svg_(svg), group_(group), slot_(slot) {
    x_ = {0, static_cast<double>(std::max<std::size_t>(group.bars.size(), 1)), left + kAxisWidth,
          left + kAxisWidth + slot * static_cast<double>(group.bars.size())};
    double largest = 1e-9;
    for (const Bar& bar : group.bars) {
      largest = std::max(largest, size(bar.value));
      for (const double value : bar.measured) largest = std::max(largest, size(value));
    }
    largest *= 1.15;  // room for the numbers
    y_ = make_axis(-largest, largest, kBarsTop + kBarsHeight, kBarsTop, group.unit);
  }

  void draw() {
    draw_y_axis(svg_, x_, y_, round_ticks(y_, 5), group_.unit);
    for (std::size_t i = 0; i < group_.bars.size(); ++i) {
      bar(group_.bars[i], x_(static_cast<double>(i) + 0.5));
    }
    svg_.line({x_.from, y_(0)}, {x_.to, y_(0)}, {.stroke = "#222222", .width = 1});
  }

 private:
  /// The magnitude; infinity for NaN, which the axis rejects.
  static double size(double value) { return std::isnan(value) ? kInfinity : std::abs(value); }

  void bar(const Bar& bar, double centre) {
    const double l = centre - 0.3 * slot_, r = centre + 0.3 * slot_;
    svg_.polygon({{l, y_(0)}, {r, y_(0)}, {r, y_(bar.value)}, {l, y_(bar.value)}}, ours());
    for (const double value : bar.measured) {
      svg_.line({centre - 0.45 * slot_, y_(value)}, {centre + 0.45 * slot_, y_(value)},
                measured_paint());
    }
    svg_.text({centre, y_(bar.value) + (bar.value < 0 ? 13 : -5)}, with_minus(bar.value, "{:.1f}"),
              {.anchor = Anchor::kMiddle});
    svg_.text({centre, y_.from + 15}, bar.name, {.anchor = Anchor::kMiddle});
  }

  Svg& svg_;
  const BarGroup& group_;
  double slot_;
  Axis x_, y_;
};

}  // namespace

std::string draw_bars(const std::string& title, const std::vector<BarGroup>& groups,
                      const std::string& measured) {
  std::size_t bars = 0;
  for (const BarGroup& group : groups) bars += group.bars.size();
  const double axes = (kAxisWidth + kBarsRight) * static_cast<double>(groups.size());
  const double slot = std::min(
      kWidestSlot, (kPageWidth - axes) / static_cast<double>(std::max<std::size_t>(bars, 1)));
  const std::vector<LegendEntry> legend = {
      {"ours",
       [](Svg& svg, const Point& left) {
         svg.polygon({left + Point(0, -5), left + Point(kLegendMark, -5),
                      left + Point(kLegendMark, 5), left + Point(0, 5)},
                     ours());
       }},
      {measured, [](Svg& svg, const Point& left) {
         svg.line(left, left + Point(kLegendMark, 0), measured_paint());
       }}};
  const Point corner(kAxisWidth, kBarsTop + kBarsHeight + kBarsBelow);
  const double width = kPageWidth - kAxisWidth;
  Svg svg(kPageWidth, corner.y() + draw_legend(nullptr, legend, corner, width) + 8);
  svg.text({kPageWidth / 2, 18}, title, {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  double left = 0;
  for (const BarGroup& group : groups) {
    GroupWriter(svg, group, left, slot).draw();
    left += kAxisWidth + slot * static_cast<double>(group.bars.size()) + kBarsRight;
  }
  draw_legend(&svg, legend, corner, width);
  return svg.str();
}

}  // namespace maxwrench
