#include "drawing/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kFarthest = 1e5;  // px

/// Checks that a coordinate can be written.
double px(double value) {
  if (std::abs(value) <= kFarthest) return value;  // false for NaN
  throw std::invalid_argument(
      fmt::format("figure: got a point at {:g} px, expected finite values of similar size", value));
}

std::string attributes(const Paint& paint) {
  std::string text = fmt::format(" fill=\"{}\"", paint.fill.empty() ? "none" : paint.fill);
  if (!paint.fill.empty() && paint.fill_opacity < 1) {
    text += fmt::format(" fill-opacity=\"{:.2f}\"", paint.fill_opacity);
  }
  if (paint.stroke.empty()) return text;
  text += fmt::format(" stroke=\"{}\" stroke-width=\"{:.2f}\"", paint.stroke, paint.width);
  if (!paint.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", paint.dash);
  return text;
}

std::string join(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points) {
    text += fmt::format("{}{:.2f},{:.2f}", text.empty() ? "" : " ", px(p.x()), px(p.y()));
  }
  return text;
}

/// A coordinate in tenths of a pixel, as few characters as it takes.
std::string tenths(long value) {
  std::string text = std::to_string(std::abs(value) / 10);
  if (value % 10 != 0) {
    if (text == "0") text.clear();
    text += '.' + std::to_string(std::abs(value) % 10);
  }
  return value < 0 ? '-' + text : text;
}

/// A path through the points, each one relative to the last as written.
std::string short_path(const std::vector<Point>& points) {
  std::string text;
  long x = 0, y = 0;
  for (const Point& p : points) {
    const long next_x = std::lround(10 * px(p.x())), next_y = std::lround(10 * px(p.y()));
    const bool first = text.empty();
    if (!first && next_x == x && next_y == y) continue;
    const std::string dx = tenths(next_x - x), dy = tenths(next_y - y);
    if (first) {
      text = "M";
    } else if (text.find('l') == std::string::npos) {
      text += 'l';
    } else if (dx[0] != '-') {
      text += ' ';
    }
    text += dx + (dy[0] == '-' ? "" : " ") + dy;
    x = next_x;
    y = next_y;
  }
  return text;
}

/// "#rrggbb", or "#rgb" if that is the same colour.
std::string hex(std::uint32_t colour) {
  const std::string full = fmt::format("{:06x}", colour);
  if (full[0] != full[1] || full[2] != full[3] || full[4] != full[5]) return '#' + full;
  return {'#', full[0], full[2], full[4]};
}

/// The number of bytes of the UTF-8 character that starts at `i`.
std::size_t character_length(std::string_view text, std::size_t i) {
  std::size_t length = 1;
  while (i + length < text.size() && (static_cast<unsigned char>(text[i + length]) & 0xC0U) == 0x80)
    ++length;
  return length;
}

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         (static_cast<unsigned char>(c) & 0x80U);
}

/// Whether the word that ends before `end` has one character.
bool after_one_letter(std::string_view text, std::size_t end) {
  std::size_t first = end;
  while (first > 0 && is_letter(text[first - 1])) --first;
  return first < end && first + character_length(text, first) == end;
}

/// The text with its subscripts. `dy` shifts everything after it, so the remaining text is raised
/// again.
std::string spans(std::string_view text, double size) {
  std::string result;
  std::string plain;
  double lowered = 0;
  const auto flush = [&] {
    if (plain.empty()) return;
    // Renderers drop a blank at the start of a span, so a shift replaces it.
    const bool blank = lowered > 0 && plain[0] == ' ';
    if (blank) plain.erase(0, 1);
    const std::string dx = blank ? fmt::format(" dx=\"{:.2f}\"", 0.3 * size) : "";
    result += lowered > 0
                  ? fmt::format("<tspan{} dy=\"{:.2f}\">{}</tspan>", dx, -lowered, escaped(plain))
                  : escaped(plain);
    lowered = 0;
    plain.clear();
  };
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '_' || i + 1 == text.size() || !after_one_letter(text, i)) {
      plain += text[i++];
      continue;
    }
    const std::size_t length = character_length(text, i + 1);
    const std::size_t after = i + 1 + length;
    if (after < text.size() && std::isalnum(static_cast<unsigned char>(text[after])) != 0) {
      plain += text[i++];  // a name
      continue;
    }
    flush();
    ++i;
    const double drop = lowered > 0 ? 0 : 0.22 * size;
    result += fmt::format(R"(<tspan dy="{:.2f}" font-size="{:.1f}">{}</tspan>)", drop, 0.8 * size,
                          escaped(text.substr(i, length)));
    lowered = 0.22 * size;
    i += length;
  }
  flush();
  return result;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

