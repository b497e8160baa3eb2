#pragma once

#include <string>
#include <vector>

#include "drawing/svg.h"

namespace maxwrench {

/// One axis of a picture: the values `low` and `high` are at `from` and `to` px.
struct Axis {
  double low = 0, high = 1;
  double from = 0, to = 1;

  double operator()(double value) const {
    return from + (to - from) * ((value - low) / (high - low));
  }
};

/// Throws std::invalid_argument unless low < high are finite, of a size that can be drawn, and not
/// almost the same. `what` names the values in its message.
Axis make_axis(double low, double high, double from, double to, const std::string& what);

struct Tick {
  double value = 0;
  std::string label;
};

/// The multiples of a round step that cut the axis into about `pieces`, never more than a few times
/// as many.
std::vector<Tick> round_ticks(const Axis& axis, int pieces);

/// Lines across the plot, labels and a name at the ticks of x, below the plot; an empty name draws
/// no name. y.from is the plot's foot.
void draw_x_axis(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks,
                 const std::string& name);
/// The same of y, left of the plot.
void draw_y_axis(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks,
                 const std::string& name);
/// The lines of y without labels, for plots that share the axis of their left neighbour.
void draw_y_lines(Svg& svg, const Axis& x, const Axis& y, const std::vector<Tick>& ticks);
/// The rectangle around the plot.
void draw_frame(Svg& svg, const Axis& x, const Axis& y);

/// The largest of 1, 2, 5 times a power of ten that does not exceed `value`, a positive one.
double round_step(double value);

/// With a minus sign instead of a hyphen, and no minus before a zero.
std::string with_minus(double value, const char* format = "{:.6g}");

}  // namespace maxwrench
