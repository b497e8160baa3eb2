#include <algorithm>

#include "benchmarks/report/benchmark_sets.h"
#include "cli/report/sections.h"
#include "drawing/ecdf.h"

namespace maxwrench {
namespace {

/// Methods with names in a figure.
constexpr std::size_t kNamedMethods = 8;

EcdfPanel profile_panel(const Contest& contest) {
  EcdfPanel panel{contest.title, "times the cheapest", {}, "instances solved"};
  const auto ratios = performance_ratios(contest);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    EcdfCurve& curve = panel.curves.emplace_back(EcdfCurve{contest.methods[i], {}});
    for (const EcdfStep& step : ecdf(ratios[i])) curve.steps.emplace_back(step.spent, step.share);
  }
  return panel;
}

std::vector<std::string> draw_profiles(const std::vector<Contest>& contests) {
  std::vector<std::string> named;
  for (const Contest& contest : contests) {
    for (const MethodStanding& standing : stand(contest)) {
      const bool known = std::find(named.begin(), named.end(), standing.method) != named.end();
      if (!known && named.size() < kNamedMethods) named.push_back(standing.method);
    }
  }
  std::vector<std::string> figures;
  for (const Contest& contest : contests) {
    const EcdfPanel panel = profile_panel(contest);
    figures.push_back(draw_ecdf({&panel, 1}, named, 1));
  }
  return figures;
}

}  // namespace

ReportSection contest_section(ReportTable table, const std::vector<Contest>& contests,
                              const std::string& method, const std::string& cost) {
  table.columns = {"contest", method,      "solved", "instances", "share_best", "share_double",
                   cost,      "reference", "times",  "times_low", "times_high", "p"};
  for (const Contest& contest : contests) {
    for (const MethodStanding& each : stand(contest)) {
      table.rows.push_back({contest.title, each.method, static_cast<double>(each.solved),
                            static_cast<double>(each.instances), each.share_best, each.share_double,
                            each.cost, each.reference, each.times, each.times_low, each.times_high,
                            each.p});
    }
  }
  return {std::move(table), draw_profiles(contests)};
}

}  // namespace maxwrench
