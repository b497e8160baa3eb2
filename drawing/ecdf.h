#pragma once

#include <span>
#include <string>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The share of all targets that was reached, against what was spent.
struct EcdfCurve {
  std::string name;
  /// (spent, share from there on), ascending in both.
  std::vector<Eigen::Vector2d> steps;
};

struct EcdfPanel {
  std::string title;
  std::string axis;  ///< what is spent: its axis is logarithmic
  std::vector<EcdfCurve> curves;
  std::string shares = "targets reached";  ///< what is shared
};

/// Panels in rows of `columns` as SVG. The curves of `named` have styles and names in one legend,
/// which must be few; the others are grey. Steps that cannot be drawn on a logarithmic axis (not
/// positive) stand at its left end. Throws std::invalid_argument if a step is not finite.
std::string draw_ecdf(std::span<const EcdfPanel> panels, const std::vector<std::string>& named,
                      int columns);

}  // namespace maxwrench
