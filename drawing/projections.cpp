#include "drawing/projections.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "drawing/axes.h"
#include "drawing/legend.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;
/// x from, x to, y from, y to.
using Rectangle = std::array<double, 4>;

// px
constexpr double kTriangleLeft = 54, kTriangleTop = 26, kTriangleRight = 12, kTriangleGap = 9,
                 kTriangleBottom = 40, kTallest = 230, kStrip = 36;
constexpr double kAround = 0.06;   // share of the width of all boxes, added on either side
constexpr double kNoWidth = 1e-6;  // a narrower axis is widened by kSomeWidth
constexpr double kSomeWidth = 0.05;
constexpr int kMostPieces = 8;                      // of an axis, between ticks
constexpr double kTickHeight = 20, kTickApart = 8;  // px
constexpr std::size_t kStyles[kBoxColours] = {1, 2, 3, 4, 6, 7};
const char* const kGreys[] = {"#9a9a9a", "#d4d4d4"};

using Intervals = std::vector<std::pair<double, double>>;

/// The union of the intervals, in order.
Intervals united(Intervals parts) {
  std::sort(parts.begin(), parts.end());
  Intervals result;
  for (const auto& part : parts) {
    if (result.empty() || part.first > result.back().second) {
      result.push_back(part);
    } else {
      result.back().second = std::max(result.back().second, part.second);
    }
  }
  return result;
}

/// The same area as rectangles that do not overlap: rows between neighbouring edges, with equal
/// neighbouring rows merged.
std::vector<Rectangle> united(std::vector<Rectangle> area) {
  std::sort(area.begin(), area.end());
  area.erase(std::unique(area.begin(), area.end()), area.end());
  std::vector<double> edges;
  for (const Rectangle& r : area) edges.insert(edges.end(), {r[2], r[3]});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<Intervals> rows(edges.size());
  for (const Rectangle& r : area) {
    const auto first = std::lower_bound(edges.begin(), edges.end(), r[2]) - edges.begin();
    for (auto k = static_cast<std::size_t>(first); edges[k] < r[3]; ++k) {
      rows[k].emplace_back(r[0], r[1]);
    }
  }
  for (Intervals& row : rows) row = united(std::move(row));
  std::vector<Rectangle> result;
  for (std::size_t k = 0; k + 1 < edges.size();) {
    std::size_t next = k + 1;
    while (next + 1 < edges.size() && rows[next] == rows[k]) ++next;
    for (const auto& [from, to] : rows[k]) result.push_back({from, to, edges[k], edges[next]});
    k = next;
  }
  return result;
}

/// The range from the first box to the last, with some space around it, but not beyond the limits.
std::pair<double, double> shown(const std::vector<BoxGroup>& groups, Eigen::Index i, double lower,
                                double upper) {
  double low = kInfinity, high = -kInfinity;
  for (const BoxGroup& group : groups) {
    for (const auto& box : group.lower) low = std::min(low, box[i]);
    for (const auto& box : group.upper) high = std::max(high, box[i]);
  }
  if (!(low <= high)) throw std::invalid_argument("figure: got no boxes, expected some");
  const double margin = kAround * (high - low);
  low = std::max(low - margin, lower);
  high = std::min(high + margin, upper);
  if (high - low > kNoWidth) return {low, high};
  return {low - kSomeWidth, high + kSomeWidth};
}

class Triangle {
 public:
  Triangle(const std::vector<BoxAxis>& axes, const std::vector<BoxGroup>& groups)
      : axes_(axes), groups_(groups), d_(static_cast<int>(axes.size())) {
    for (int i = 0; i < d_; ++i) ranges_.push_back(shown(groups, i, axis(i).lower, axis(i).upper));
    const int columns = std::max(d_ - 1, 1);
    const double width = kPageWidth - kTriangleLeft - kTriangleRight;
    size_.x() = (width - (columns - 1) * kTriangleGap) / columns;
    size_.y() = d_ == 1 ? kStrip : std::min(size_.x(), kTallest);
  }

