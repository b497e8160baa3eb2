#include <algorithm>

#include "benchmarks/report/benchmark_sets.h"
#include "cli/report/sections.h"
#include "drawing/ecdf.h"

namespace maxwrench {
namespace {

/// The most methods that are named in a figure.
constexpr std::size_t kNamedMethods = 8;

EcdfPanel profile_panel(const BenchmarkSet& benchmark_set) {
  EcdfPanel panel{benchmark_set.title, "times the cheapest", {}, "instances solved"};
  const auto ratios = performance_ratios(benchmark_set);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    EcdfCurve& curve = panel.curves.emplace_back(EcdfCurve{benchmark_set.methods[i], {}});
    for (const EcdfStep& step : ecdf(ratios[i])) curve.steps.emplace_back(step.spent, step.share);
  }
  return panel;
}

std::vector<std::string> draw_profiles(const std::vector<BenchmarkSet>& benchmark_sets) {
  std::vector<std::string> named;
  for (const BenchmarkSet& benchmark_set : benchmark_sets) {
    for (const MethodStanding& standing : stand(benchmark_set)) {
      const bool known = std::find(named.begin(), named.end(), standing.method) != named.end();
      if (!known && named.size() < kNamedMethods) named.push_back(standing.method);
    }
  }
  std::vector<std::string> figures;
  for (const BenchmarkSet& benchmark_set : benchmark_sets) {
    const EcdfPanel panel = profile_panel(benchmark_set);
    figures.push_back(draw_ecdf({&panel, 1}, named, 1));
  }
  return figures;
}

}  // namespace

ReportSection benchmark_set_section(ReportTable table,
                                    const std::vector<BenchmarkSet>& benchmark_sets,
                                    const std::string& method, const std::string& cost) {
  table.columns = {"benchmark_set", method,         "solved",     "instances",
                   "share_best",    "share_double", cost,         "reference",
                   "times",         "times_low",    "times_high", "p"};
  for (const BenchmarkSet& benchmark_set : benchmark_sets) {
    for (const MethodStanding& each : stand(benchmark_set)) {
      table.rows.push_back({benchmark_set.title, each.method, static_cast<double>(each.solved),
                            static_cast<double>(each.instances), each.share_best, each.share_double,
                            each.cost, each.reference, each.times, each.times_low, each.times_high,
                            each.p});
    }
  }
  return {std::move(table), draw_profiles(benchmark_sets)};
}

}  // namespace maxwrench
