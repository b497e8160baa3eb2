#include "cli/bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/svg.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kAxis = 56, kSlot = 58, kBar = 34, kTop = 40, kHeight = 240, kBelow = 62,
                 kRight = 16;
constexpr const char* kOurs = "#0072B2";
constexpr const char* kMeasured = "#E69F00";

double width(const BarGroup& group) {
  return kAxis + kSlot * static_cast<double>(group.bars.size()) + kRight;
}

/// Draws one group with its axis; `left` is the left edge of its share of the picture.
void draw_group(Svg& svg, const BarGroup& group, double left) {
  double largest = 1e-9;
  for (const Bar& bar : group.bars) {
    largest = std::max({largest, std::abs(bar.value), bar.measured});
  }
  const double scale = kHeight / 2 / (1.12 * largest);
  const auto y = [&](double value) { return kTop + kHeight / 2 - scale * value; };
  const double x0 = left + kAxis, x1 = left + width(group) - kRight;
  const double step = round_step(largest / 2);
  for (double tick = -step * std::floor(1.12 * largest / step); tick <= 1.12 * largest;
       tick += step) {
    svg.line({x0, y(tick)}, {x1, y(tick)}, {.stroke = "#e8e8e8", .width = 0.8});
    const std::string digits = fmt::format("{:.6g}", std::abs(tick));
    svg.text({x0 - 6, y(tick) + 3.5}, tick < -step / 2 ? "\u2212" + digits : digits,
             {.size = 10, .anchor = Anchor::kEnd});
  }
  for (std::size_t i = 0; i < group.bars.size(); ++i) {
    const Bar& bar = group.bars[i];
    const double centre = x0 + kSlot * (static_cast<double>(i) + 0.5);
    const double l = centre - kBar / 2, r = centre + kBar / 2;
    svg.polygon({{l, y(0)}, {r, y(0)}, {r, y(bar.value)}, {l, y(bar.value)}}, {.fill = kOurs});
    const double beyond = y(bar.value) + (bar.value < 0 ? 12 : -4);
    svg.text({centre, beyond},
             fmt::format("{}{:.1f}", bar.value < 0 ? "\u2212" : "", std::abs(bar.value)),
             {.size = 10.5, .anchor = Anchor::kMiddle});
    if (bar.measured > 0) {
      for (const double side : {-bar.measured, bar.measured}) {
        svg.line({centre - kSlot / 2 + 4, y(side)}, {centre + kSlot / 2 - 4, y(side)},
                 {.stroke = kMeasured, .width = 2, .dash = "5 3"});
      }
    }
    svg.text({centre, kTop + kHeight + 16}, bar.name, {.size = 11.5, .anchor = Anchor::kMiddle});
  }
  svg.line({x0, y(0)}, {x1, y(0)}, {.stroke = "#222222", .width = 1});
  svg.text({left + 14, kTop + kHeight / 2}, group.unit,
           {.size = 11, .anchor = Anchor::kMiddle, .angle = 90});
}

}  // namespace

std::string draw_bars(const std::string& title, const std::vector<BarGroup>& groups,
                      const std::string& measured) {
  double total = 0;
  for (const BarGroup& group : groups) total += width(group);
  Svg svg(total, kTop + kHeight + kBelow);
  svg.text({total / 2, 20}, title, {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  double left = 0;
  for (const BarGroup& group : groups) {
    draw_group(svg, group, left);
    left += width(group);
  }
  const double y = kTop + kHeight + kBelow - 18;
  svg.polygon({{kAxis, y - 9}, {kAxis + 22, y - 9}, {kAxis + 22, y}, {kAxis, y}}, {.fill = kOurs});
  svg.text({kAxis + 30, y}, "ours", {.size = 11.5});
  svg.line({kAxis + 80, y - 4}, {kAxis + 106, y - 4},
           {.stroke = kMeasured, .width = 2, .dash = "5 3"});
  svg.text({kAxis + 114, y}, measured, {.size = 11.5});
  return svg.str();
}

}  // namespace maxwrench
