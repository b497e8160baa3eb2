#include "cli/suite/race_figures.h"

#include "benchmarks/race/race_summary.h"

namespace maxwrench {

std::vector<EcdfPanel> ecdf_panels(std::span<const Comparison> comparisons,
                                   const std::string& title) {
  std::vector<EcdfPanel> panels = {{title, "evaluations", {}}, {title, "ms", {}}};
  const Cost costs[] = {&Spent::evaluations, &Spent::seconds};
  for (const Standing& standing : standings(comparisons)) {
    for (std::size_t i = 0; i < panels.size(); ++i) {
      EcdfCurve& curve = panels[i].curves.emplace_back(EcdfCurve{standing.search, {}});
      const double unit = i == 0 ? 1 : 1e3;
      for (const EcdfStep& step : target_ecdf(comparisons, standing.search, costs[i])) {
        curve.steps.emplace_back(unit * step.spent, step.share);
      }
    }
  }
  return panels;
}

}  // namespace maxwrench
