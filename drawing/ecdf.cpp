#include "drawing/ecdf.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/named_curves.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kEcdfLeft = 52, kEcdfTop = 24, kEcdfHeight = 150, kEcdfBottom = 40,
                 kEcdfBetween = 34, kEcdfRight = 14;
constexpr double kLowestDecade = -6, kHighestDecade = 12;

/// The decades that contain all steps of a panel.
Axis decades_of(const EcdfPanel& panel, double from, double to) {
  double low = kHighestDecade, high = kLowestDecade;
  for (const EcdfCurve& curve : panel.curves) {
    for (const Point& step : curve.steps) {
      if (!step.allFinite()) throw std::invalid_argument(panel.axis + ": expected finite steps");
      const double decade = std::log10(std::max(step.x(), std::pow(10, kLowestDecade)));
      low = std::min(low, std::floor(decade));
      high = std::max(high, std::ceil(decade));
    }
  }
  if (low > high) low = high = 0;
  return make_axis(low, std::max(high, low + 1), from, to, panel.axis);
}

/// One panel: x is log10 of the budget spent, y the share.
class SharePanel {
 public:
  SharePanel(Svg& svg, const EcdfPanel& panel, const NamedCurves& styles, Point corner,
             double width)
      : svg_(svg),
        panel_(panel),
        styles_(styles),
        x_(decades_of(panel, corner.x(), corner.x() + width)),
        y_(make_axis(0, 1, corner.y() + kEcdfHeight, corner.y(), "share")) {}

  void draw(bool first) {
    grid(first);
    for (const bool named : {false, true}) {
      for (const EcdfCurve& curve : panel_.curves) {
        if ((styles_.place(curve.name) >= 0) != named || curve.steps.empty()) continue;
        styles_.draw(svg_, curve.name, stairs(curve), x_.from, x_(x_.low + 1) - x_.from);
      }
    }
    svg_.text({(x_.from + x_.to) / 2, y_.to - 8}, panel_.title,
              {.size = 12, .anchor = Anchor::kMiddle, .bold = true});
  }

 private:
  void grid(bool first) {
    std::vector<Tick> decades, shares;
    const int step = x_.high - x_.low > 6 ? 2 : 1;
    for (int x = static_cast<int>(x_.low); x <= static_cast<int>(x_.high); x += step) {
      decades.push_back({double(x), decade_label(x)});
    }
    for (const int percent : {0, 20, 40, 60, 80, 100}) {
      shares.push_back({percent / 100.0, std::to_string(percent) + " %"});
    }
    draw_x_axis(svg_, x_, y_, decades, panel_.axis);
    if (first) draw_y_axis(svg_, x_, y_, shares, panel_.shares);
    if (!first) draw_y_lines(svg_, x_, y_, shares);
    draw_frame(svg_, x_, y_);
  }

  /// The steps of a curve from share zero at the first step to the right end.
  std::vector<Point> stairs(const EcdfCurve& curve) const {
    std::vector<Point> points;
    double share = 0;
    for (const Point& step : curve.steps) {
      const double x = x_(std::max(std::log10(std::max(step.x(), 1e-300)), x_.low));
      points.emplace_back(x, y_(share));
      share = step.y();
      points.emplace_back(x, y_(share));
    }
    points.emplace_back(x_.to, y_(share));
    return points;
  }

  Svg& svg_;
  const EcdfPanel& panel_;
  const NamedCurves& styles_;
  Axis x_, y_;
};

}  // namespace

std::string draw_ecdf(std::span<const EcdfPanel> panels, const std::vector<std::string>& named,
                      int columns) {
  const NamedCurves styles(named);
  std::set<std::string> drawn;
  for (const EcdfPanel& panel : panels) {
    for (const EcdfCurve& curve : panel.curves) {
      if (!curve.steps.empty()) drawn.insert(curve.name);
    }
  }
  const std::vector<LegendEntry> legend = styles.legend(drawn);
  const double width =
      (kPageWidth - kEcdfLeft - kEcdfRight - (columns - 1) * kEcdfBetween) / columns;
  const double each = kEcdfTop + kEcdfHeight + kEcdfBottom;
  const auto count = static_cast<int>(panels.size());
  const int rows = (count + columns - 1) / columns;
  const Point corner(kEcdfLeft, each * rows);
  const double wide = kPageWidth - kEcdfLeft;
  Svg svg(kPageWidth, corner.y() + draw_legend(nullptr, legend, corner, wide) + 8);
  for (int i = 0; i < count; ++i) {
    const int row = i / columns, column = i % columns;
    const Point at(kEcdfLeft + column * (width + kEcdfBetween), row * each + kEcdfTop);
    SharePanel(svg, panels[static_cast<std::size_t>(i)], styles, at, width).draw(column == 0);
  }
  draw_legend(&svg, legend, corner, wide);
  return svg.str();
}

}  // namespace maxwrench
