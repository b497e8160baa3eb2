#include "drawing/colour_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace maxwrench {
namespace {

constexpr std::array<std::array<double, 3>, 5> kScaleColours = {
    {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
constexpr double kScaleWidth = 12;  // px
constexpr int kScaleSteps = 48;

}  // namespace

ColourScale::ColourScale(double low, double high) : low_(low), high_(high) {
  if (high - low <= 1e-9 * std::max(std::abs(low), std::abs(high))) {
    const double apart = std::max(1e-3 * std::abs(high), 1e-9);
    low_ -= apart;
    high_ += apart;
  }
  make_axis(low_, high_, 0, 1, "values");
}

std::uint32_t ColourScale::operator()(double value) const {
  constexpr double kPieces = kScaleColours.size() - 1;
  const double at = std::clamp((value - low_) / (high_ - low_), 0.0, 1.0) * kPieces;
  const auto piece = static_cast<std::size_t>(std::min(std::floor(at), kPieces - 1));
  std::uint32_t colour = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double mixed =
        kScaleColours[piece][k] +
        (at - static_cast<double>(piece)) * (kScaleColours[piece + 1][k] - kScaleColours[piece][k]);
    colour = colour << 8U | static_cast<std::uint32_t>(std::lround(mixed));
  }
  return colour;
}

std::string ColourScale::text(double value) const { return fmt::format("#{:06x}", (*this)(value)); }

void ColourScale::draw(Svg& svg, const Eigen::Vector2d& foot, double height,
                       const std::string& name) const {
  const Axis y = make_axis(low_, high_, foot.y(), foot.y() - height, "values");
  const double step = (high_ - low_) / kScaleSteps;
  for (int i = 0; i < kScaleSteps; ++i) {
    const double value = low_ + i * step;
    svg.polygon({{foot.x(), y(value)},
                 {foot.x() + kScaleWidth, y(value)},
                 {foot.x() + kScaleWidth, y(value + step)},
                 {foot.x(), y(value + step)}},
                {.stroke = text(value + step / 2), .width = 0.5, .fill = text(value + step / 2)});
  }
  for (const Tick& tick : round_ticks(y, 5)) {
    svg.text({foot.x() + kScaleWidth + 4, y(tick.value) + 4}, tick.label, {});
  }
  svg.text({foot.x(), foot.y() - height - 8}, name, {});
}

}  // namespace maxwrench
