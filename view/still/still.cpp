#include "view/still/still.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/coverage.h"
#include "drawing/depth_order.h"
#include "drawing/labels.h"
#include "drawing/legend.h"
#include "view/still/world.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;
using Point = Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

// px
constexpr double kOnePanel = 1.4 * kPageWidth;  ///< a figure of one panel
constexpr double kFullPage = 2.2 * kPageWidth;  ///< of more: a page with margins
constexpr double kPanelGap = 10, kHeadLine = 15, kRowHead = 18, kFootGap = 8, kWave = 12;
constexpr double kDetail = 0.35;       ///< what is smaller is not seen
constexpr double kShine = 0.35;        ///< opacity of what shines through
constexpr double kPerNote = 14000;     ///< the area of a panel for each label
constexpr std::size_t kLongLine = 17;  ///< bytes: a longer label has two lines
constexpr double kBesideRobot = 0.12;  ///< of a panel's width, on each side, for labels

constexpr Rgb kWaterTop = 0xf1f9fc, kWaterBottom = 0xcfe5f0, kAirTop = 0xfafcfd,
              kAirBottom = 0xe4eaef;

/// The text if it fits; otherwise the longest start of it that does, and an ellipsis.
std::string start_of(std::string text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  while (!text.empty() && text_width(text, size) + size > width) {
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; };
    while (continues(text.back())) text.pop_back();
    text.pop_back();
  }
  return text + "\u2026";
}

/// A still with its words.
struct StillPanel {
  std::string title, value;
  Still still;
  Box box;  ///< of its faces [m]
};

struct StillRow {
  std::string head;
  std::vector<StillPanel> panels;
};

std::string status_words(const ordered_json& of) {
  std::string text = of["status"];
  std::replace(text.begin(), text.end(), '_', ' ');
  if (of["reason"].is_string()) text += ": " + of["reason"].get<std::string>();
  return text;
}

std::string value_words(const ordered_json& of) {
  if (!of["beta"].is_number()) return "";
  const std::string value = with_digits(of["beta"].get<double>(), 4), unit = of["unit"];
  return unit == "-" ? value : value + " " + unit;
}

/// "β = 35.41 N m, best found"
std::string described(const ordered_json& of, const char* symbol) {
  const std::string value = value_words(of);
  return value.empty() ? status_words(of) : symbol + value + ", " + status_words(of);
}

/// The frames to draw of an entry of the scene.
std::vector<const ordered_json*> frames_at(const ordered_json& entry,
                                           const std::vector<double>& times) {
  const ordered_json& frames = entry["frames"];
  if (!frames[0].contains("t")) return {&frames[0]};
  std::vector<const ordered_json*> chosen;
  for (const double time : times) {
    const auto away = [time](const ordered_json& frame) {
      return std::abs(frame["t"].get<double>() - time);
    };
    const auto nearest =
        std::min_element(frames.begin(), frames.end(),
                         [&](const auto& a, const auto& b) { return away(a) < away(b); });
    chosen.push_back(&*nearest);
  }
  return chosen;
}

StillPanel panel_of(const StillWorld& world, const ordered_json& entry, const ordered_json& frame) {
  StillPanel panel;
  const bool timed = frame.contains("t");
  panel.title = timed ? fmt::format("t = {:.4g} s", frame["t"].get<double>())
                      : entry["name"].get<std::string>() + " posture";
  panel.value = timed ? value_words(frame) : described(entry, "\u03b2 = ");
  if (timed && !panel.value.empty()) panel.value = "\u03b2 = " + panel.value;
  panel.still = world.draw(frame);
  for (const Face& face : panel.still.faces) {
    for (const Point& corner : outline_of(face)) panel.box.extend(corner);
  }
  Box shadows;
  for (const std::vector<Point>& shadow : panel.still.shadows) {
    for (const Point& p : shadow) shadows.extend(p);
  }
  if (!shadows.isEmpty()) panel.box.extend(shadows.center());  // so that the floor is seen
  return panel;
}

/// Draws panels of one size and scale.
class StillWriter {
 public:
  StillWriter(const StillWorld& world, const ordered_json& scene, std::vector<StillRow> rows)
      : world_(world), scene_(scene), rows_(std::move(rows)) {
    std::size_t columns = 1;
    Point content = Point::Constant(1e-3);
    for (const StillRow& row : rows_) {
      columns = std::max(columns, row.panels.size());
      for (const StillPanel& panel : row.panels) content = content.cwiseMax(panel.box.sizes());
    }
    width_ = columns == 1 ? kOnePanel : kFullPage;
    const double gaps = static_cast<double>(columns - 1) * kPanelGap;
    panel_.x() = (width_ - gaps) / static_cast<double>(columns);
    const Point free(panel_.x() * (1 - 2 * kBesideRobot), 0.85 * panel_.x());
    scale_ = free.cwiseQuotient(content).minCoeff();
    panel_.y() = std::max(content.y() * scale_ + 70, 0.55 * panel_.x());
  }

