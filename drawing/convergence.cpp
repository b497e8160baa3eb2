#include "drawing/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/axes.h"
#include "drawing/named_curves.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kPanelHeight = 180, kPanelLeft = 78, kPanelTop = 26, kPanelRight = 12,
                 kPanelBottom = 40;
constexpr double kSmallest = 1e-6;  // share of the best value at the lower edge of the picture
constexpr int kPointsPerDecade = 24;
constexpr int kMostDecades = 12;  // of evaluations

/// One panel in decades: x is log10 of evaluations, from 0; y is log10 of the shortfall, up to 0.
class DecadePanel {
 public:
  DecadePanel(Svg& svg, const ConvergencePanel& panel, const NamedCurves& styles, double top)
      : svg_(svg),
        panel_(panel),
        styles_(styles),
        x_(make_axis(0, std::clamp(std::log10(panel.budget), 1.0, double{kMostDecades}), kPanelLeft,
                     kPageWidth - kPanelRight, "decades")),
        y_(make_axis(std::log10(kSmallest), 0, top + kPanelTop + kPanelHeight, top + kPanelTop,
                     "decades")) {}

  void draw() {
    grid();
    for (const bool named : {false, true}) {
      for (const ConvergenceCurve& curve : panel_.curves) {
        if ((styles_.place(curve.name) >= 0) != named) continue;
        styles_.draw(svg_, curve.name, stairs(curve), x_.from, x_(1) - x_(0));
      }
    }
    svg_.text({(x_.from + x_.to) / 2, y_.to - 9}, with_letters(panel_.title),
              {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  }

 private:
  Point at(double x, double y) const { return {x_(x), y_(y)}; }

  void grid() {
    std::vector<Tick> evaluations, shares;
    for (int x = 0; x <= static_cast<int>(x_.high); ++x) {
      evaluations.push_back({double(x), decade_label(x)});
    }
    for (int y = 0; y >= static_cast<int>(y_.low); --y) {
      shares.push_back({double(y), fmt::format("{:.6g} %", 100 * std::pow(10, y))});
    }
    draw_x_axis(svg_, x_, y_, evaluations, "evaluations");
    draw_y_axis(svg_, x_, y_, shares, "median below best known");
    svg_.line(at(0, -3), at(x_.high, -3), {.stroke = "#8a8a8a", .width = 1, .dash = "4 3"});
    draw_frame(svg_, x_, y_);
  }

  /// The steps of a curve from its first evaluation with a value.
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
  const NamedCurves& styles_;
  Axis x_, y_;
};

}  // namespace

std::string draw_convergence(std::span<const ConvergencePanel> panels,
                             const std::vector<std::string>& named) {
  const NamedCurves styles(named);
  std::set<std::string> drawn;
  for (const ConvergencePanel& panel : panels) {
    for (const ConvergenceCurve& curve : panel.curves) drawn.insert(curve.name);
  }
  const std::vector<LegendEntry> legend = styles.legend(drawn);
  const double each = kPanelTop + kPanelHeight + kPanelBottom;
  const Point corner(kPanelLeft, each * static_cast<double>(panels.size()));
  const double width = kPageWidth - kPanelLeft;
  Svg svg(kPageWidth, corner.y() + draw_legend(nullptr, legend, corner, width) + 8);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    DecadePanel(svg, panels[i], styles, each * static_cast<double>(i)).draw();
  }
  draw_legend(&svg, legend, corner, width);
  return svg.str();
}

}  // namespace maxwrench
