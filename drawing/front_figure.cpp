#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drawing/axes.h"
#include "drawing/legend.h"
#include "maxwrench/figures.h"
#include "maxwrench/pareto.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kFrontLeft = 56, kFrontRight = 14, kFrontTop = 34, kFrontHeight = 260,
                 kFrontBelow = 46;  // px
constexpr double kFrontRoom = 1.08;

std::string task_name(const Answer& own) { return own.choice.problem + " beta [" + own.unit + "]"; }

/// The corners (T w_1, T w_2) that no posture exceeds in both tasks, by the first value.
std::vector<Point> proven_corners(const Front& front) {
  std::vector<Point> corners;
  for (const FrontPoint& point : front.points) {
    if (std::isfinite(point.bound)) corners.emplace_back(point.bound * point.weights);
  }
  std::sort(corners.begin(), corners.end(),
            [](const Point& a, const Point& b) { return a.x() < b.x(); });
  return corners;
}

/// The line below which all postures are: beyond a corner's first value its second one is the most.
std::vector<Point> proven_stairs(const std::vector<Point>& corners, double highest) {
  std::vector<Point> stairs = {{0, highest}};
  double most = highest;
  for (const Point& corner : corners) {
    stairs.emplace_back(corner.x(), most);
    most = std::min(most, corner.y());
    stairs.emplace_back(corner.x(), most);
  }
  return stairs;
}

}  // namespace

std::string front_figure(const Front& front) {
  if (front.points.empty()) {
    throw std::invalid_argument("figure: got no front, expected one of two tasks with values");
  }
  const std::vector<Point> corners = proven_corners(front);
  double across = 0, up = 0;
  for (const FrontPoint& point : front.points) {
    across = std::max(across, point.beta[0]);
    up = std::max(up, point.beta[1]);
  }
  for (const Point& corner : corners) {
    across = std::max(across, corner.x());
    up = std::max(up, corner.y());
  }
  Svg svg(kPageWidth, kFrontTop + kFrontHeight + kFrontBelow + kLegendLine + 8);
  const Axis x = make_axis(0, kFrontRoom * across, kFrontLeft, kPageWidth - kFrontRight, "values");
  const Axis y = make_axis(0, kFrontRoom * up, kFrontTop + kFrontHeight, kFrontTop, "values");
  draw_x_axis(svg, x, y, round_ticks(x, 6), task_name(front.own[0]));
  draw_y_axis(svg, x, y, round_ticks(y, 5), task_name(front.own[1]));
  draw_frame(svg, x, y);
  const auto at = [&](const Point& values) { return Point(x(values.x()), y(values.y())); };
  const Paint proven{.stroke = "#D55E00", .width = 1.2, .dash = "4 3"};
  const Paint found{.stroke = "#0072B2", .width = 1.5};
  if (!corners.empty()) {
    std::vector<Point> stairs;
    for (const Point& point : proven_stairs(corners, kFrontRoom * up)) stairs.push_back(at(point));
    svg.polyline(stairs, proven);
  }
  std::vector<const FrontPoint*> points;
  for (const FrontPoint& point : front.points) {
    if (point.beta.allFinite()) points.push_back(&point);
  }
  std::sort(points.begin(), points.end(),
            [](const FrontPoint* a, const FrontPoint* b) { return a->beta[0] < b->beta[0]; });
  std::vector<Point> line;
  for (const FrontPoint* point : points) line.push_back(at(point->beta));
  svg.polyline(line, {.stroke = "#9fbfd6", .width = 1});
  for (const Point& point : line) svg.circle(point, 3, {.fill = found.stroke});
  const Eigen::VectorXd& compromise = front.compromise.beta;
  if (compromise.size() == 2 && compromise.allFinite()) {
    svg.mark(at(compromise), Mark::kDiamond, 5, {.stroke = "#111111", .width = 1.5});
  }
  std::vector<LegendEntry> legend = {{"postures found",
                                      [found](Svg& to, const Point& left) {
                                        to.circle(left + Point(kLegendMark / 2, 0), 3,
                                                  {.fill = found.stroke});
                                      }},
                                     {"for both", [](Svg& to, const Point& left) {
                                        to.mark(left + Point(kLegendMark / 2, 0), Mark::kDiamond, 5,
                                                {.stroke = "#111111", .width = 1.5});
                                      }}};
  if (!corners.empty()) {
    legend.push_back({"proven limit", [proven](Svg& to, const Point& left) {
                        to.line(left, left + Point(kLegendMark, 0), proven);
                      }});
  }
  draw_legend(&svg, legend, {kFrontLeft, kFrontTop + kFrontHeight + kFrontBelow},
              kPageWidth - kFrontLeft);
  return svg.str();
}

}  // namespace maxwrench
