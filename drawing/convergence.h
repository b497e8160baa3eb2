#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace maxwrench {

/// How far the best value so far stays below a reference, as a share of it, after so many
/// evaluations; infinity while there is none.
struct ConvergenceCurve {
  std::string name;
  std::function<double(double evaluations)> shortfall;
};

struct ConvergencePanel {
  std::string title;
  double budget = 1;  ///< evaluations, where the axis ends
  std::vector<ConvergenceCurve> curves;
};

/// Panels below each other as SVG, shortfalls against evaluations, both logarithmic. The curves of
/// `named` have styles and names in one legend, the others are grey.
std::string draw_convergence(std::span<const ConvergencePanel> panels,
                             const std::vector<std::string>& named);

}  // namespace maxwrench
