#include "cli/bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/svg.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kAxis = 56, kSlot = 58, kBar = 34, kBarsTop = 40, kBarsHeight = 240,
                 kBarsBelow = 62, kBarsRight = 16;
constexpr const char* kOurs = "#0072B2";
constexpr const char* kMeasured = "#E69F00";

/// With a minus sign instead of a hyphen.
std::string with_minus(double value, const char* format) {
  return (value < 0 ? "\u2212" : "") + fmt::format(fmt::runtime(format), std::abs(value));
}

double width(const BarGroup& group) {
  return kAxis + kSlot * static_cast<double>(group.bars.size()) + kBarsRight;
}

/// Draws one group with its axis.
class GroupWriter {
 public:
  /// `left`: the left edge of its share of the picture.
  GroupWriter(Svg& svg, const BarGroup& group, double left)
      : svg_(svg),
        group_(group),
        left_(left),
        x0_(left + kAxis),
        x1_(left + width(group) - kBarsRight) {
    for (const Bar& bar : group.bars) {
      largest_ = std::max(largest_, std::abs(bar.value));
      for (const double value : bar.measured) largest_ = std::max(largest_, std::abs(value));
    }
    largest_ *= 1.12;  // room for the numbers
  }

  void draw() {
    ticks();
    for (std::size_t i = 0; i < group_.bars.size(); ++i) {
      bar(group_.bars[i], x0_ + kSlot * (static_cast<double>(i) + 0.5));
    }
    svg_.line({x0_, y(0)}, {x1_, y(0)}, {.stroke = "#222222", .width = 1});
    svg_.text({left_ + 14, kBarsTop + kBarsHeight / 2}, group_.unit,
              {.size = 11, .anchor = Anchor::kMiddle, .angle = 90});
  }

 private:
  double y(double value) const { return kBarsTop + kBarsHeight / 2 * (1 - value / largest_); }

  void ticks() {
    const double step = round_step(largest_ / 2.2);
    const auto last = static_cast<int>(largest_ / step);
    for (int i = -last; i <= last; ++i) {
      const double at = y(step * i);
      svg_.line({x0_, at}, {x1_, at}, {.stroke = "#e8e8e8", .width = 0.8});
      svg_.text({x0_ - 6, at + 3.5}, with_minus(step * i, "{:.6g}"),
                {.size = 10, .anchor = Anchor::kEnd});
    }
  }

  void bar(const Bar& bar, double centre) {
    const double l = centre - kBar / 2, r = centre + kBar / 2;
    svg_.polygon({{l, y(0)}, {r, y(0)}, {r, y(bar.value)}, {l, y(bar.value)}}, {.fill = kOurs});
    svg_.text({centre, y(bar.value) + (bar.value < 0 ? 12 : -4)}, with_minus(bar.value, "{:.1f}"),
              {.size = 10.5, .anchor = Anchor::kMiddle});
    for (const double value : bar.measured) {
      svg_.line({centre - kSlot / 2 + 4, y(value)}, {centre + kSlot / 2 - 4, y(value)},
                {.stroke = kMeasured, .width = 2, .dash = "5 3"});
    }
    svg_.text({centre, kBarsTop + kBarsHeight + 16}, bar.name,
              {.size = 11.5, .anchor = Anchor::kMiddle});
  }

  Svg& svg_;
  const BarGroup& group_;
  double left_, x0_, x1_;
  double largest_ = 1e-9;
};

}  // namespace

std::string draw_bars(const std::string& title, const std::vector<BarGroup>& groups,
                      const std::string& measured) {
  double total = 0;
  for (const BarGroup& group : groups) total += width(group);
  Svg svg(total, kBarsTop + kBarsHeight + kBarsBelow);
  svg.text({total / 2, 20}, title, {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  double left = 0;
  for (const BarGroup& group : groups) {
    GroupWriter(svg, group, left).draw();
    left += width(group);
  }
  const double y = kBarsTop + kBarsHeight + kBarsBelow - 18;
  svg.polygon({{kAxis, y - 9}, {kAxis + 22, y - 9}, {kAxis + 22, y}, {kAxis, y}}, {.fill = kOurs});
  svg.text({kAxis + 30, y}, "ours", {.size = 11.5});
  svg.line({kAxis + 80, y - 4}, {kAxis + 106, y - 4},
           {.stroke = kMeasured, .width = 2, .dash = "5 3"});
  svg.text({kAxis + 114, y}, measured, {.size = 11.5});
  return svg.str();
}

}  // namespace maxwrench
