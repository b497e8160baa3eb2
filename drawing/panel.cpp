#include "drawing/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/axes.h"
#include "drawing/direction.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

// px
constexpr double kTitle = 22, kTicks = 34, kValue = 82, kValueLine = 15, kPanelFoot = 6,
                 kContactArrow = 20;

/// The number of values of beta in one row.
std::size_t values_per_row(const Layout& layout) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(layout.cell / kValue));
}

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
        x_(make_axis(layout.box.min().x(), layout.box.max().x(), corner_.x(),
                     corner_.x() + layout.size.x(), "places")),
        y_(make_axis(layout.box.min().y(), layout.box.max().y(), corner_.y() + layout.size.y(),
                     corner_.y(), "places")),
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
    values();
    svg_.text(corner_ + Point(layout_.size.x() / 2, -8), fitted(panel_.title, 12, layout_.cell),
              {.size = 12, .anchor = Anchor::kMiddle, .bold = true});
  }

 private:
  Point force(const Point& h) const { return to_px_(scene_.end_effector + layout_.metres * h); }
  std::vector<Point> outline(const ForceSet& set) const {
    std::vector<Point> points;
    for (const Point& h : set.outline) points.push_back(force(h));
    return points;
  }
  const CurveStyle& style(const ForceSet& set) const { return layout_.styles.at(set.name); }

  void grid(View view, bool leftmost) {
    const auto pieces = [](double length, double px) {
      return std::max(2, static_cast<int>(length / px));
    };
    draw_x_axis(svg_, x_, y_, round_ticks(x_, pieces(layout_.size.x(), 80)), "x [m]");
    const std::vector<Tick> ticks = round_ticks(y_, pieces(layout_.size.y(), 50));
    if (leftmost) {
      draw_y_axis(svg_, x_, y_, ticks, view == View::kTop ? "y [m]" : "z [m]");
    } else {
      draw_y_lines(svg_, x_, y_, ticks);
    }
    draw_frame(svg_, x_, y_);
  }

  void fills() {
    for (const ForceSet& set : panel_.sets) {
      svg_.polygon(outline(set), {.fill = style(set).colour, .fill_opacity = 0.1});
    }
  }

  void base() {
    for (const Silhouette& body : scene_.bodies) {
      if (body.on_base || panel_.sets.empty()) draw_body(body);
    }
    svg_.polygon(to_px_(scene_.hull),
                 {.stroke = kSteel, .width = 1.2, .fill = kBaseFill, .fill_opacity = 0.75});
    if (scene_.mount) draw_mount(svg_, to_px_(*scene_.mount));
    for (const auto& [p, direction] : scene_.thrusters) {
      const Point tail = to_px_(p);
      const double length = panel_.u.size() > 0 ? layout_.metres * layout_.scale : 20;
      const Point arrow(length * direction.x(), -length * direction.y());
      svg_.arrow(tail, tail + arrow, kPaintThrust, 6);
      svg_.circle(tail, 2.2, {.fill = kSteel});
    }
  }

  void draw_body(const Silhouette& body) {
    svg_.polygon(to_px_(body.outline), {.stroke = kSteel,
                                        .width = 1.2,
                                        .fill = body.on_base ? kBaseFill : kArmFill,
                                        .fill_opacity = 0.75});
  }

  /// Force sets cover the base but not the arm, whatever its depth.
  void arm() {
    for (const Silhouette& body : scene_.bodies) {
      if (!body.on_base && !panel_.sets.empty()) draw_body(body);
    }
    for (const auto& [a, b] : scene_.links) draw_link(svg_, to_px_(a), to_px_(b));
    for (const Point& p : scene_.joints) draw_joint(svg_, to_px_(p));
  }

  /// Draws the second contact and, dashed, its possible places.
  void touch() {
    if (!scene_.touch) return;
    const ContactMark& touch = *scene_.touch;
    if (!touch.places.empty()) svg_.polyline(to_px_(touch.places), kPaintPlaces);
    const Point place = to_px_(touch.place);
    svg_.arrow(place, place + kContactArrow * on_paper(touch.into), kPaintContact, 7);
    svg_.mark(place, Mark::kSquare, 3, kPaintContact);
  }

  void outlines() {
    for (const ForceSet& set : panel_.sets) {
      // A line without dashes is wide, so that it is visible under dashes.
      const double width = *style(set).dash == 0 ? 2.6 : 1.5;
      svg_.polygon(outline(set),
                   {.stroke = style(set).colour, .width = width, .dash = style(set).dash});
    }
  }

  /// Draws the arrow c, and beta c of each set. If the force that attains beta is no multiple of c,
  /// a line across c joins the two.
  void direction() {
    if (panel_.sets.empty()) return direction_symbol();
    const double reach = reach_along_c(panel_, scene_.c);
    const Point tip = force(reach * scene_.c);
    svg_.arrow(force({0, 0}), tip, kPaintC, 9);
    name_c(tip + 10 * on_paper(scene_.c));
    for (const ForceSet& set : panel_.sets) {
      if (std::isnan(set.beta)) continue;
      const Point on_c = force(set.beta * scene_.c);
      const Point h = force(set.h);
      if (set.wrench == Wrench::kAny) {
        svg_.line(on_c, h, {.stroke = style(set).colour, .width = 1, .dash = "1 2"});
        svg_.mark(h, style(set).mark, 3.4, set_mark(style(set), true));
      }
      svg_.mark(on_c, style(set).mark, 3.4, set_mark(style(set), false));
    }
  }

  static Point on_paper(const Point& direction) { return {direction.x(), -direction.y()}; }

  void name_c(const Point& at) {
    svg_.text(at + Point(0, 4), "c",
              {.size = 14,
               .colour = kPaintC.stroke,
               .anchor = Anchor::kMiddle,
               .bold = true,
               .italic = true});
  }

  /// Draws c without a length: a force as an arrow, a torque as an arrow with two heads or, about
  /// the line of sight, as part of a circle.
  void direction_symbol() {
    const Point centre = to_px_(scene_.end_effector);
    const double length = layout_.symbol * layout_.scale;
    if (scene_.c.norm() > 1e-9) {
      const Point tip = centre + length * on_paper(scene_.c);
      svg_.arrow(centre, tip, kPaintC, 9);
      name_c(tip + 10 * on_paper(scene_.c.normalized()));
    }
    if (scene_.c_torque.norm() > 1e-9) {
      const Point along = on_paper(scene_.c_torque.normalized());
      const Point tip = centre + length * on_paper(scene_.c_torque);
      draw_torque(svg_, centre, tip, kPaintC, 9);
      name_c(tip + 10 * along);
    }
    if (std::abs(scene_.c_towards) > 1e-9) {
      draw_sight(svg_, centre, 8, scene_.c_towards, kPaintC);
      name_c(centre + Point(17, 12));
    }
    if (std::abs(scene_.c_turn) > 1e-9) {
      draw_turn(svg_, centre, 0.6 * length, scene_.c_turn, kPaintC, 9);
      name_c(centre + Point(0.6 * length + 10, 0));
    }
  }

  void end_effector() {
    const Point centre = to_px_(scene_.end_effector);
    for (const Point& axis : {scene_.tool_x, scene_.tool_y}) {
      svg_.arrow(centre, centre + 20 * Point(axis.x(), -axis.y()), {.stroke = kInk, .width = 1.1},
                 5);
    }
    svg_.circle(centre, 2.6, {.fill = kInk});
  }

  void values() {
    const std::size_t columns = values_per_row(layout_);
    // Below the cell, which may be wider than the plot.
    const Point first = corner_ + Point((layout_.size.x() - layout_.cell) / 2,
                                        layout_.size.y() + kTicks + kValueLine - 4);
    for (std::size_t i = 0; i < panel_.sets.size(); ++i) {
      const ForceSet& set = panel_.sets[i];
      const std::size_t row = i / columns, column = i % columns;
      const Point at = first + Point(static_cast<double>(column) * kValue,
                                     static_cast<double>(row) * kValueLine);
      svg_.mark(at + Point(5, -4), style(set).mark, 3.4, set_mark(style(set), false));
      svg_.text(at + Point(13, 0),
                std::isnan(set.beta) ? "no value" : with_minus(set.beta, "{:.2f}") + " N", {});
    }
  }

  Svg& svg_;
  const Layout& layout_;
  const DrawnPosture& panel_;
  const Scene& scene_;
  Point corner_;
  Axis x_, y_;
  Viewport to_px_;
};

}  // namespace

