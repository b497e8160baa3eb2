#pragma once

#include <set>
#include <string>
#include <vector>

#include "drawing/legend.h"

namespace maxwrench {

/// Many curves, of which a few are named. Named curves have entries in the legend and a style that
/// is the same in all panels. All other curves are thin and grey, below the named ones.
class NamedCurves {
 public:
  explicit NamedCurves(std::vector<std::string> named) : named_(std::move(named)) {}

  /// The index of the name, or -1 if it is not among the named ones.
  int place(const std::string& name) const;
  /// Draws a curve in px. Its marks are about a `decade` of px apart, from `left` on, at positions
  /// that differ between curves.
  void draw(Svg& svg, const std::string& name, const std::vector<Eigen::Vector2d>& points,
            double left, double decade) const;
  /// The legend entries of the curves in `drawn`.
  std::vector<LegendEntry> legend(const std::set<std::string>& drawn) const;

 private:
  std::vector<std::string> named_;
};

/// The label of a power of ten: "0.01", "1", "10k".
std::string decade_label(int decade);

}  // namespace maxwrench
