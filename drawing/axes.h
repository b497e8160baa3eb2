#pragma once

#include <string>
#include <vector>

#include "drawing/svg.h"

namespace maxwrench {

/// One axis of a picture. The values `low` and `high` are at `from` and `to` px.
struct Axis {
  double low = 0, high = 1;
  double from = 0, to = 1;

  double operator()(double value) const {
    return from + (to - from) * ((value - low) / (high - low));
  }
};

/// Throws std::invalid_argument unless low < high are finite, small enough to draw, and clearly
/// different. `what` names the values in the message.
Axis make_axis(double low, double high, double from, double to, const std::string& what);

struct Tick {
  double value = 0;
  std::string label;
};

/// The multiples of a round step that divide the axis into about `pieces` intervals, or a few times
/// as many at most.
std::vector<Tick> round_ticks(const Axis& axis, int pieces);

/// Draws lines across the plot at the ticks of x, and their labels and the axis name below the
/// plot. An empty name draws no name. y.from is the lower edge of the plot.
void draw_x_axis(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks,
                 const std::string& name);
/// The same for y, left of the plot.
void draw_y_axis(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks,
                 const std::string& name);
/// Draws the lines of y without labels, for plots that share the axis of their left neighbour.
void draw_y_lines(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks);
/// Draws the rectangle around the plot.
void draw_frame(Svg& svg, const Axis& x, const Axis& y);

/// The largest of 1, 2, 5 times a power of ten that does not exceed `value`, which must be
/// positive.
double round_step(double value);

/// The formatted value with a minus sign instead of a hyphen, and without a sign before a zero.
std::string with_minus(double value, const char* format = "{:.6g}");

/// The value with this many significant digits, also if the last ones are zeros: "9.000". A value
/// that rounds to zero beside 1 is "0".
std::string with_digits(double value, int digits);

}  // namespace maxwrench