Svg::Svg(double width, double height) : width_(width), height_(height) {}

void Svg::line(const Point& a, const Point& b, const Paint& paint) {
  body_ += fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"{}/>\n",
                       px(a.x()), px(a.y()), px(b.x()), px(b.y()), attributes(paint));
}

void Svg::polygon(const std::vector<Point>& points, const Paint& paint) {
  if (points.empty()) return;
  if (points.size() == 1) {
    Paint dot = paint;
    dot.fill = paint.stroke;
    circle(points[0], 1.5 * paint.width, dot);
    return;
  }
  body_ += fmt::format("<polygon points=\"{}\"{} stroke-linejoin=\"round\"/>\n", join(points),
                       attributes(paint));
}

void Svg::polyline(const std::vector<Point>& points, const Paint& paint) {
  body_ += fmt::format(
      "<polyline points=\"{}\"{} stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n",
      join(points), attributes(paint));
}

void Svg::circle(const Point& centre, double radius, const Paint& paint) {
  body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"{}/>\n", px(centre.x()),
                       px(centre.y()), px(radius), attributes(paint));
}

void Svg::arrow(const Point& tail, const Point& tip, const Paint& paint, double head) {
  const double length = (tip - tail).norm();
  if (length < 1e-6) return;
  const Point along = (tip - tail) / length;
  const Point across(-along.y(), along.x());
  head = std::min(head, length);
  const Point neck = tip - head * along;
  line(tail, neck + 0.2 * head * along, paint);  // under the head, so that no gap is visible
  Paint solid;
  solid.fill = paint.stroke;
  polygon({tip, neck + 0.38 * head * across, neck - 0.38 * head * across}, solid);
}