Paint set_mark(const CurveStyle& style, bool open) {
  return {.stroke = open ? style.colour : "#ffffff",
          .width = open ? 1.3 : 0.7,
          .fill = open ? "#ffffff" : style.colour};
}

void draw_joint(Svg& svg, const Point& at) {
  svg.circle(at, 3.2, {.stroke = kSteel, .width = 1.4, .fill = "#ffffff"});
}

void draw_link(Svg& svg, const Point& a, const Point& b) {
  svg.polyline({a, b}, {.stroke = kSteel, .width = 5.5});
  svg.polyline({a, b}, {.stroke = kArmFill, .width = 3.5});
}

void draw_mount(Svg& svg, const Point& at) {
  svg.polygon({at + Point(-9, -4), at + Point(9, -4), at + Point(9, 4), at + Point(-9, 4)},
              {.stroke = kInk, .width = 1, .fill = "#8a8a8a"});
}

double panel_height(const Layout& layout) {
  const std::size_t columns = values_per_row(layout);
  const std::size_t rows = (layout.sets + columns - 1) / columns;
  return kTitle + layout.size.y() + kTicks + kValueLine * static_cast<double>(rows) + kPanelFoot;
}

void draw_panel(Svg& svg, const Layout& layout, const DrawnPosture& panel, const Scene& scene,
                const Point& corner, View view, bool leftmost) {
  const Point plot = corner + Point((layout.cell - layout.size.x()) / 2, kTitle);
  PanelWriter(svg, layout, panel, scene, plot).draw(view, leftmost);
}

}  // namespace maxwrench