  std::string svg() {
    const bool heads = !rows_.front().head.empty();
    const double row_height = (heads ? kRowHead : 0) + 2 * kHeadLine + 4 + panel_.y() + kFootGap;
    const double rows = row_height * static_cast<double>(rows_.size());
    const std::vector<LegendEntry> entries = legend();
    const int columns = rows_.front().panels.size() == 1 ? 3 : 4;
    const Point foot(4, rows + kHeadLine);
    Svg svg(width_, foot.y() + draw_legend(nullptr, entries, foot, width_ - 8, columns) + 6);
    double top = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (heads) {
        svg.text({2, top + 13}, start_of(rows_[i].head, 13, width_), {.size = 12, .bold = true});
      }
      for (std::size_t k = 0; k < rows_[i].panels.size(); ++k) {
        const double left = static_cast<double>(k) * (panel_.x() + kPanelGap);
        draw_panel(svg, rows_[i].panels[k], {left, top + (heads ? kRowHead : 0)},
                   fmt::format("p{}_{}", i, k));
      }
      top += row_height;
    }
    svg.text({4, rows + 7}, start_of(task_line(), kFontSize, width_ - 8), {.colour = "#5b6770"});
    draw_legend(&svg, entries, foot, width_ - 8, columns);
    return svg.str();
  }

 private:
  std::string task_line() const {
    std::string line = fmt::format("{}: {}", scene_["task"]["name"].get<std::string>(),
                                   scene_["robot"]["name"].get<std::string>());
    if (scene_["measure"].is_string()) {
      line += fmt::format("; {}, wrench {}", scene_["measure"].get<std::string>(),
                          scene_["wrench"].get<std::string>());
    }
    return line + fmt::format("; grid {:.6g} m", world_.grid_step());
  }

  void draw_panel(Svg& svg, const StillPanel& panel, const Point& corner, const std::string& id) {
    svg.text(corner + Point(2, 12), panel.title, {.size = 12, .bold = true});
    svg.text(corner + Point(2, 12 + kHeadLine), start_of(panel.value, 12, panel_.x()),
             {.size = 12});
    const Point plot = corner + Point(0, 2 * kHeadLine + 4);
    const bool water = scene_["robot"]["water"];
    svg.backdrop(id + "b", plot, panel_, water ? kWaterTop : kAirTop,
                 water ? kWaterBottom : kAirBottom);
    svg.begin_clip(id, plot, panel_);
    const Point middle = panel.box.center();
    const Viewport to_px{plot + panel_ / 2 + Point(0, water ? kWave / 2 : 0) -
                             scale_ * Point(middle.x(), -middle.y()),
                         scale_};
    draw_ground(svg, panel.still, to_px);
    if (water) draw_surface(svg, plot);
    const VisibleFaces faces =
        visible_faces(depth_order(panel.still.faces, kDetail / scale_), kDetail / scale_);
    draw_faces(svg, to_px, faces.seen);
    svg.begin_fade(kShine);
    draw_faces(svg, to_px, faces.hidden);
    svg.end_fade();
    draw_notes(svg, panel.still, faces.seen, to_px, Box(plot, plot + panel_));
    svg.end_clip();
  }

  static void draw_ground(Svg& svg, const Still& still, const Viewport& to_px) {
    svg.begin_fade(0.55);
    for (std::size_t i = 0; i + 1 < still.floor.size(); i += 2) {
      svg.line(to_px(still.floor[i].head<2>()), to_px(still.floor[i + 1].head<2>()),
               {.stroke = "#8a98a8", .width = 0.5});
    }
    svg.end_fade();
    svg.begin_fade(0.13);
    for (const std::vector<Point>& shadow : still.shadows) {
      if (shadow.size() > 2) svg.polygon(to_px(shadow), {.fill = "#24313d"});
    }
    svg.end_fade();
  }

  /// The surface of the water; its height has no meaning.
  void draw_surface(Svg& svg, const Point& plot) const {
    std::vector<Point> wave;
    for (double x = 0; x <= panel_.x() + 4; x += 4) {
      wave.push_back(plot + Point(x, kWave + 1.6 * std::sin(x / 9)));
    }
    std::vector<Point> above = wave;
    above.push_back(plot + Point(panel_.x() + 4, -1));
    above.push_back(plot + Point(0, -1));
    svg.polygon(above, {.fill = "#ffffff"});
    svg.polyline(wave, {.stroke = "#5bb3dd", .width = 1.2});
  }

  static Label label_of(const Note& note, const Point& at) {
    Label label{{}, at, note.colour, note.bold};
    const std::string whole = note.value.empty() ? note.name : note.name + " " + note.value;
    label.lines = {whole};
    if (whole.size() <= kLongLine) return label;
    // Two lines, as short as they can be; a number stays with its unit.
    std::size_t least = whole.size();
    for (std::size_t i = whole.find(' '); i <= note.name.size(); i = whole.find(' ', i + 1)) {
      const std::size_t longer = std::max(i, whole.size() - i - 1);
      if (longer >= least) continue;
      least = longer;
      label.lines = {whole.substr(0, i), whole.substr(i + 1)};
    }
    return label;
  }

  void draw_notes(Svg& svg, const Still& still, const std::vector<Face>& faces,
                  const Viewport& to_px, const Box& plot) const {
    Coverage coverage(plot, 2);
    for (const Face& face : faces) {
      if (face.opacity == 1) coverage.cover(to_px(outline_of(face)));
    }
    const auto most = static_cast<std::size_t>(panel_.prod() / kPerNote);
    std::vector<Note> notes = still.notes;
    std::stable_sort(notes.begin(), notes.end(),
                     [](const Note& a, const Note& b) { return a.weight > b.weight; });
    if (notes.size() > most + 2) notes.resize(most + 2);
    std::vector<Label> labels;
    for (const Note& note : notes) labels.push_back(label_of(note, to_px(note.at.head<2>())));
    const double top = scene_["robot"]["water"] ? kWave + 5 : 3;
    const Box inside(plot.min() + Point(3, top), plot.max() - Point::Constant(3));
    draw_labels(svg,
                place_labels(labels, inside, [&](const Box& box) { return coverage.share(box); }));
  }

  std::vector<LegendEntry> legend() const {
    const auto arrow = [](const char* colour) {
      return [colour](Svg& svg, const Point& left) {
        svg.arrow(left + Point(2, 0), left + Point(26, 0), {.stroke = colour, .width = 2.4}, 8);
      };
    };
    std::vector<LegendEntry> entries = {{"h, wrench exerted", arrow("#e8590c")},
                                        {"c, its direction", arrow("#7b8794")},
                                        {"effort", arrow("#16a394")},
                                        {"effort at its limit", arrow("#e11d30")}};
    const auto scale = [&](double metres, const char* of) {
      const double newtons = round_step(26 / (metres * scale_));
      const double length = newtons * metres * scale_;
      entries.push_back(
          {fmt::format("{:.6g} N of {}", newtons, of), [length](Svg& svg, const Point& left) {
             const Paint ink{.stroke = "#222222", .width = 1.2};
             svg.line(left, left + Point(length, 0), ink);
             for (const double x : {0.0, length}) {
               svg.line(left + Point(x, -3), left + Point(x, 3), ink);
             }
           }});
    };
    if (!world_.shown_set().empty()) {
      entries.push_back(
          {"all " + world_.shown_set() + "s in reach", [](Svg& svg, const Point& left) {
             const Point a = left + Point(2, -5), c = left + Point(26, 5);
             svg.polygon({a, {c.x(), a.y()}, c, {a.x(), c.y()}},
                         {.stroke = "#3d8fe8", .fill = "#2f7fd6", .fill_opacity = 0.16});
           }});
    }
    if (world_.shows_force()) scale(world_.force_metres(), "h");
    if (world_.thrust_metres() > 0) {
      scale(world_.thrust_metres(), "a force at the base");
    }
    return entries;
  }

  const StillWorld& world_;
  const ordered_json& scene_;
  std::vector<StillRow> rows_;
  double width_ = kFullPage, scale_ = 1;
  Point panel_ = Point::Zero();
};

}  // namespace

std::string still_figure(const ordered_json& scene, const std::vector<double>& times) {
  std::vector<std::vector<const ordered_json*>> frames;
  std::vector<const ordered_json*> all;
  for (const ordered_json& entry : scene["shown"]) {
    frames.push_back(frames_at(entry, times));
    all.insert(all.end(), frames.back().begin(), frames.back().end());
  }
  if (all.empty()) throw std::invalid_argument("figure: got no posture, expected some");
  const StillWorld world(scene, all);
  const bool timed = all.front()->contains("t");
  std::vector<StillRow> rows;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const ordered_json& entry = scene["shown"][i];
    if (timed || rows.empty()) rows.emplace_back();
    if (timed) {
      rows.back().head = entry["name"].get<std::string>() + " trajectory: " + described(entry, "");
    }
    for (const ordered_json* frame : frames[i]) {
      rows.back().panels.push_back(panel_of(world, entry, *frame));
    }
  }
  return StillWriter(world, scene, std::move(rows)).svg();
}

}  // namespace maxwrench
