#include "cli/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/svg.h"

namespace maxwrench {
namespace {

using Point = Eigen::Vector2d;

constexpr double kPanelWidth = 380, kPanelHeight = 300, kPanelLeft = 70, kPanelTop = 36,
                 kPanelGap = 30, kPanelBottom = 50;
constexpr double kLegend = 110;
constexpr double kSmallest = 1e-6;  // share of the best value: the foot of the picture
constexpr int kPointsPerDecade = 24;
constexpr const char* kLineColours[] = {"#E69F00", "#000000", "#0072B2", "#009E73", "#CC79A7",
                                        "#56B4E9", "#D55E00", "#B8A800", "#888888"};

const char* colour(std::size_t i) { return kLineColours[i % std::size(kLineColours)]; }
/// Colours that come round again are dashed.
std::string dash(std::size_t i) { return i < std::size(kLineColours) ? "" : "5 3"; }

/// One panel in decades: x log10 of evaluations from 0, y log10 of the shortfall up to 0.
class DecadePanel {
 public:
  DecadePanel(Svg& svg, const Comparison& comparison, double left)
      : svg_(svg), comparison_(comparison), left_(left) {
    for (const Contender& contender : comparison.contenders)
      for (const Attempt& each : contender.attempts)
        decades_ = std::max(decades_, std::log10(static_cast<double>(each.choice.budget)));
  }

  void draw(bool leftmost) {
    grid(leftmost);
    const double best = comparison_.best();
    for (std::size_t i = 0; i < comparison_.contenders.size(); ++i)
      svg_.polyline(curve(comparison_.contenders[i], best),
                    {.stroke = colour(i), .width = 1.6, .dash = dash(i)});
    svg_.text({left_ + kPanelWidth / 2, kPanelTop - 12}, comparison_.problem,
              {.size = 13, .anchor = Anchor::kMiddle, .bold = true});
  }

 private:
  Point at(double x, double y) const {
    return {left_ + kPanelWidth * x / decades_,
            kPanelTop + kPanelHeight * y / std::log10(kSmallest)};
  }

  void grid(bool leftmost) {
    static const char* const kPowers[] = {"1", "10", "100", "1k", "10k", "100k", "1M", "10M"};
    const Paint faint{.stroke = "#e8e8e8", .width = 0.8};
    const double foot = std::log10(kSmallest);
    for (int x = 0; x <= decades_ && x < static_cast<int>(std::size(kPowers)); ++x) {
      svg_.line(at(x, 0), at(x, foot), faint);
      svg_.text(at(x, foot) + Point(0, 14), kPowers[x], {.size = 10, .anchor = Anchor::kMiddle});
    }
    for (int y = 0; y >= foot; --y) {
      const Paint target{.stroke = "#9a9a9a", .width = 0.8, .dash = "4 3"};
      svg_.line(at(0, y), at(decades_, y), y == -3 ? target : faint);
      if (leftmost)
        svg_.text(at(0, y) + Point(-6, 3.5), fmt::format("{:.6g} %", 100 * std::pow(10, y)),
                  {.size = 10, .anchor = Anchor::kEnd});
    }
    svg_.polygon({at(0, 0), at(decades_, 0), at(decades_, foot), at(0, foot)},
                 {.stroke = "#9a9a9a", .width = 0.8});
    svg_.text(at(decades_ / 2, foot) + Point(0, 34), "evaluations",
              {.size = 11, .anchor = Anchor::kMiddle});
    if (leftmost)
      svg_.text({left_ - 56, kPanelTop + kPanelHeight / 2}, "median below the best known value",
                {.size = 11, .anchor = Anchor::kMiddle, .angle = 90});
  }

  /// Stairs, from the first evaluation where half of the attempts have a value.
  std::vector<Point> curve(const Contender& contender, double best) const {
    std::vector<Point> points;
    const int steps = static_cast<int>(std::lround(decades_ * kPointsPerDecade));
    for (int i = 0; i <= steps; ++i) {
      const double x = decades_ * i / steps;
      std::vector<double> shortfalls;
      for (const Attempt& each : contender.attempts)
        shortfalls.push_back((best - each.value_after(std::pow(10, x) + 0.5)) / std::abs(best));
      const double shortfall = median(shortfalls);
      if (shortfall == kInfinity) continue;
      const double y = std::log10(std::clamp(shortfall, kSmallest, 1.0));
      if (!points.empty()) points.emplace_back(at(x, 0).x(), points.back().y());
      points.push_back(at(x, y));
    }
    return points;
  }

  Svg& svg_;
  const Comparison& comparison_;
  double left_, decades_ = 1;
};

}  // namespace

std::string draw_convergence(std::span<const Comparison> comparisons) {
  const auto count = static_cast<double>(comparisons.size());
  const double right = kPanelLeft + count * (kPanelWidth + kPanelGap);
  Svg svg(right + kLegend, kPanelTop + kPanelHeight + kPanelBottom);
  for (std::size_t i = 0; i < comparisons.size(); ++i)
    DecadePanel(svg, comparisons[i],
                kPanelLeft + static_cast<double>(i) * (kPanelWidth + kPanelGap))
        .draw(i == 0);
  if (comparisons.empty()) return svg.str();
  for (std::size_t i = 0; i < comparisons[0].contenders.size(); ++i) {
    const double y = kPanelTop + 12 + 18 * static_cast<double>(i);
    svg.line({right, y}, {right + 20, y}, {.stroke = colour(i), .width = 2, .dash = dash(i)});
    svg.text({right + 26, y + 4}, comparisons[0].contenders[i].search, {});
  }
  return svg.str();
}

}  // namespace maxwrench
