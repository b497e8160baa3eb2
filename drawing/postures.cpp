#include "drawing/postures.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/panel.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kLongestBar = 90, kScaleLine = 20, kLegendLeft = 14;  // px

/// Draws the length of a round number of newtons, starting at `left`.
void force_scale_bar(Svg& svg, const Layout& layout, const Point& left) {
  const double px_per_newton = layout.metres * layout.scale;
  const double newtons = round_step(kLongestBar / px_per_newton);
  const Point right = left + Point(newtons * px_per_newton, 0);
  const Paint ink{.stroke = kInk, .width = 1.2};
  svg.line(left, right, ink);
  for (const Point& end : {left, right}) svg.line(end - Point(0, 4), end + Point(0, 4), ink);
  svg.text(right + Point(6, 4),
           fmt::format("{:.6g} N ({:.6g} N per m)", newtons, 1 / layout.metres), {});
}

struct Picture {
  Svg svg;  // without its legend
  std::vector<LegendEntry> legend;
};

Picture picture(std::span<const DrawnPosture> panels, View view) {
  if (panels.empty()) throw std::invalid_argument("figure: got no posture, expected some");
  const Layout layout = make_layout(panels, view);
  const std::size_t rows = (panels.size() + layout.columns - 1) / layout.columns;
  const double each = panel_height(layout);
  const double height = each * static_cast<double>(rows);
  Svg svg(kPageWidth, height + (layout.forces ? kScaleLine : 0));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t row = i / layout.columns, column = i % layout.columns;
    const Point cell(kPostureLeft + static_cast<double>(column) * (layout.cell + kPostureGap),
                     static_cast<double>(row) * each);
    draw_panel(svg, layout, panels[i], layout.scenes[i], cell, view, column == 0);
  }
  if (layout.forces) force_scale_bar(svg, layout, {kLegendLeft, height + kScaleLine / 2});
  return {svg, posture_legend(layout, panels)};
}

/// The pictures below each other, then one legend for all of them.
std::string with_legend(const std::vector<Picture>& pictures) {
  std::vector<LegendEntry> legend;
  double height = 0;
  for (const Picture& each : pictures) {
    height += each.svg.height();
    for (const LegendEntry& entry : each.legend) {
      const auto same = [&](const LegendEntry& other) { return other.text == entry.text; };
      if (std::none_of(legend.begin(), legend.end(), same)) legend.push_back(entry);
    }
  }
  const Point corner(kLegendLeft, height + 2);
  const double width = kPageWidth - kLegendLeft;
  Svg svg(kPageWidth, corner.y() + draw_legend(nullptr, legend, corner, width) + 8);
  double top = 0;
  for (const Picture& each : pictures) {
    svg.place(each.svg, {0, top});
    top += each.svg.height();
  }
  draw_legend(&svg, legend, corner, width);
  return svg.str();
}

}  // namespace

std::string draw_postures(std::span<const DrawnPosture> panels, View view) {
  return with_legend({picture(panels, view)});
}

std::string draw_both_views(std::span<const DrawnPosture> panels) {
  const auto titled = [&](const char* view) {
    std::vector<DrawnPosture> copy(panels.begin(), panels.end());
    for (DrawnPosture& panel : copy) panel.title += view;
    return copy;
  };
  return with_legend({picture(titled(", from the right"), View::kSide),
                      picture(titled(", from above"), View::kTop)});
}

}  // namespace maxwrench
