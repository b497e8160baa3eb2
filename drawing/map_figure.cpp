#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "drawing/axes.h"
#include "drawing/camera.h"
#include "drawing/colour_scale.h"
#include "maxwrench/figures.h"
#include "maxwrench/map.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kMapLeft = 56, kMapTop = 34, kMapRight = 58, kMapBelow = 42, kMapSide = 276;
constexpr double kRoseRadius = 130;
constexpr double kBoxSize = 86;      // half of a box of three coordinates
constexpr long kMostCrosses = 2500;  // of cells without a value; more are grey only
constexpr int kMapGridLevel = 2;     // the level in which the grid is complete
constexpr const char* kNoValue = "#dddddd";
constexpr std::uint32_t kNoValueColour = 0xdddddd;

bool has_value(const MapCell& cell) { return cell.status == Status::kBestFound; }

std::string axis_name(const MapAxis& axis) {
  const std::string unit = map_unit(axis.name);
  return unit == "-" ? axis.name : fmt::format("{} [{}]", axis.name, unit);
}

/// The step of a coordinate around a cell: that of the grid, or of the level that halved it.
double step_at(const MapAxis& axis, int level) {
  if (axis.count < 2) return 1;
  const double step = (axis.high - axis.low) / static_cast<double>(axis.count - 1);
  return axis.name == "wrench" ? step : std::ldexp(step, std::min(0, kMapGridLevel - level));
}

/// The range of a coordinate with half a step at both ends.
Axis wide_axis(const MapAxis& axis, double from, double to) {
  const double half = step_at(axis, 0) / 2;
  return make_axis(axis.low - half, axis.high + half, from, to, axis.name);
}

/// The least and the largest value.
std::pair<double, double> range_of(const CapabilityMap& map) {
  double low = kInfinity, high = -kInfinity;
  for (const MapCell& cell : map.cells) {
    if (!has_value(cell)) continue;
    low = std::min(low, cell.beta);
    high = std::max(high, cell.beta);
  }
  if (low > high) {
    throw std::invalid_argument("figure: got a map without any value, expected one with values");
  }
  return {low, high};
}

ColourScale scale_of(const CapabilityMap& map) {
  const auto [low, high] = range_of(map);
  return {low, high};
}

std::string value_name(const CapabilityMap& map) {
  return map.unit == "-" ? "factor" : fmt::format("[{}]", map.unit);
}