void Svg::mark(const Point& at, Mark mark, double radius, const Paint& paint) {
  const auto shape = [&](std::initializer_list<Point> corners) {
    std::vector<Point> points;
    for (const Point& corner : corners) points.push_back(at + radius * corner);
    polygon(points, paint);
  };
  switch (mark) {
    case Mark::kCircle:
      return circle(at, radius, paint);
    case Mark::kSquare:
      return shape({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
    case Mark::kDiamond:
      return shape({{0, -1.3}, {1.1, 0}, {0, 1.3}, {-1.1, 0}});
    case Mark::kTriangle:
      return shape({{0, -1.2}, {1.1, 0.8}, {-1.1, 0.8}});
    case Mark::kFlipped:
      return shape({{0, 1.2}, {1.1, -0.8}, {-1.1, -0.8}});
    case Mark::kCross:
      line(at - Point(radius, radius), at + Point(radius, radius), paint);
      line(at + Point(-radius, radius), at + Point(radius, -radius), paint);
  }
}

void Svg::text(const Point& at, std::string_view text, const Font& font) {
  static const char* const kAnchors[] = {"start", "middle", "end"};
  std::string extra;
  if (font.bold) extra += " font-weight=\"bold\"";
  if (font.italic) extra += " font-style=\"italic\"";
  if (!font.halo.empty()) {
    extra += fmt::format(
        R"( stroke="{}" stroke-opacity="0.8" stroke-width="3" stroke-linejoin="round" paint-order="stroke")",
        font.halo);
  }
  if (font.angle != 0) {
    extra +=
        fmt::format(" transform=\"rotate({:.1f} {:.2f} {:.2f})\"", -font.angle, at.x(), at.y());
  }
  body_ += fmt::format(
      R"(<text x="{:.2f}" y="{:.2f}" font-size="{:.1f}" fill="{}" text-anchor="{}"{}>{}</text>)",
      px(at.x()), px(at.y()), font.size, font.colour, kAnchors[static_cast<int>(font.anchor)],
      extra, spans(text, font.size));
  body_ += '\n';
}

void Svg::begin_surfaces() {
  body_ +=
      "<g fill=\"currentColor\" stroke=\"currentColor\" stroke-width=\".7\" "
      "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n";
}

void Svg::surface(const std::vector<Point>& corners, std::uint32_t colour, double opacity) {
  const std::string path = short_path(corners);
  if (path.find('l') == std::string::npos) return;  // smaller than can be seen
  // Translucent neighbours would show a double line where they meet.
  const std::string through =
      opacity < 1 ? fmt::format(" fill-opacity=\"{:.2f}\" stroke=\"none\"", opacity) : "";
  body_ += fmt::format("<path color=\"{}\"{} d=\"{}z\"/>\n", hex(colour), through, path);
}

void Svg::surface_line(const std::vector<Point>& points, std::uint32_t colour) {
  const std::string path = short_path(points);
  if (path.find('l') == std::string::npos) return;
  body_ += fmt::format("<path color=\"{}\" fill=\"none\" d=\"{}\"/>\n", hex(colour), path);
}

void Svg::end_surfaces() { body_ += "</g>\n"; }

void Svg::backdrop(const std::string& id, const Point& corner, const Point& size, std::uint32_t top,
                   std::uint32_t bottom) {
  body_ += fmt::format(
      "<linearGradient id=\"{0}\" x2=\"0\" y2=\"1\"><stop stop-color=\"{1}\"/>"
      "<stop offset=\"1\" stop-color=\"{2}\"/></linearGradient>\n"
      "<rect x=\"{3:.1f}\" y=\"{4:.1f}\" width=\"{5:.1f}\" height=\"{6:.1f}\" rx=\"5\" "
      "fill=\"url(#{0})\"/>\n",
      id, hex(top), hex(bottom), px(corner.x()), px(corner.y()), px(size.x()), px(size.y()));
}

void Svg::begin_clip(const std::string& id, const Point& corner, const Point& size) {
  body_ += fmt::format(
      "<clipPath id=\"{}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
      "height=\"{:.1f}\" rx=\"5\"/></clipPath>\n<g clip-path=\"url(#{})\">\n",
      id, px(corner.x()), px(corner.y()), px(size.x()), px(size.y()), id);
}

void Svg::end_clip() { body_ += "</g>\n"; }

void Svg::begin_fade(double opacity) { body_ += fmt::format("<g opacity=\"{:.2f}\">\n", opacity); }

void Svg::end_fade() { body_ += "</g>\n"; }

void Svg::place(const Svg& other, const Point& corner) {
  body_ += fmt::format("<g transform=\"translate({:.2f} {:.2f})\">\n{}</g>\n", corner.x(),
                       corner.y(), other.body_);
}

std::string Svg::str() const {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
             "viewBox=\"0 0 {0:.0f} {1:.0f}\" "
             "font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
             width_, height_) +
         body_ + "</svg>\n";
}

std::vector<Point> Viewport::operator()(const std::vector<Point>& points) const {
  std::vector<Point> result;
  result.reserve(points.size());
  for (const Point& p : points) result.push_back((*this)(p));
  return result;
}

double text_width(std::string_view text, double size) {
  double characters = 0;
  for (std::size_t i = 0; i < text.size(); i += character_length(text, i)) characters += 1;
  return 0.57 * size * characters;
}

std::string fitted(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  std::size_t first = 0;
  while (first < text.size() && text_width(text.substr(first), size) + size > width) {
    first += character_length(text, first);
  }
  return "\u2026" + text.substr(first);
}

std::string with_letters(std::string text) {
  for (std::size_t i = text.find("beta"); i != std::string::npos; i = text.find("beta", i)) {
    text.replace(i, 4, "\u03b2");
  }
  return text;
}

}  // namespace maxwrench
