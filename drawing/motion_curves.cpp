#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/legend.h"
#include "maxwrench/figures.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kStripLeft = 54, kStripTop = 12, kStripHeight = 92, kStripRight = 12;  // px
constexpr double kStripBelow = 24, kStripNamed = 38;  // to the legend; the last has an axis name
constexpr double kStripBare = 14, kStripBetween = 12;
constexpr double kStripTitle = 14, kStripLegendLeft = 14;
constexpr int kValuePieces = 3;       // of the axis of values
constexpr double kLeastRange = 1e-3;  // of the values of a strip
constexpr double kRoomAround = 0.05;  // of that range

/// One curve of a strip.
struct Strand {
  std::string name;
  const TankRun* run;
  std::function<double(const TankSample&)> value;
};

/// One of several plots above each other.
struct Strip {
  std::string name;
  std::vector<Strand> strands = {};
  std::string title = {};           // above it
  std::vector<double> limits = {};  // lines across it
  bool from_zero = false, legend = true;

  double above() const { return title.empty() ? 0 : kStripTitle; }
  double below(bool last) const { return last ? kStripNamed : legend ? kStripBelow : kStripBare; }
};

const Paint& limit_paint() {
  static const Paint kLimit{.stroke = "#555555", .width = 1.2, .dash = "1 3"};
  return kLimit;
}

Strip angle_strip(const std::vector<TankCurve>& curves) {
  Strip strip{"turned [rad]"};
  for (const TankCurve& curve : curves) {
    const std::string who = curves.size() > 1 ? ", " + curve.name : "";
    strip.strands.push_back(
        {"end effector" + who, curve.run, [](const TankSample& s) { return s.angle; }});
  }
  return strip;
}

/// The wrench strip. It starts from zero unless there are several curves.
Strip wrench_strip(const Problem& problem, const std::vector<TankCurve>& curves) {
  Strip strip{fmt::format("along c [{}]", problem.unit())};
  strip.from_zero = curves.size() == 1;
  for (const TankCurve& curve : curves) {
    const std::string who = curves.size() > 1 ? ", " + curve.name : "";
    strip.strands.push_back(
        {"reading" + who, curve.run, [](const TankSample& s) { return s.reading; }});
    strip.strands.push_back(
        {"planned" + who, curve.run, [](const TankSample& s) { return s.planned; }});
  }
  return strip;
}

Strip thruster_strip(const Problem& problem, const TankRun& run) {
  Strip strip{"thrusters [N]"};
  const auto& thrusters = problem.robot.thrusters;
  const Zonotope& set = problem.robot.actuation;
  std::set<double> limits;
  for (std::size_t i = 0; i < thrusters.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    strip.strands.push_back({thrusters[i].name, &run, [j](const TankSample& s) { return s.u[j]; }});
    limits.insert({set.u_min[j], set.u_max[j]});
  }
  for (const double limit : limits) {
    if (std::isfinite(limit)) strip.limits.push_back(limit);
  }
  return strip;
}

Strip posture_strip(const Problem& problem, const TankRun& run) {
  Strip strip{"theta_r [rad]"};
  for (int i = 0; i < problem.redundancy(); ++i) {
    strip.strands.push_back(
        {problem.theta_r_name(i), &run, [i](const TankSample& s) { return s.theta_r[i]; }});
  }
  return strip;
}

/// For several runs, one strip each, below each other, with one legend.
std::vector<Strip> strips_of(const Problem& problem, const std::vector<TankCurve>& curves) {
  std::vector<Strip> strips;
  if (!problem.motion->impulse) strips.push_back(angle_strip(curves));
  strips.push_back(wrench_strip(problem, curves));
  for (const bool thrusters : {true, false}) {
    for (const TankCurve& curve : curves) {
      Strip strip =
          thrusters ? thruster_strip(problem, *curve.run) : posture_strip(problem, *curve.run);
      if (curves.size() > 1) strip.title = curve.name;
      strip.legend = &curve == &curves.back();
      if (!strip.strands.empty()) strips.push_back(std::move(strip));
    }
  }
  return strips;
}