Svg titled(const CapabilityMap& map, double height) {
  Svg svg(kPageWidth, height);
  svg.text({kPageWidth / 2, 18}, map.task->name,
           {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  return svg;
}

std::string draw_heat_map(const CapabilityMap& map) {
  const ColourScale colours = scale_of(map);
  const MapAxis &across = map.plan.over[0], &upwards = map.plan.over[1];
  Svg svg = titled(map, kMapTop + kMapSide + kMapBelow);
  const Axis x = wide_axis(across, kMapLeft, kPageWidth - kMapRight);
  const Axis y = wide_axis(upwards, kMapTop + kMapSide, kMapTop);
  std::vector<const MapCell*> cells;
  for (const MapCell& cell : map.cells) cells.push_back(&cell);
  std::stable_sort(cells.begin(), cells.end(), [](const MapCell* a, const MapCell* b) {
    return a->level > kMapGridLevel && b->level > a->level
               ? true
               : b->level > kMapGridLevel && a->level < b->level;
  });
  svg.begin_clip("cells", {x.from, y.to}, {x.to - x.from, y.from - y.to});
  svg.begin_surfaces();
  for (const MapCell* cell : cells) {
    const double w = step_at(across, cell->level) / 2, h = step_at(upwards, cell->level) / 2;
    const double l = x(cell->at[0] - w), r = x(cell->at[0] + w);
    const double b = y(cell->at[1] - h), t = y(cell->at[1] + h);
    svg.surface({{l, b}, {r, b}, {r, t}, {l, t}},
                has_value(*cell) ? colours(cell->beta) : kNoValueColour, 1);
  }
  svg.end_surfaces();
  const auto missing = std::count_if(cells.begin(), cells.end(),
                                     [](const MapCell* cell) { return !has_value(*cell); });
  for (const MapCell* cell : cells) {
    if (has_value(*cell) || missing > kMostCrosses) continue;
    svg.mark({x(cell->at[0]), y(cell->at[1])}, Mark::kCross, 2, {.stroke = "#888888"});
  }
  svg.end_clip();
  for (const Tick& tick : round_ticks(x, 5)) {
    svg.text({x(tick.value), y.from + 14}, tick.label, {.anchor = Anchor::kMiddle});
    svg.line({x(tick.value), y.from}, {x(tick.value), y.from + 3}, {.stroke = "#222222"});
  }
  svg.text({(x.from + x.to) / 2, y.from + 29}, axis_name(across), {.anchor = Anchor::kMiddle});
  draw_y_axis(svg, {0, 1, x.from, x.from}, y, round_ticks(y, 5), axis_name(upwards));
  draw_frame(svg, x, y);
  colours.draw(svg, {x.to + 12, y.from}, kMapSide - 20, value_name(map));
  return svg.str();
}

/// The values over one coordinate.
std::string draw_map_curve(const CapabilityMap& map) {
  const MapAxis& axis = map.plan.over[0];
  const auto [low, high] = range_of(map);
  const double room = std::max(0.05 * (high - low), 1e-3 * std::max(std::abs(high), 1e-3));
  Svg svg = titled(map, kMapTop + 200 + kMapBelow);
  const Axis x = wide_axis(axis, kMapLeft, kPageWidth - 12);
  const Axis y = make_axis(low - room, high + room, kMapTop + 200, kMapTop, "values");
  draw_x_axis(svg, x, y, round_ticks(x, 6), axis_name(axis));
  draw_y_axis(svg, x, y, round_ticks(y, 5), "beta " + value_name(map));
  draw_frame(svg, x, y);
  std::vector<Point> points;
  const auto finish = [&] {
    if (points.size() > 1) svg.polyline(points, {.stroke = "#0072B2", .width = 1.5});
    for (const Point& point : points) svg.circle(point, 2, {.fill = "#0072B2"});
    points.clear();
  };
  for (const MapCell& cell : map.cells) {
    if (has_value(cell)) {
      points.emplace_back(x(cell.at[0]), y(cell.beta));
      continue;
    }
    finish();
    svg.mark({x(cell.at[0]), y.from - 5}, Mark::kCross, 3, {.stroke = "#888888"});
  }
  finish();
  return svg.str();
}

/// The values over an azimuth, from the centre outwards. Negative ones are at the centre.
std::string draw_rose(const CapabilityMap& map) {
  const double largest = range_of(map).second;
  const double most = largest > 0 ? largest : 1;
  const Axis radius = make_axis(0, most, 0, kRoseRadius, "values");
  const Point centre(kPageWidth / 2, kMapTop + kRoseRadius + 16);
  Svg svg = titled(map, centre.y() + kRoseRadius + 48);
  const auto at = [&](double azimuth, double value) {
    const double r = radius(std::max(0.0, value));
    return Point(centre + r * Point(std::cos(azimuth), -std::sin(azimuth)));
  };
  for (const Tick& tick : round_ticks(radius, 3)) {
    if (tick.value <= 0) continue;
    svg.circle(centre, radius(tick.value), {.stroke = "#dddddd", .width = 0.8});
  }
  for (int i = 0; i < 4; ++i) {
    const double angle = i * std::numbers::pi / 2;
    svg.line(centre, at(angle, most), {.stroke = "#dddddd", .width = 0.8});
    const Point label = centre + (kRoseRadius + 12) * Point(std::cos(angle), -std::sin(angle));
    svg.text(label + Point(0, 4),
             i == 0   ? "0"
             : i == 1 ? "\u03c0/2"
             : i == 2 ? "\u03c0"
                      : "3\u03c0/2",
             {.anchor = Anchor::kMiddle});
  }
  std::vector<Point> outline;
  for (const MapCell& cell : map.cells) {
    outline.push_back(at(cell.at[0], has_value(cell) ? cell.beta : 0));
  }
  const bool whole = map.plan.over[0].high - map.plan.over[0].low > 1.9 * std::numbers::pi;
  if (!whole) outline.push_back(centre);
  svg.polygon(outline, {.stroke = "#0072B2", .width = 1.5, .fill = "#A9CDE6", .fill_opacity = 0.5});
  for (const MapCell& cell : map.cells) {
    if (has_value(cell)) {
      svg.circle(at(cell.at[0], cell.beta), 2, {.fill = "#0072B2"});
    } else {
      svg.mark(at(cell.at[0], most), Mark::kCross, 3, {.stroke = "#888888"});
    }
  }
  for (const Tick& tick : round_ticks(radius, 3)) {
    if (tick.value <= 0) continue;
    svg.text(at(std::numbers::pi / 8, tick.value) + Point(2, 0), tick.label, {.halo = "#ffffff"});
  }
  svg.text({kPageWidth / 2, svg.height() - 8},
           fmt::format("beta {} over the azimuth of c [rad]", value_name(map)),
           {.anchor = Anchor::kMiddle});
  return svg.str();
}

/// Points in a box of three coordinates, the nearest last.
std::string draw_map_points(const CapabilityMap& map) {
  const ColourScale colours = scale_of(map);
  const Camera camera = camera_from({1.0, -1.6, 1.0});
  const auto seen = [&](const Eigen::Vector3d& at) {
    Eigen::Vector3d unit;
    for (Eigen::Index a = 0; a < 3; ++a) {
      const MapAxis& axis = map.plan.over[static_cast<std::size_t>(a)];
      unit[a] = axis.count < 2 ? 0 : 2 * (at[a] - axis.low) / (axis.high - axis.low) - 1;
    }
    return camera(unit);
  };
  const Point middle(kPageWidth / 2 - 26, kMapTop + kMapSide / 2 + 8);
  const auto on_page = [&](const Eigen::Vector3d& at) {
    return Point(middle + kBoxSize * Point(at.x(), -at.y()));
  };
  Svg svg = titled(map, kMapTop + kMapSide + kMapBelow);
  const auto corner = [&](int bits) {
    Eigen::Vector3d at;
    for (Eigen::Index a = 0; a < 3; ++a) {
      const MapAxis& axis = map.plan.over[static_cast<std::size_t>(a)];
      at[a] = bits >> a & 1 ? axis.high : axis.low;
    }
    return at;
  };
  for (int from = 0; from < 8; ++from) {
    for (int a = 0; a < 3; ++a) {
      if (from >> a & 1) continue;
      svg.line(on_page(seen(corner(from))), on_page(seen(corner(from | 1 << a))),
               {.stroke = "#bbbbbb", .width = 0.8});
    }
  }
  std::vector<std::pair<double, const MapCell*>> cells;
  for (const MapCell& cell : map.cells) cells.emplace_back(seen(cell.at.head<3>()).z(), &cell);
  std::stable_sort(cells.begin(), cells.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const double radius = std::clamp(60 / std::cbrt(static_cast<double>(cells.size())), 1.2, 6.0);
  for (const auto& [depth, cell] : cells) {
    const Point at = on_page(seen(cell->at.head<3>()));
    if (has_value(*cell)) {
      svg.circle(at, radius, {.fill = colours.text(cell->beta), .fill_opacity = 0.85});
    } else {
      svg.mark(at, Mark::kCross, 1.5, {.stroke = kNoValue});
    }
  }
  // Each coordinate has its name in the middle of an edge, and its limits at the ends.
  const int edges[3][2] = {{0, 1}, {1, 3}, {0, 4}};
  for (std::size_t a = 0; a < 3; ++a) {
    const MapAxis& axis = map.plan.over[a];
    const Point from = on_page(seen(corner(edges[a][0]))), to = on_page(seen(corner(edges[a][1])));
    const Point out = a == 2 ? Point(-8, 4) : Point(a == 0 ? -8 : 8, 16);
    const auto write = [&](const Point& at, const std::string& text) {
      svg.text(at + out, text, {.anchor = a == 1 ? Anchor::kStart : Anchor::kEnd});
    };
    write(from + 0.1 * (to - from), with_minus(axis.low));
    write(from + 0.5 * (to - from), axis_name(axis));
    write(from + 0.9 * (to - from), with_minus(axis.high));
  }
  colours.draw(svg, {kPageWidth - kMapRight + 12, kMapTop + kMapSide}, kMapSide - 20,
               value_name(map));
  return svg.str();
}

}  // namespace

std::string map_figure(const CapabilityMap& map) {
  const std::vector<MapAxis>& over = map.plan.over;
  const auto several =
      std::count_if(over.begin(), over.end(), [](const MapAxis& axis) { return axis.count > 1; });
  if (over.size() == 1 && several == 1) {
    return over[0].name == "azimuth" ? draw_rose(map) : draw_map_curve(map);
  }
  if (over.size() == 2 && several == 2) return draw_heat_map(map);
  if (over.size() == 3) return draw_map_points(map);
  throw std::invalid_argument(fmt::format(
      "figure: got a map of {} coordinates with several values, expected 1, 2 or 3", several));
}

}  // namespace maxwrench
