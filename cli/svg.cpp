#include "cli/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

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
    text += fmt::format("{}{:.2f},{:.2f}", text.empty() ? "" : " ", p.x(), p.y());
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += c;
    }
  }
  return result;
}

/// The bytes of the UTF-8 character that starts at `i`.
std::size_t character_length(std::string_view text, std::size_t i) {
  std::size_t length = 1;
  while (i + length < text.size() && (static_cast<unsigned char>(text[i + length]) & 0xC0U) == 0x80)
    ++length;
  return length;
}

/// Text with its lowered characters; `dy` shifts all that follows, so the rest is raised again.
std::string spans(std::string_view text, double size) {
  std::string result;
  std::string plain;
  double lowered = 0;
  const auto flush = [&] {
    if (plain.empty()) return;
    // Renderers drop a blank at the start of a span: a shift takes its place.
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
    if (text[i] != '_' || i + 1 == text.size()) {
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
    result += fmt::format(R"(<tspan dy="{:.2f}" font-size="{:.1f}">{}</tspan>)", drop, 0.72 * size,
                          escaped(text.substr(i, length)));
    lowered = 0.22 * size;
    i += length;
  }
  flush();
  return result;
}

}  // namespace

Svg::Svg(double width, double height) : width_(width), height_(height) {}

void Svg::line(const Point& a, const Point& b, const Paint& paint) {
  body_ += fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"{}/>\n", a.x(),
                       a.y(), b.x(), b.y(), attributes(paint));
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
  body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"{}/>\n", centre.x(),
                       centre.y(), radius, attributes(paint));
}

void Svg::arrow(const Point& tail, const Point& tip, const Paint& paint, double head) {
  const double length = (tip - tail).norm();
  if (length < 1e-6) return;
  const Point along = (tip - tail) / length;
  const Point across(-along.y(), along.x());
  head = std::min(head, length);
  const Point neck = tip - head * along;
  line(tail, neck + 0.2 * head * along, paint);  // under the head, so that no gap shows
  Paint solid;
  solid.fill = paint.stroke;
  polygon({tip, neck + 0.38 * head * across, neck - 0.38 * head * across}, solid);
}

void Svg::text(const Point& at, std::string_view text, const Font& font) {
  static const char* const kAnchors[] = {"start", "middle", "end"};
  std::string extra;
  if (font.bold) extra += " font-weight=\"bold\"";
  if (font.italic) extra += " font-style=\"italic\"";
  if (font.angle != 0) {
    extra +=
        fmt::format(" transform=\"rotate({:.1f} {:.2f} {:.2f})\"", -font.angle, at.x(), at.y());
  }
  body_ += fmt::format(
      R"(<text x="{:.2f}" y="{:.2f}" font-size="{:.1f}" fill="{}" text-anchor="{}"{}>{}</text>)",
      at.x(), at.y(), font.size, font.colour, kAnchors[static_cast<int>(font.anchor)], extra,
      spans(text, font.size));
  body_ += '\n';
}

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

double round_step(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  const double mantissa = value / power * (1 + 1e-9);
  return (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * power;
}

}  // namespace maxwrench
