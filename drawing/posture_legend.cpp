#include <algorithm>
#include <cmath>

#include "drawing/direction.h"
#include "drawing/panel.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;
using Entries = std::vector<LegendEntry>;

constexpr double kSeen = 1e-9;  // smaller parts of c are rounding

const Point kEnd(kLegendMark, 0), kMiddle(kLegendMark / 2, 0);

/// Whether the predicate holds for at least one scene.
template <class Predicate>
bool any_scene(const Layout& layout, Predicate predicate) {
  return std::any_of(layout.scenes.begin(), layout.scenes.end(), predicate);
}

void fill(Svg& svg, const Point& left, const char* colour) {
  const Point up(0, -5), down(0, 5);
  svg.polygon({left + up, left + kEnd + up, left + kEnd + down, left + down},
              {.stroke = kSteel, .width = 1.2, .fill = colour});
}

void add_robot(const Layout& layout, bool efforts, Entries& entries) {
  const auto body = [&](bool on_base) {
    return any_scene(layout, [on_base](const Scene& scene) {
      return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                         [on_base](const Silhouette& each) { return each.on_base == on_base; });
    });
  };
  if (body(true) || any_scene(layout, [](const Scene& s) { return s.hull.size() > 1; })) {
    entries.push_back({"base", [](Svg& svg, const Point& left) { fill(svg, left, kBaseFill); }});
  }
  if (any_scene(layout, [](const Scene& s) { return s.mount.has_value(); })) {
    entries.push_back(
        {"fixed base", [](Svg& svg, const Point& left) { draw_mount(svg, left + kMiddle); }});
  }
  if (body(false)) {
    entries.push_back({"link", [](Svg& svg, const Point& left) { fill(svg, left, kArmFill); }});
  } else if (any_scene(layout, [](const Scene& s) { return !s.links.empty(); })) {
    entries.push_back(
        {"link", [](Svg& svg, const Point& left) { draw_link(svg, left, left + kEnd); }});
  }
  if (any_scene(layout, [](const Scene& s) { return !s.joints.empty(); })) {
    entries.push_back(
        {"joint", [](Svg& svg, const Point& left) { draw_joint(svg, left + kMiddle); }});
  }
  if (any_scene(layout, [](const Scene& s) { return !s.thrusters.empty(); })) {
    entries.push_back({efforts ? "thrust" : "thruster", [](Svg& svg, const Point& left) {
                         svg.circle(left + Point(2, 0), 2.2, {.fill = kSteel});
                         svg.arrow(left + Point(2, 0), left + kEnd, kPaintThrust, 6);
                       }});
  }
  entries.push_back({"end effector", [](Svg& svg, const Point& left) {
                       const Paint ink{.stroke = kInk, .width = 1.1};
                       svg.arrow(left + Point(8, 4), left + Point(24, 4), ink, 5);
                       svg.arrow(left + Point(8, 4), left + Point(8, -7), ink, 5);
                       svg.circle(left + Point(8, 4), 2.4, {.fill = kInk});
                     }});
}

void add_direction(const Layout& layout, Entries& entries) {
  const bool symbol = !layout.forces;
  if (any_scene(layout, [](const Scene& s) { return s.c.norm() > kSeen; })) {
    entries.push_back({"c (force)", [](Svg& svg, const Point& left) {
                         svg.arrow(left, left + kEnd, kPaintC, 9);
                       }});
  }
  if (symbol && any_scene(layout, [](const Scene& s) { return std::abs(s.c_towards) > kSeen; })) {
    const double towards = layout.scenes.front().c_towards;
    entries.push_back({towards > 0 ? "c (force), to you" : "c (force), from you",
                       [towards](Svg& svg, const Point& left) {
                         draw_sight(svg, left + kMiddle, 6, towards, kPaintC);
                       }});
  }
  if (symbol && any_scene(layout, [](const Scene& s) { return s.c_torque.norm() > kSeen; })) {
    entries.push_back({"c (torque)", [](Svg& svg, const Point& left) {
                         draw_torque(svg, left, left + kEnd, kPaintC, 9);
                       }});
  }
  if (symbol && any_scene(layout, [](const Scene& s) { return std::abs(s.c_turn) > kSeen; })) {
    const double turn = layout.scenes.front().c_turn;
    entries.push_back({"c (torque), seen along it", [turn](Svg& svg, const Point& left) {
                         draw_turn(svg, left + kMiddle, 5, turn, kPaintC, 6);
                       }});
  }
}

void add_touch(const Layout& layout, Entries& entries) {
  if (!any_scene(layout, [](const Scene& s) { return s.touch.has_value(); })) return;
  entries.push_back({"second contact, into wall", [](Svg& svg, const Point& left) {
                       svg.arrow(left + Point(3, 0), left + kEnd, kPaintContact, 7);
                       svg.mark(left + Point(3, 0), Mark::kSquare, 3, kPaintContact);
                     }});
  if (!any_scene(layout, [](const Scene& s) { return s.touch && s.touch->places.size() > 1; }))
    return;
  entries.push_back({"where it may be", [](Svg& svg, const Point& left) {
                       svg.line(left, left + kEnd, kPaintPlaces);
                     }});
}

/// Adds the sets in the order of the panels.
void add_sets(const Layout& layout, std::span<const DrawnPosture> panels, Entries& entries) {
  std::vector<std::string> names;
  bool any = false;
  for (const DrawnPosture& panel : panels) {
    for (const ForceSet& set : panel.sets) {
      any = any || set.wrench == Wrench::kAny;
      if (std::find(names.begin(), names.end(), set.name) == names.end()) names.push_back(set.name);
    }
  }
  if (names.empty()) return;
  for (const std::string& name : names) {
    entries.push_back(legend_entry(name, layout.styles.at(name)));
  }
  entries.push_back({"\u03b2 of a set, at \u03b2 c", [](Svg& svg, const Point& left) {
                       svg.mark(left + kMiddle, Mark::kDiamond, 3.4, {.fill = kInk});
                     }});
  if (!any) return;
  entries.push_back({"force that attains \u03b2", [](Svg& svg, const Point& left) {
                       svg.mark(left + kMiddle, Mark::kFlipped, 3.4,
                                {.stroke = kInk, .width = 1.2, .fill = "#ffffff"});
                     }});
}

}  // namespace

std::vector<LegendEntry> posture_legend(const Layout& layout,
                                        std::span<const DrawnPosture> panels) {
  const bool efforts = std::any_of(panels.begin(), panels.end(),
                                   [](const DrawnPosture& panel) { return panel.u.size() > 0; });
  Entries entries;
  add_robot(layout, efforts, entries);
  add_direction(layout, entries);
  add_touch(layout, entries);
  add_sets(layout, panels, entries);
  return entries;
}

}  // namespace maxwrench
