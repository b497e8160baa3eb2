#pragma once

#include <set>
#include <string>
#include <vector>

#include "drawing/legend.h"

namespace maxwrench {

/// Many curves of which a few have names in the legend, and styles of their own that are the same
/// in all panels; the rest is thin and grey, below them.
class NamedCurves {
 public:
  explicit NamedCurves(std::vector<std::string> named) : named_(std::move(named)) {}

  /// -1: not among the named.
  int place(const std::string& name) const;
  /// In px; with marks about a `decade` of px apart from `left`, in places of its own.
  void draw(Svg& svg, const std::string& name, const std::vector<Eigen::Vector2d>& points,
            double left, double decade) const;
  /// Of the curves that are `drawn`.
  std::vector<LegendEntry> legend(const std::set<std::string>& drawn) const;

 private:
  std::vector<std::string> named_;
};

/// A power of ten: "0.01", "1", "10k".
std::string decade_label(int decade);

}  // namespace maxwrench
