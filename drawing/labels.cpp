#include "drawing/labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

// px
constexpr double kLabelLine = 12, kLabelGap = 2, kNearest = 5, kFarthestLabel = 170, kRing = 9,
                 kLeader = 13;
constexpr int kDirections = 24;
constexpr double kBoldWidth = 1.08;  ///< of that of a letter that is not
// Costs of a place, as px of distance.
constexpr double kOnPicture = 130, kCrossing = 60;

Point size_of(const Label& label) {
  double width = 0;
  for (const std::string& line : label.lines) {
    width = std::max(width, text_width(line, kFontSize));
  }
  if (label.bold) width *= kBoldWidth;
  return {width, kLabelLine * static_cast<double>(label.lines.size())};
}

/// Whether the lines from a to b and from p to q cross.
bool lines_cross(const Point& a, const Point& b, const Point& p, const Point& q) {
  const auto side = [](const Point& from, const Point& to, const Point& x) {
    return (to - from).x() * (x - from).y() - (to - from).y() * (x - from).x() > 0;
  };
  return side(a, b, p) != side(a, b, q) && side(p, q, a) != side(p, q, b);
}

bool crosses(const Point& a, const Point& b, const Box& box) {
  const Point low = box.min(), high = box.max();
  return lines_cross(a, b, low, high) ||
         lines_cross(a, b, {low.x(), high.y()}, {high.x(), low.y()});
}

/// The end of a label's line at the label.
Point foot_of(const Box& box, const Point& at) {
  return at.cwiseMax(box.min()).cwiseMin(box.max());
}

class LabelPlacer {
 public:
  LabelPlacer(const Box& bounds, const std::function<double(const Box&)>& covered)
      : bounds_(bounds), covered_(covered) {}

  void place(const Label& label) {
    const Point half = size_of(label) / 2;
    double least = std::numeric_limits<double>::infinity();
    std::optional<Box> best;
    for (double distance = kNearest; distance < std::min(kFarthestLabel, least);
         distance += kRing) {
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2 * std::numbers::pi * i / kDirections;
        const Point along(std::cos(angle), std::sin(angle));
        // The box is at this distance from its place.
        const Point middle = label.at + distance * along + along.cwiseProduct(half);
        const Box box(middle - half, middle + half);
        if (!bounds_.contains(box) || !is_free(box)) continue;
        const double cost = cost_of(label, box, distance);
        if (cost >= least) continue;
        least = cost;
        best = box;
      }
    }
    if (best) placed_.push_back({label, *best});
  }

  const std::vector<PlacedLabel>& placed() const { return placed_; }

 private:
  bool is_free(const Box& box) const {
    const Point gap = Point::Constant(kLabelGap);
    const Box wide(box.min() - gap, box.max() + gap);
    return std::none_of(placed_.begin(), placed_.end(),
                        [&](const PlacedLabel& other) { return wide.intersects(other.box); });
  }

  double cost_of(const Label& label, const Box& box, double distance) const {
    double cost = distance + kOnPicture * covered_(box);
    const Point foot = foot_of(box, label.at);
    for (const PlacedLabel& other : placed_) {
      const Point other_foot = foot_of(other.box, other.label.at);
      if (lines_cross(label.at, foot, other.label.at, other_foot)) cost += kCrossing;
      if (crosses(label.at, foot, other.box)) cost += kCrossing;
      if (crosses(other.label.at, other_foot, box)) cost += kCrossing;
    }
    return cost;
  }

  Box bounds_;
  const std::function<double(const Box&)>& covered_;
  std::vector<PlacedLabel> placed_;
};

}  // namespace

std::vector<PlacedLabel> place_labels(const std::vector<Label>& labels, const Box& bounds,
                                      const std::function<double(const Box&)>& covered) {
  LabelPlacer placer(bounds, covered);
  for (const Label& label : labels) placer.place(label);
  return placer.placed();
}

void draw_labels(Svg& svg, const std::vector<PlacedLabel>& labels) {
  for (const PlacedLabel& each : labels) {
    const Point foot = foot_of(each.box, each.label.at);
    if ((foot - each.label.at).norm() < kLeader) continue;
    svg.line(each.label.at, foot, {.stroke = "#ffffff", .width = 2});
    svg.line(each.label.at, foot, {.stroke = each.label.colour, .width = 0.7});
    svg.circle(each.label.at, 1.4, {.fill = each.label.colour});
  }
  for (const PlacedLabel& each : labels) {
    // Next to its place on the left or right, a label is flush with it.
    const double middle = each.box.center().x();
    const bool left = each.label.at.x() > each.box.max().x(),
               right = each.label.at.x() < each.box.min().x();
    const double x = left ? each.box.max().x() : right ? each.box.min().x() : middle;
    double y = each.box.min().y() + 0.82 * kLabelLine;
    for (const std::string& line : each.label.lines) {
      svg.text({x, y}, line,
               {.colour = each.label.colour,
                .anchor = left    ? Anchor::kEnd
                          : right ? Anchor::kStart
                                  : Anchor::kMiddle,
                .bold = each.label.bold,
                .halo = "#ffffff"});
      y += kLabelLine;
    }
  }
}

}  // namespace maxwrench
