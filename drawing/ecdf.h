#pragma once

#include <span>
#include <string>
#include <vector>

#include "maxwrench/types.h"

namespace maxwrench {

/// The share of all targets that was reached, against the budget spent.
struct EcdfCurve {
  std::string name;
  /// (budget, share from there on), both ascending
  std::vector<Eigen::Vector2d> steps;
};

struct EcdfPanel {
  std::string title;
  std::string axis;  ///< name of the budget, whose axis is logarithmic
  std::vector<EcdfCurve> curves;
  std::string shares = "targets reached";  ///< name of the share
};

/// Draws panels in rows of `columns` as SVG. The curves in `named`, which must be few, have styles
/// and names in one legend; the others are grey. Steps that are not positive are drawn at the left
/// end of the logarithmic axis. Throws std::invalid_argument if a step is not finite.
std::string draw_ecdf(std::span<const EcdfPanel> panels, const std::vector<std::string>& named,
                      int columns);

}  // namespace maxwrench
