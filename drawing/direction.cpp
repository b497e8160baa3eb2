#include "drawing/direction.h"

#include <cmath>
#include <numbers>

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

}  // namespace

void draw_torque(Svg& svg, const Point& tail, const Point& tip, const Paint& paint, double head) {
  svg.arrow(tail, tip - 0.8 * head * (tip - tail).normalized(), paint, head);
  svg.arrow(tail, tip, paint, head);
}

void draw_turn(Svg& svg, const Point& centre, double radius, double turn, const Paint& paint,
               double head) {
  std::vector<Point> arc;
  for (int degrees = 60; degrees <= 330; degrees += 10) {
    const double angle = std::copysign(degrees, turn) * std::numbers::pi / 180;
    arc.push_back(centre + radius * Point(std::cos(angle), -std::sin(angle)));
  }
  svg.polyline(arc, paint);
  const Point last = arc.back() - arc[arc.size() - 2];
  svg.arrow(arc.back(), arc.back() + head * last.normalized(), paint, head);
}

void draw_sight(Svg& svg, const Point& centre, double radius, double towards, const Paint& paint) {
  svg.circle(centre, radius, paint);
  if (towards > 0) {
    svg.circle(centre, 0.35 * radius, {.fill = paint.stroke});
    return;
  }
  for (const Point& d : {Point(1, 1), Point(1, -1)}) {
    svg.line(centre - radius * d.normalized(), centre + radius * d.normalized(), paint);
  }
}

}  // namespace maxwrench
