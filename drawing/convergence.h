#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace maxwrench {

/// The shortfall of the best value so far from a reference, as a share of the reference, after a
/// number of evaluations. Infinity while there is no value.
struct ConvergenceCurve {
  std::string name;
  std::function<double(double evaluations)> shortfall;
};

struct ConvergencePanel {
  std::string title;
  double budget = 1;  ///< evaluations at which the axis ends
  std::vector<ConvergenceCurve> curves;
};

/// Draws panels below each other as SVG: shortfall against evaluations, both logarithmic. The
/// curves in `named` have styles and names in one legend; the others are grey.
std::string draw_convergence(std::span<const ConvergencePanel> panels,
                             const std::vector<std::string>& named);

}  // namespace maxwrench