  std::string draw(const std::string& title) const {
    const int rows = std::max(d_ - 1, 1);
    const double foot =
        kTriangleTop + rows * size_.y() + (rows - 1) * kTriangleGap + kTriangleBottom;
    const Point corner(kTriangleLeft, foot);
    const double width = kPageWidth - kTriangleLeft;
    Svg svg(kPageWidth, foot + draw_legend(nullptr, legend(), corner, width, 2) + 8);
    svg.text({kTriangleLeft, kTriangleTop - 9}, title, {.size = 12, .bold = true});
    if (one_unit()) {
      svg.text({kPageWidth - kTriangleRight, kTriangleTop - 9}, "in " + axis(0).unit,
               {.anchor = Anchor::kEnd});
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column <= row; ++column) panel(svg, row, column);
    }
    draw_legend(&svg, legend(), corner, width, 2);
    return svg.str();
  }

 private:
  const BoxAxis& axis(int i) const { return axes_[static_cast<std::size_t>(i)]; }

  /// Draws a panel: x is coordinate `column`; y is coordinate `row` + 1 if there is one.
  void panel(Svg& svg, int row, int column) const {
    const Point corner(kTriangleLeft + column * (size_.x() + kTriangleGap),
                       kTriangleTop + row * (size_.y() + kTriangleGap));
    const auto range = [this](int i) { return ranges_[static_cast<std::size_t>(i)]; };
    const auto [left, right] = range(column);
    const Axis x = make_axis(left, right, corner.x(), corner.x() + size_.x(), axis(column).name);
    const auto [low, high] = d_ == 1 ? std::pair(0.0, 1.0) : range(row + 1);
    const Axis y = make_axis(low, high, corner.y() + size_.y(), corner.y(), "y");
    grid(svg, x, y, row, column);
    areas(svg, x, y, row, column);
    draw_frame(svg, x, y);
    for (std::size_t i = groups_.size(); i-- > 0;) {
      const Eigen::VectorXd& mark = groups_[i].mark;
      if (mark.size() == 0) continue;
      draw_best(svg, {x(mark[column]), y(d_ == 1 ? 0.5 : mark[row + 1])}, i);
    }
  }

  void grid(Svg& svg, const Axis& x, const Axis& y, int row, int column) const {
    const bool last = row + 2 >= d_;
    std::vector<Tick> across = ticks_of(x, true);
    if (!last) {
      for (Tick& tick : across) tick.label.clear();
    }
    draw_x_axis(svg, x, y, across, last ? name(column) : "");
    if (d_ == 1) return;
    const std::vector<Tick> up = ticks_of(y, false);
    if (column == 0) draw_y_axis(svg, x, y, up, name(row + 1));
    if (column > 0) draw_y_lines(svg, x, y, up);
  }

  /// As many ticks as there is room for their labels.
  static std::vector<Tick> ticks_of(const Axis& axis, bool across) {
    const double length = std::abs(axis.to - axis.from);
    for (int pieces = kMostPieces;; --pieces) {
      std::vector<Tick> ticks = round_ticks(axis, pieces);
      double each = kTickHeight;
      for (const Tick& tick : ticks) {
        if (across) each = std::max(each, text_width(tick.label, Font().size) + kTickApart);
      }
      if (pieces == 1 || static_cast<double>(ticks.size()) * each <= length) return ticks;
    }
  }

  double room() const { return (d_ == 1 ? size_.x() : size_.minCoeff()) + kTriangleGap; }

  static std::string with_unit(const BoxAxis& axis) { return axis.name + " [" + axis.unit + "]"; }

  /// Whether one text at the top gives the unit of all axes, because the names with units do not
  /// fit.
  bool one_unit() const {
    const bool same = std::all_of(axes_.begin(), axes_.end(), [this](const BoxAxis& each) {
      return each.unit == axes_.front().unit;
    });
    return same && std::any_of(axes_.begin(), axes_.end(), [this](const BoxAxis& each) {
             return text_width(with_unit(each), Font().size) > room();
           });
  }

  std::string name(int i) const {
    return fitted(one_unit() ? axis(i).name : with_unit(axis(i)), Font().size, room());
  }

  /// Draws the areas, the largest first.
  void areas(Svg& svg, const Axis& x, const Axis& y, int row, int column) const {
    std::vector<std::pair<double, std::size_t>> order;
    std::vector<std::vector<Rectangle>> all;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      all.push_back(area(groups_[i], row, column));
      double size = 0;
      for (const Rectangle& r : all.back()) size += (r[1] - r[0]) * (r[3] - r[2]);
      order.emplace_back(-size, groups_.size() - i);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [size, place] : order) {
      const std::size_t i = groups_.size() - place;
      for (const auto& [left, right, foot, top] : all[i]) {
        svg.polygon(
            {{x(left), y(foot)}, {x(right), y(foot)}, {x(right), y(top)}, {x(left), y(top)}},
            fill(i));
      }
    }
  }

  std::vector<Rectangle> area(const BoxGroup& group, int row, int column) const {
    std::vector<Rectangle> boxes;
    for (std::size_t k = 0; k < group.lower.size(); ++k) {
      const Eigen::VectorXd &low = group.lower[k], &high = group.upper[k];
      const bool strip = d_ == 1;
      boxes.push_back(
          {low[column], high[column], strip ? 0 : low[row + 1], strip ? 1 : high[row + 1]});
    }
    return united(std::move(boxes));
  }

  /// The line hides seams and makes thin areas visible.
  Paint fill(std::size_t i) const {
    const char* const colour = colour_of(i);
    return {.stroke = colour, .width = 0.6, .fill = colour};
  }

  /// Styles in the order of the groups that have a colour. No colour is black and no mark occurs
  /// twice.
  CurveStyle style_of(std::size_t i) const {
    std::size_t place = 0;
    for (std::size_t k = 0; k < i; ++k) place += groups_[k].grey ? 0 : 1;
    return curve_style(kStyles[place % std::size(kStyles)]);
  }
  const char* colour_of(std::size_t i) const {
    if (!groups_[i].grey) return style_of(i).colour;
    std::size_t place = 0;
    for (std::size_t k = 0; k < i; ++k) place += groups_[k].grey ? 1 : 0;
    return kGreys[std::min(place, std::size(kGreys) - 1)];
  }

  void draw_best(Svg& svg, const Point& at, std::size_t i) const {
    svg.mark(at, style_of(i).mark, 3.4, {.stroke = "#222222", .width = 1.1, .fill = "#ffffff"});
  }

  std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      entries.push_back(
          {groups_[i].name, [this, i](Svg& svg, const Point& left) {
             const Point up(0, -5), down(0, 5), end(kLegendMark, 0);
             svg.polygon({left + up, left + end + up, left + end + down, left + down}, fill(i));
             if (groups_[i].mark.size() > 0) draw_best(svg, left + end / 2, i);
           }});
    }
    return entries;
  }

  const std::vector<BoxAxis>& axes_;
  const std::vector<BoxGroup>& groups_;
  int d_;
  std::vector<std::pair<double, double>> ranges_;
  Point size_;
};

}  // namespace

std::string draw_projections(const std::string& title, const std::vector<BoxAxis>& axes,
                             const std::vector<BoxGroup>& groups) {
  return Triangle(axes, groups).draw(title);
}

}  // namespace maxwrench
