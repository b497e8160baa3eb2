#include "drawing/named_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace maxwrench {
namespace {

const Paint kOthers = {.stroke = "#c2c2c2", .width = 0.8};

}  // namespace

int NamedCurves::place(const std::string& name) const {
  const auto found = std::find(named_.begin(), named_.end(), name);
  return found == named_.end() ? -1 : static_cast<int>(found - named_.begin());
}

void NamedCurves::draw(Svg& svg, const std::string& name,
                       const std::vector<Eigen::Vector2d>& points, double left,
                       double decade) const {
  const int i = place(name);
  if (i < 0) {
    svg.polyline(points, kOthers);
    return;
  }
  const CurveStyle style = curve_style(static_cast<std::size_t>(i));
  svg.polyline(points, {.stroke = style.colour, .width = 1.5, .dash = style.dash});
  double next = left + decade * (i + 1) / static_cast<double>(named_.size() + 1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    while (points[k].x() >= next) {
      const Eigen::Vector2d& last = points[k > 0 ? k - 1 : 0];
      if (last.x() < next) draw_mark(svg, {next, last.y()}, style);
      next += decade;
    }
  }
}

std::vector<LegendEntry> NamedCurves::legend(const std::set<std::string>& drawn) const {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < named_.size(); ++i) {
    if (drawn.contains(named_[i])) entries.push_back(legend_entry(named_[i], curve_style(i)));
  }
  if (entries.size() == drawn.size()) return entries;
  entries.push_back({"all others", [](Svg& svg, const Eigen::Vector2d& left) {
                       svg.line(left, left + Eigen::Vector2d(kLegendMark, 0), kOthers);
                     }});
  return entries;
}

std::string decade_label(int decade) {
  static const char* const kUnits[] = {"", "k", "M", "G", "T"};
  if (decade < 0) return fmt::format("{:.6g}", std::pow(10, decade));
  return fmt::format("{}{}", std::lround(std::pow(10, decade % 3)), kUnits[decade / 3]);
}

}  // namespace maxwrench
