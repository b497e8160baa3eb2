#include "drawing/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/axes.h"
#include "drawing/legend.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kPanelHeight = 180, kPanelLeft = 78, kPanelTop = 26, kPanelRight = 12,
                 kPanelBottom = 40;
constexpr double kSmallest = 1e-6;  // share of the best value: the foot of the picture
constexpr int kPointsPerDecade = 24;
constexpr int kMostDecades = 12;  // of evaluations

/// One panel in decades: x log10 of evaluations from 0, y log10 of the shortfall up to 0.
class DecadePanel {
 public:
  DecadePanel(Svg& svg, const ConvergencePanel& panel, double top)
      : svg_(svg),
        panel_(panel),
        x_(make_axis(0, std::clamp(std::log10(panel.budget), 1.0, double{kMostDecades}), kPanelLeft,
                     kPageWidth - kPanelRight, "decades")),
        y_(make_axis(std::log10(kSmallest), 0, top + kPanelTop + kPanelHeight, top + kPanelTop,
                     "decades")) {}

  void draw() {
    grid();
    for (std::size_t i = 0; i < panel_.curves.size(); ++i) curve(i);
    svg_.text({(x_.from + x_.to) / 2, y_.to - 9}, with_letters(panel_.title),
              {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  }

 private:
  Point at(double x, double y) const { return {x_(x), y_(y)}; }

  static std::string power(int decade) {
    static const char* const kUnits[] = {"", "k", "M", "G", "T"};
    return fmt::format("{}{}", std::lround(std::pow(10, decade % 3)), kUnits[decade / 3]);
  }

  void grid() {
    std::vector<Tick> evaluations, shares;
    for (int x = 0; x <= static_cast<int>(x_.high); ++x) {
      evaluations.push_back({double(x), power(x)});
    }
    for (int y = 0; y >= static_cast<int>(y_.low); --y) {
      shares.push_back({double(y), fmt::format("{:.6g} %", 100 * std::pow(10, y))});
    }
    draw_x_axis(svg_, x_, y_, evaluations, "evaluations");
    draw_y_axis(svg_, x_, y_, shares, "median below best known");
    svg_.line(at(0, -3), at(x_.high, -3), {.stroke = "#8a8a8a", .width = 1, .dash = "4 3"});
    draw_frame(svg_, x_, y_);
  }

  /// With marks about a decade apart, in places of its own.
  void curve(std::size_t i) {
    const CurveStyle style = curve_style(i);
    const std::vector<Point> points = stairs(panel_.curves[i]);
    svg_.polyline(points, {.stroke = style.colour, .width = 1.5, .dash = style.dash});
    const double decade = x_(1) - x_(0);
    double next = x_.from + decade * static_cast<double>(i + 1) /
                                static_cast<double>(panel_.curves.size() + 1);
    for (const Point& p : points) {
      if (p.x() < next) continue;
      draw_mark(svg_, p, style);
      next += decade * (1 + std::floor((p.x() - next) / decade));
    }
  }

  /// From the first evaluation with a value.
  std::vector<Point> stairs(const ConvergenceCurve& curve) const {
    std::vector<Point> points;
    const int steps = static_cast<int>(std::lround(x_.high * kPointsPerDecade));
    for (int i = 0; i <= steps; ++i) {
      const double x = x_.high * i / steps;
      const double shortfall = curve.shortfall(std::pow(10, x) + 0.5);
      if (!std::isfinite(shortfall)) continue;
      const double y = std::log10(std::clamp(shortfall, kSmallest, 1.0));
      if (!points.empty()) points.emplace_back(at(x, 0).x(), points.back().y());
      points.push_back(at(x, y));
    }
    return points;
  }

  Svg& svg_;
  const ConvergencePanel& panel_;
  Axis x_, y_;
};

}  // namespace

std::string draw_convergence(std::span<const ConvergencePanel> panels) {
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; !panels.empty() && i < panels[0].curves.size(); ++i) {
    legend.push_back(legend_entry(panels[0].curves[i].name, curve_style(i)));
  }
  const double each = kPanelTop + kPanelHeight + kPanelBottom;
  const Point corner(kPanelLeft, each * static_cast<double>(panels.size()));
  const double width = kPageWidth - kPanelLeft;
  Svg svg(kPageWidth, corner.y() + draw_legend(nullptr, legend, corner, width) + 8);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    DecadePanel(svg, panels[i], each * static_cast<double>(i)).draw();
  }
  draw_legend(&svg, legend, corner, width);
  return svg.str();
}

}  // namespace maxwrench
