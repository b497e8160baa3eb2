#include "cli/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/layout.h"
#include "cli/svg.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr const char* kRed = "#D55E00";
constexpr const char* kInk = "#222222";
constexpr const char* kSteel = "#5b6770";
constexpr const char* kViolet = "#6A3D9A";

// px
constexpr double kLeft = 52, kRight = 14, kGap = 18, kTop = 34, kTicks = 40, kLegendLine = 18,
                 kTouch = 22;

/// Draws one panel whose plot has its upper left corner at `corner` [px].
class PanelWriter {
 public:
  PanelWriter(Svg& svg, const Layout& layout, const DrawnPosture& panel, const Scene& scene,
              Point corner)
      : svg_(svg),
        layout_(layout),
        panel_(panel),
        scene_(scene),
        corner_(std::move(corner)),
        to_px_{{corner_.x() - layout.scale * layout.box.min().x(),
                corner_.y() + layout.scale * layout.box.max().y()},
               layout.scale} {}

  void draw(View view, bool leftmost) {
    grid(view, leftmost);
    fills();
    base();
    outlines();
    arm();
    touch();
    direction();
    end_effector();
    legend();
    svg_.text(corner_ + Point(layout_.size.x() / 2, -12), panel_.title,
              {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  }

 private:
  Point force(const Point& h) const { return to_px_(scene_.end_effector + layout_.metres * h); }
  std::vector<Point> outline(const ForceSet& set) const {
    std::vector<Point> points;
    for (const Point& h : set.outline) points.push_back(force(h));
    return points;
  }
  const char* colour(const ForceSet& set) const { return layout_.colours.at(set.name); }

  void grid(View view, bool leftmost) {
    const Paint faint{.stroke = "#e8e8e8", .width = 0.8};
    const double step = round_step(layout_.box.sizes().maxCoeff() / 4);
    const double bottom = corner_.y() + layout_.size.y();
    const auto first = [&](double low) { return std::lround(std::ceil(low / step)); };
    const auto last = [&](double high) { return std::lround(std::floor(high / step)); };
    const auto label = [&](long i) {
      const std::string digits = fmt::format("{:.6g}", step * static_cast<double>(std::abs(i)));
      return i < 0 ? "\u2212" + digits : digits;
    };
    for (long i = first(layout_.box.min().x()); i <= last(layout_.box.max().x()); ++i) {
      const double x = to_px_({step * static_cast<double>(i), 0}).x();
      svg_.line({x, corner_.y()}, {x, bottom}, faint);
      svg_.text({x, bottom + 14}, label(i), {.size = 10, .anchor = Anchor::kMiddle});
    }
    for (long i = first(layout_.box.min().y()); i <= last(layout_.box.max().y()); ++i) {
      const double y = to_px_({0, step * static_cast<double>(i)}).y();
      svg_.line({corner_.x(), y}, {corner_.x() + layout_.size.x(), y}, faint);
      if (leftmost)
        svg_.text({corner_.x() - 6, y + 3.5}, label(i), {.size = 10, .anchor = Anchor::kEnd});
    }
    const Point right(layout_.size.x(), 0);
    const Point down(0, layout_.size.y());
    svg_.polygon({corner_, corner_ + right, corner_ + right + down, corner_ + down},
                 {.stroke = "#9a9a9a", .width = 0.8});
    svg_.text({corner_.x() + layout_.size.x() / 2, bottom + 30}, "x [m]",
              {.size = 11, .anchor = Anchor::kMiddle});
    if (leftmost)
      svg_.text({corner_.x() - 38, corner_.y() + layout_.size.y() / 2},
                view == View::kTop ? "y [m]" : "z [m]",
                {.size = 11, .anchor = Anchor::kMiddle, .angle = 90});
  }

  void fills() {
    for (const ForceSet& set : panel_.sets) {
      svg_.polygon(outline(set), {.fill = colour(set), .fill_opacity = 0.1});
    }
  }

  void base() {
    for (const Silhouette& body : scene_.bodies) {
      if (body.on_base || panel_.sets.empty()) draw_body(body);
    }
    svg_.polygon(to_px_(scene_.hull),
                 {.stroke = kSteel, .width = 1.2, .fill = "#dfe5ea", .fill_opacity = 0.75});
    for (const auto& [p, direction] : scene_.thrusters) {
      const Point tail = to_px_(p);
      const double length = panel_.u.size() > 0 ? layout_.metres * layout_.scale : 26;
      const Point arrow(length * direction.x(), -length * direction.y());
      svg_.arrow(tail, tail + arrow, {.stroke = kSteel, .width = 1.4}, 6);
      svg_.circle(tail, 2.5, {.fill = kSteel});
    }
  }

  void draw_body(const Silhouette& body) {
    svg_.polygon(to_px_(body.outline), {.stroke = kSteel,
                                        .width = 1.2,
                                        .fill = body.on_base ? "#dfe5ea" : "#c3ccd3",
                                        .fill_opacity = 0.75});
  }

  /// Sets of forces cover the base but not the arm, in whatever depth it is.
  void arm() {
    for (const Silhouette& body : scene_.bodies) {
      if (!body.on_base && !panel_.sets.empty()) draw_body(body);
    }
    for (const auto& [a, b] : scene_.links) {
      svg_.polyline({to_px_(a), to_px_(b)}, {.stroke = kSteel, .width = 6});
      svg_.polyline({to_px_(a), to_px_(b)}, {.stroke = "#c3ccd3", .width = 4});
    }
    for (const Point& p : scene_.joints) {
      svg_.circle(to_px_(p), 4, {.stroke = kSteel, .width = 1.4, .fill = "#ffffff"});
    }
  }

  /// The second contact and, dashed, the places that it may have.
  void touch() {
    if (!scene_.touch) return;
    const Touch& touch = *scene_.touch;
    if (!touch.places.empty())
      svg_.polyline(to_px_(touch.places), {.stroke = kViolet, .width = 1.4, .dash = "4 3"});
    const Point place = to_px_(touch.place);
    svg_.arrow(place, place + kTouch * on_paper(touch.into), {.stroke = kViolet, .width = 1.6}, 7);
    svg_.circle(place, 3, {.fill = kViolet});
  }

  void outlines() {
    for (const ForceSet& set : panel_.sets) {
      svg_.polygon(outline(set), {.stroke = colour(set), .width = 1.6, .dash = dash(set)});
    }
  }
  static std::string dash(const ForceSet& set) { return set.wrench == Wrench::kAny ? "6 3" : ""; }

  /// The arrow c, and beta c of each set; where the force that attains beta is no multiple of c, a
  /// line across c joins the two.
  void direction() {
    if (panel_.sets.empty()) return direction_symbol();
    const double reach = reach_along_c(panel_, scene_.c);
    const Point tip = force(reach * scene_.c);
    svg_.arrow(force({0, 0}), tip, {.stroke = kRed, .width = 1.6}, 9);
    name_c(tip + 10 * on_paper(scene_.c));
    for (const ForceSet& set : panel_.sets) {
      if (std::isnan(set.beta)) continue;
      const Point on_c = force(set.beta * scene_.c);
      const Point h = force(set.h);
      if (set.wrench == Wrench::kAny) {
        svg_.line(on_c, h, {.stroke = colour(set), .width = 1, .dash = "2 2"});
        svg_.circle(h, 3.2, {.stroke = colour(set), .width = 1.4, .fill = "#ffffff"});
      }
      svg_.circle(on_c, 3.2, {.stroke = "#ffffff", .width = 0.8, .fill = colour(set)});
    }
  }

  static Point on_paper(const Point& direction) { return {direction.x(), -direction.y()}; }

  void name_c(const Point& at) {
    svg_.text(
        at + Point(0, 4), "c",
        {.size = 14, .colour = kRed, .anchor = Anchor::kMiddle, .bold = true, .italic = true});
  }

  /// c without a length: a force as an arrow, a torque as an arrow with two heads or, about the
  /// line of sight, as part of a circle.
  void direction_symbol() {
    const Paint red{.stroke = kRed, .width = 1.8};
    const Point centre = to_px_(scene_.end_effector);
    const double length = layout_.symbol * layout_.scale;
    if (scene_.c.norm() > 1e-9) {
      const Point tip = centre + length * on_paper(scene_.c);
      svg_.arrow(centre, tip, red, 9);
      name_c(tip + 10 * on_paper(scene_.c.normalized()));
    }
    if (scene_.c_torque.norm() > 1e-9) {
      const Point along = on_paper(scene_.c_torque.normalized());
      const Point tip = centre + length * on_paper(scene_.c_torque);
      svg_.arrow(centre, tip - 7 * along, red, 9);
      svg_.arrow(centre, tip, red, 9);
      name_c(tip + 10 * along);
    }
    if (std::abs(scene_.c_towards) > 1e-9) sight_symbol(centre, red);
    if (std::abs(scene_.c_turn) > 1e-9) turn_symbol(centre, 0.6 * length, red);
  }

  void sight_symbol(const Point& centre, const Paint& red) {
    constexpr double kRadius = 9;
    svg_.circle(centre, kRadius, red);
    if (scene_.c_towards < 0) {
      for (const Point& d : {Point(1, 1), Point(1, -1)}) {
        svg_.line(centre - kRadius * d.normalized(), centre + kRadius * d.normalized(), red);
      }
    }
    name_c(centre + Point(kRadius + 9, 12));
  }

  void turn_symbol(const Point& centre, double radius, const Paint& red) {
    std::vector<Point> arc;
    for (int degrees = 60; degrees <= 330; degrees += 10) {
      const double angle = std::copysign(degrees, scene_.c_turn) * std::numbers::pi / 180;
      arc.push_back(centre + radius * on_paper({std::cos(angle), std::sin(angle)}));
    }
    svg_.polyline(arc, red);
    const Point last = arc.back() - arc[arc.size() - 2];
    svg_.arrow(arc.back(), arc.back() + 9 * last.normalized(), red, 9);
    name_c(centre + Point(radius + 10, 0));
  }

  void end_effector() {
    const Point centre = to_px_(scene_.end_effector);
    for (const Point& axis : {scene_.tool_x, scene_.tool_y}) {
      svg_.arrow(centre, centre + 20 * Point(axis.x(), -axis.y()), {.stroke = kInk, .width = 1.1},
                 5);
    }
    svg_.circle(centre, 2.6, {.fill = kInk});
  }

  void legend() {
    double y = corner_.y() + layout_.size.y() + kTicks + 12;
    const double x = corner_.x() + 2;
    for (const ForceSet& set : panel_.sets) {
      svg_.polygon({{x, y - 9}, {x + 22, y - 9}, {x + 22, y}, {x, y}}, {.stroke = colour(set),
                                                                        .width = 1.4,
                                                                        .dash = dash(set),
                                                                        .fill = colour(set),
                                                                        .fill_opacity = 0.15});
      svg_.text({x + 30, y}, set.name, {.size = 11.5});
      const std::string value =
          std::isnan(set.beta) ? "no value" : fmt::format("\u03b2 = {:.2f} N", set.beta);
      svg_.text({corner_.x() + layout_.size.x() - 2, y}, value,
                {.size = 11.5, .anchor = Anchor::kEnd});
      y += kLegendLine;
    }
  }

  Svg& svg_;
  const Layout& layout_;
  const DrawnPosture& panel_;
  const Scene& scene_;
  Point corner_;
  Viewport to_px_;
};

/// The length of a round number of newtons, ending at `right`.
void force_scale_bar(Svg& svg, const Layout& layout, const Point& right) {
  const double px_per_newton = layout.metres * layout.scale;
  const double newtons = round_step(90 / px_per_newton);
  const Point left = right - Point(newtons * px_per_newton, 0);
  const Paint ink{.stroke = kInk, .width = 1.2};
  svg.line(left, right, ink);
  for (const Point& end : {left, right}) svg.line(end - Point(0, 4), end + Point(0, 4), ink);
  svg.text(left - Point(8, -4),
           fmt::format("{:.6g} N ({:.6g} N per m)", newtons, 1 / layout.metres),
           {.size = 11, .anchor = Anchor::kEnd});
}

/// What the dots on c mean.
void marker_note(Svg& svg, const Point& left, bool any) {
  svg.circle(left + Point(5, 0), 3.2, {.fill = kInk});
  svg.text(left + Point(13, 4), "\u03b2 c", {.size = 11});
  if (!any) return;
  svg.circle(left + Point(48, 0), 3.2, {.stroke = kInk, .width = 1.4, .fill = "#ffffff"});
  svg.text(left + Point(56, 4), "force that attains \u03b2", {.size = 11});
}

/// What is violet.
void touch_note(Svg& svg, const Point& left) {
  svg.circle(left + Point(5, 0), 3, {.fill = kViolet});
  svg.text(left + Point(13, 4),
           "second contact, arrow into the environment; dashed: where it may be", {.size = 11});
}

Svg picture(std::span<const DrawnPosture> panels, View view) {
  const Layout layout = make_layout(panels, view);
  const double count = static_cast<double>(panels.size());
  const double width = kLeft + count * layout.size.x() + (count - 1) * kGap + kRight;
  const double legend = kLegendLine * static_cast<double>(layout.rows);
  const bool touches = std::any_of(layout.scenes.begin(), layout.scenes.end(),
                                   [](const Scene& scene) { return scene.touch.has_value(); });
  const double notes = (layout.forces ? 30 : 8) + (touches ? kLegendLine : 0);
  const double below = kTicks + legend + notes;
  Svg svg(width, kTop + layout.size.y() + below);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double x = kLeft + static_cast<double>(i) * (layout.size.x() + kGap);
    PanelWriter(svg, layout, panels[i], layout.scenes[i], {x, kTop}).draw(view, i == 0);
  }
  if (touches) touch_note(svg, {kLeft, kTop + layout.size.y() + kTicks + legend + 10});
  if (layout.forces) {
    const double y = kTop + layout.size.y() + below - 12;
    const auto is_any = [](const ForceSet& set) { return set.wrench == Wrench::kAny; };
    const bool any = std::any_of(panels.begin(), panels.end(), [&](const DrawnPosture& panel) {
      return std::any_of(panel.sets.begin(), panel.sets.end(), is_any);
    });
    marker_note(svg, {kLeft, y}, any);
    force_scale_bar(svg, layout, {width - kRight - 2, y});
  }
  return svg;
}

}  // namespace

std::string draw_postures(std::span<const DrawnPosture> panels, View view) {
  return picture(panels, view).str();
}

std::string draw_both_views(std::span<const DrawnPosture> panels) {
  const auto titled = [&](const char* view) {
    std::vector<DrawnPosture> copy(panels.begin(), panels.end());
    for (DrawnPosture& panel : copy) panel.title += view;
    return copy;
  };
  const Svg side = picture(titled(", from the right"), View::kSide);
  const Svg top = picture(titled(", from above"), View::kTop);
  Svg both(std::max(side.width(), top.width()), side.height() + top.height());
  both.place(side, {0, 0});
  both.place(top, {0, side.height()});
  return both.str();
}

std::string draw_posture(const DrawnPosture& panel, View view) {
  return draw_postures({&panel, 1}, view);
}

}  // namespace maxwrench
