#include "drawing/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kLargest = 1e100;   // larger powers of ten are outside the range of double
constexpr double kNarrowest = 1e-9;  // of the largest value; narrower ticks coincide by rounding
constexpr int kMostTicks = 50;
constexpr double kLeastNameLeft = 9;  // px, so that a name along the left edge is not cut

const Paint& faint() {
  static const Paint kFaint{.stroke = "#e2e2e2", .width = 0.8};
  return kFaint;
}

}  // namespace

Axis make_axis(double low, double high, double from, double to, const std::string& what) {
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(size < kLargest) || !(high - low > kNarrowest * size) || !(high - low > 1 / kLargest)) {
    throw std::invalid_argument(
        fmt::format("figure: got {} between {:g} and {:g}, expected finite values that differ",
                    what, low, high));
  }
  return {low, high, from, to};
}

std::vector<Tick> round_ticks(const Axis& axis, int pieces) {
  const double step = round_step((axis.high - axis.low) / pieces);
  const double first = std::ceil(axis.low / step * (1 - 1e-12));
  std::vector<Tick> ticks;
  for (int i = 0; i < kMostTicks; ++i) {
    const double value = step * (first + i);
    if (!(value <= axis.high + 1e-9 * step)) break;
    ticks.push_back({value, with_minus(value)});
  }
  return ticks;
}

void draw_x_axis(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks,
                 const std::string& name) {
  const double foot = std::max(y.from, y.to);
  for (const Tick& tick : ticks) {
    const double at = x(tick.value);
    svg.line({at, y.from}, {at, y.to}, faint());
    if (tick.label.empty()) continue;
    svg.text({at, foot + 14}, tick.label, {.anchor = Anchor::kMiddle});
  }
  if (name.empty()) return;
  svg.text({(x.from + x.to) / 2, foot + 29}, name, {.anchor = Anchor::kMiddle});
}

void draw_y_lines(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks) {
  for (const Tick& tick : ticks) {
    svg.line({x.from, y(tick.value)}, {x.to, y(tick.value)}, faint());
  }
}

void draw_y_axis(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks,
                 const std::string& name) {
  draw_y_lines(svg, x, y, ticks);
  double widest = 0;
  for (const Tick& tick : ticks) {
    svg.text({x.from - 5, y(tick.value) + 4}, tick.label, {.anchor = Anchor::kEnd});
    widest = std::max(widest, text_width(tick.label, Font().size));
  }
  svg.text({std::max(x.from - 11 - widest, kLeastNameLeft), (y.from + y.to) / 2}, name,
           {.anchor = Anchor::kMiddle, .angle = 90});
}

void draw_frame(Svg& svg, const Axis& x, const Axis& y) {
  svg.polygon({{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}},
              {.stroke = "#8a8a8a", .width = 0.8});
}

double round_step(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  const double mantissa = value / power * (1 + 1e-9);
  return (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * power;
}

std::string with_digits(double value, int digits) {
  if (std::abs(value) < 1e-6) return "0";
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  const int power = std::stoi(rounded.substr(rounded.find('e') + 1));
  if (power > 6) return with_minus(value, "{:.3g}");
  return with_minus(value, fmt::format("{{:.{}f}}", std::max(0, digits - 1 - power)).c_str());
}

std::string with_minus(double value, const char* format) {
  const std::string digits = fmt::format(fmt::runtime(format), std::abs(value));
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? "\u2212" : "") + digits;
}

}  // namespace maxwrench