Axis value_axis(const Strip& strip, double top) {
  double low = strip.from_zero ? 0 : kInfinity, high = strip.from_zero ? 0 : -kInfinity;
  const auto include = [&](double value) {
    if (!std::isfinite(value)) low = high = std::nan("");
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const double limit : strip.limits) include(limit);
  for (const Strand& strand : strip.strands) {
    for (const TankSample& sample : strand.run->samples) include(strand.value(sample));
  }
  const double more = std::max(kRoomAround * (high - low), kLeastRange);
  return make_axis(low - more, high + more, top + kStripHeight, top, strip.name);
}

void draw_strip(Svg& svg, const Strip& strip, const Axis& time, const Axis& values) {
  draw_y_axis(svg, time, values, round_ticks(values, kValuePieces), strip.name);
  draw_frame(svg, time, values);
  svg.text({time.from, values.to - 5}, strip.title, {});
  for (const double limit : strip.limits) {
    svg.line({time.from, values(limit)}, {time.to, values(limit)}, limit_paint());
  }
  for (std::size_t i = 0; i < strip.strands.size(); ++i) {
    std::vector<Point> points;
    for (const TankSample& sample : strip.strands[i].run->samples) {
      points.emplace_back(time(sample.t), values(strip.strands[i].value(sample)));
    }
    const CurveStyle style = curve_style(i);
    svg.polyline(points, {.stroke = style.colour, .width = 1.3, .dash = style.dash});
    const std::size_t at = (i + 1) * points.size() / (strip.strands.size() + 1);
    draw_mark(svg, points[std::min(at, points.size() - 1)], style);
  }
}

/// Draws the legend in three columns, or in two if a name does not fit. Returns the height.
double strip_legend(Svg* svg, const Strip& strip, const Point& corner) {
  if (!strip.legend) return 0;
  std::vector<LegendEntry> entries;
  double widest = 0;
  for (std::size_t i = 0; i < strip.strands.size(); ++i) {
    entries.push_back(legend_entry(strip.strands[i].name, curve_style(i)));
    widest = std::max(widest, text_width(strip.strands[i].name, Font().size));
  }
  if (!strip.limits.empty()) {
    entries.push_back({"limits", [](Svg& legend, const Point& left) {
                         legend.line(left, left + Point(kLegendMark, 0), limit_paint());
                       }});
  }
  const double width = kPageWidth - corner.x();
  const int columns = kLegendMark + widest + kStripBetween > width / 3 ? 2 : 3;
  return draw_legend(svg, entries, corner, width, columns);
}

void require_samples(const std::vector<TankCurve>& curves) {
  for (const TankCurve& curve : curves) {
    if (!curve.run->samples.empty()) continue;
    throw std::invalid_argument(std::string("figure: got no sample (") +
                                to_string(curve.run->status) + " " + curve.run->reason.str() +
                                "), expected an experiment that ran");
  }
}

}  // namespace

std::string motion_figure(const Problem& problem, const std::vector<TankCurve>& curves) {
  require_samples(curves);
  const std::vector<Strip> strips = strips_of(problem, curves);
  double end = 0, height = kStripTop;
  for (const TankCurve& curve : curves) end = std::max(end, curve.run->samples.back().t);
  const Axis time = make_axis(0, end, kStripLeft, kPageWidth - kStripRight, "times");
  for (const Strip& strip : strips) {
    height += strip.above() + kStripHeight + strip.below(&strip == &strips.back()) + kStripBetween +
              strip_legend(nullptr, strip, Point(kStripLegendLeft, 0));
  }
  Svg svg(kPageWidth, height);
  double top = kStripTop;
  for (const Strip& strip : strips) {
    top += strip.above();
    const Axis values = value_axis(strip, top);
    const bool last = &strip == &strips.back();
    draw_x_axis(svg, time, values, round_ticks(time, 6), last ? "time [s]" : "");
    draw_strip(svg, strip, time, values);
    top += kStripHeight + strip.below(last);
    top += kStripBetween + strip_legend(&svg, strip, Point(kStripLegendLeft, top));
  }
  return svg.str();
}

}  // namespace maxwrench
