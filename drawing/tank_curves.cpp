#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/legend.h"
#include "maxwrench/figures.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kCurvesLeft = 54, kCurvesTop = 12, kCurvesHeight = 220, kCurvesBelow = 44,
                 kCurvesRight = 12;  // px
constexpr int kMarks = 8;            // on each curve
const Paint& trajectory_paint() {
  static const Paint kTrajectory{.stroke = "#888888", .width = 1, .dash = "2 2"};
  return kTrajectory;
}

struct TankAxes {
  Axis time, value;
  Point operator()(double t, double y) const { return {time(t), value(y)}; }
};

/// The axes that contain all samples and zero. Throws std::invalid_argument if there is nothing to
/// draw.
TankAxes axes_of(const std::vector<TankCurve>& curves) {
  double end = 0, low = 0, high = 0;
  bool finite = true;
  for (const TankCurve& curve : curves) {
    if (curve.run->samples.empty()) {
      throw std::invalid_argument("figure: got no sample of " + curve.name + " (" +
                                  to_string(curve.run->status) + " " + curve.run->reason.str() +
                                  "), expected an experiment that ran");
    }
    for (const TankSample& sample : curve.run->samples) {
      end = std::max(end, sample.t);
      for (const double value : {sample.planned, sample.reading}) {
        finite = finite && std::isfinite(value);
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  if (!finite) low = high = std::nan("");
  const double right = kPageWidth - kCurvesRight, foot = kCurvesTop + kCurvesHeight;
  return {make_axis(0, end, kCurvesLeft, right, "times"),
          make_axis(low, low + 1.05 * std::max(high - low, 1e-9), foot, kCurvesTop, "readings")};
}

/// Draws the reading and the planned wrench of one run, with marks at positions of its own.
void draw_run(Svg& svg, const TankAxes& axes, const TankCurve& curve, std::size_t index,
              std::size_t count) {
  const CurveStyle style = curve_style(index);
  std::vector<Point> planned, reading;
  for (const TankSample& sample : curve.run->samples) {
    planned.push_back(axes(sample.t, sample.planned));
    reading.push_back(axes(sample.t, sample.reading));
  }
  svg.polyline(planned, trajectory_paint());
  svg.polyline(reading, {.stroke = style.colour, .width = 1.6, .dash = style.dash});
  const double length = axes.time.high / kMarks;
  const double offset = static_cast<double>(index + 1) / static_cast<double>(count + 1);
  std::size_t i = 0;
  for (int k = 0; k < kMarks; ++k) {
    while (i < reading.size() && curve.run->samples[i].t < length * (k + offset)) ++i;
    if (i < reading.size()) draw_mark(svg, reading[i], style);
  }
}

LegendEntry entry_of(const Problem& problem, const TankCurve& curve, std::size_t index) {
  const double mean = curve.run->summary.mean;
  std::string text = with_letters(curve.name);
  if (std::isfinite(mean)) {
    text += fmt::format(": {} {}", with_minus(mean, "{:.1f}"), problem.unit());
  }
  return legend_entry(text, curve_style(index));
}

}  // namespace

std::string tank_figure(const Problem& problem, const std::vector<TankCurve>& curves) {
  const TankAxes axes = axes_of(curves);
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    legend.push_back(entry_of(problem, curves[i], i));
  }
  legend.push_back({"planned; numbers: mean of the hold", [](Svg& svg, const Point& left) {
                      svg.line(left, left + Point(kLegendMark, 0), trajectory_paint());
                    }});
  const Point corner(kCurvesLeft, kCurvesTop + kCurvesHeight + kCurvesBelow - 6);
  const double width = kPageWidth - kCurvesLeft;
  Svg svg(kPageWidth, corner.y() + draw_legend(nullptr, legend, corner, width) + 8);
  draw_x_axis(svg, axes.time, axes.value, round_ticks(axes.time, 6), "time [s]");
  draw_y_axis(svg, axes.time, axes.value, round_ticks(axes.value, 5),
              fmt::format("reading along c [{}]", problem.unit()));
  draw_frame(svg, axes.time, axes.value);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    draw_run(svg, axes, curves[i], i, curves.size());
  }
  draw_legend(&svg, legend, corner, width);
  return svg.str();
}

}  // namespace maxwrench
