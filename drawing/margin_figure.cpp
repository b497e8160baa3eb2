#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "drawing/axes.h"
#include "drawing/svg.h"
#include "maxwrench/figures.h"
#include "maxwrench/margin.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kMarginLeft = 56, kMarginTop = 46, kMarginRight = 14, kMarginHeight = 200,
                 kMarginBelow = 42;  // px
constexpr double kMarginRoom = 1.1;

}  // namespace

std::string margin_figure(const MotionMargin& margin) {
  double low = 0, high = 0;
  for (const InstantMargin& at : margin.instants) {
    if (!std::isfinite(at.margin)) continue;
    low = std::min(low, at.margin);
    high = std::max(high, at.margin);
  }
  if (low == high) {
    throw std::invalid_argument("figure: got no margin, expected some that are finite");
  }
  if (margin.instants.size() < 2) {
    throw std::invalid_argument("figure: got one instant, expected a motion of several");
  }
  Svg svg(kPageWidth, kMarginTop + kMarginHeight + kMarginBelow);
  svg.text({kPageWidth / 2, 18}, fitted(margin.problem, 13, kPageWidth - 20),
           {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  svg.text({kPageWidth / 2, 33}, "margin of " + margin.set, {.anchor = Anchor::kMiddle});
  const Axis x = make_axis(margin.instants.front().t, margin.instants.back().t, kMarginLeft,
                           kPageWidth - kMarginRight, "times");
  const Axis y = make_axis(kMarginRoom * low, kMarginRoom * high, kMarginTop + kMarginHeight,
                           kMarginTop, "margins");
  draw_x_axis(svg, x, y, round_ticks(x, 6), "t [s]");
  draw_y_axis(svg, x, y, round_ticks(y, 5),
              margin.unit == "-" ? "factor" : fmt::format("[{}]", margin.unit));
  draw_frame(svg, x, y);
  if (low < 0) svg.line({x.from, y(0)}, {x.to, y(0)}, {.stroke = "#222222", .width = 1});
  std::vector<Point> points;
  const auto finish = [&] {
    if (points.size() > 1) svg.polyline(points, {.stroke = "#0072B2", .width = 1.5});
    if (points.size() == 1) svg.circle(points.front(), 2, {.fill = "#0072B2"});
    points.clear();
  };
  for (const InstantMargin& at : margin.instants) {
    if (std::isfinite(at.margin)) {
      points.emplace_back(x(at.t), y(at.margin));
      continue;
    }
    finish();
    svg.mark({x(at.t), at.margin > 0 ? y.to + 5 : y.from - 5}, Mark::kCross, 3,
             {.stroke = "#888888"});
  }
  finish();
  const InstantMargin& worst = margin.instants[static_cast<std::size_t>(margin.worst)];
  if (std::isfinite(worst.margin)) {
    svg.circle({x(worst.t), y(worst.margin)}, 3.5, {.fill = "#D55E00"});
  }
  return svg.str();
}

}  // namespace maxwrench
