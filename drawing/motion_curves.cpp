#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/legend.h"
#include "maxwrench/figures.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kStripLeft = 54, kStripTop = 12, kStripHeight = 92, kStripRight = 12;  // px
constexpr double kStripBelow = 24, kStripNamed = 38;  // to its legend, the last one with a name
constexpr double kStripBetween = 12;
constexpr double kLeastRange = 1e-3;  // of the values of a strip
constexpr double kRoomAround = 0.05;  // of that range

/// One curve of a strip.
struct Strand {
  std::string name;
  std::function<double(const TankSample&)> value;
};

/// One plot of several above each other.
struct Strip {
  std::string name;
  std::vector<Strand> strands;
  bool from_zero = false;
};

std::vector<Strip> strips_of(const Problem& problem) {
  Strip wrench{fmt::format("along c [{}]", problem.unit()), {}};
  wrench.strands.push_back({"reading", [](const TankSample& s) { return s.reading; }});
  wrench.strands.push_back({"plan", [](const TankSample& s) { return s.planned; }});
  wrench.from_zero = true;
  Strip forces{"thrusters [N]", {}};
  for (std::size_t i = 0; i < problem.robot.thrusters.size(); ++i) {
    forces.strands.push_back({problem.robot.thrusters[i].name, [i](const TankSample& s) {
                                return s.u[static_cast<Eigen::Index>(i)];
                              }});
  }
  Strip posture{"theta_r [rad]", {}};
  for (int i = 0; i < problem.redundancy(); ++i) {
    posture.strands.push_back(
        {problem.theta_r_name(i), [i](const TankSample& s) { return s.theta_r[i]; }});
  }
  Strip angle{"turned [rad]", {}};
  angle.strands.push_back({"end effector", [](const TankSample& s) { return s.angle; }});
  std::vector<Strip> strips;
  for (Strip* strip : {&wrench, &forces, &posture, &angle}) {
    if (!strip->strands.empty()) strips.push_back(std::move(*strip));
  }
  return strips;
}

Axis value_axis(const Strip& strip, const TankRun& run, double top) {
  double low = strip.from_zero ? 0 : kInfinity, high = strip.from_zero ? 0 : -kInfinity;
  for (const TankSample& sample : run.samples) {
    for (const Strand& strand : strip.strands) {
      const double value = strand.value(sample);
      if (!std::isfinite(value)) low = high = std::nan("");
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const double more = std::max(kRoomAround * (high - low), kLeastRange);
  return make_axis(low - more, high + more, top + kStripHeight, top, strip.name);
}

void draw_strip(Svg& svg, const Strip& strip, const TankRun& run, const Axis& time,
                const Axis& values) {
  draw_y_axis(svg, time, values, round_ticks(values, 4), strip.name);
  draw_frame(svg, time, values);
  for (std::size_t i = 0; i < strip.strands.size(); ++i) {
    std::vector<Point> points;
    for (const TankSample& sample : run.samples) {
      points.emplace_back(time(sample.t), values(strip.strands[i].value(sample)));
    }
    const CurveStyle style = curve_style(i);
    svg.polyline(points, {.stroke = style.colour, .width = 1.3, .dash = style.dash});
    const std::size_t at = (i + 1) * points.size() / (strip.strands.size() + 1);
    draw_mark(svg, points[std::min(at, points.size() - 1)], style);
  }
}

std::vector<LegendEntry> legend_of(const Strip& strip) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < strip.strands.size(); ++i) {
    entries.push_back(legend_entry(strip.strands[i].name, curve_style(i)));
  }
  return entries;
}

}  // namespace

std::string motion_figure(const Problem& problem, const TankRun& run) {
  if (run.samples.empty()) {
    throw std::invalid_argument(std::string("figure: got no sample (") + to_string(run.status) +
                                " " + run.reason.str() + "), expected an experiment that ran");
  }
  const std::vector<Strip> strips = strips_of(problem);
  const double width = kPageWidth - kStripLeft;
  const Axis time =
      make_axis(0, run.samples.back().t, kStripLeft, kPageWidth - kStripRight, "times");
  double height = kStripTop;
  for (const Strip& strip : strips) {
    const bool last = &strip == &strips.back();
    height += kStripHeight + (last ? kStripNamed : kStripBelow) + kStripBetween +
              draw_legend(nullptr, legend_of(strip), Point(0, 0), width);
  }
  Svg svg(kPageWidth, height);
  double top = kStripTop;
  for (const Strip& strip : strips) {
    const Axis values = value_axis(strip, run, top);
    const bool last = &strip == &strips.back();
    draw_x_axis(svg, time, values, round_ticks(time, 6), last ? "time [s]" : "");
    draw_strip(svg, strip, run, time, values);
    top += kStripHeight + (last ? kStripNamed : kStripBelow);
    top += kStripBetween + draw_legend(&svg, legend_of(strip), Point(kStripLeft, top), width);
  }
  return svg.str();
}

}  // namespace maxwrench
