#include "benchmarks/race/race_statistics.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace maxwrench {
namespace {

/// The quantile of sorted values, of which there is at least one.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double rest = place - static_cast<double>(below);
  if (rest == 0) return sorted[below];
  const double low = sorted[below], high = sorted[below + 1];
  if (!std::isfinite(low)) return low;
  return std::isfinite(high) ? low + rest * (high - low) : high;
}

}  // namespace

double target_below(double best_known, double share) {
  return best_known == -kInfinity ? kInfinity : best_known - share * std::abs(best_known);
}

Spent first_hit(const RaceRun& run, double target) {
  if (run.interrupted) return kNever;
  for (const Rise& rise : run.rises) {
    if (rise.value >= target) return rise.at;
  }
  return kNever;
}

double value_after(const RaceRun& run, Cost cost, double spent) {
  double best = -kInfinity;
  for (const Rise& rise : run.rises) {
    if (rise.at.*cost <= spent) best = rise.value;
  }
  return best;
}

int reached(std::span<const RaceRun> runs, double target) {
  return static_cast<int>(std::count_if(runs.begin(), runs.end(), [target](const RaceRun& run) {
    return std::isfinite(first_hit(run, target).evaluations);
  }));
}

double expected_running_time(std::span<const RaceRun> runs, double target, Cost cost) {
  double sum = 0;
  for (const RaceRun& run : runs) {
    const double hit = first_hit(run, target).*cost;
    sum += std::isfinite(hit) ? hit : run.spent.*cost;
  }
  const int successes = reached(runs, target);
  return successes > 0 ? sum / successes : kInfinity;
}

std::vector<EcdfStep> ecdf(std::vector<double> hits) {
  std::sort(hits.begin(), hits.end());
  std::vector<EcdfStep> steps;
  const auto all = static_cast<double>(hits.size());
  for (std::size_t i = 0; i < hits.size() && std::isfinite(hits[i]); ++i) {
    if (steps.empty() || steps.back().spent < hits[i]) steps.push_back({hits[i], 0});
    steps.back().share = static_cast<double>(i + 1) / all;
  }
  return steps;
}

double share_reached(std::span<const EcdfStep> steps, double spent) {
  double share = 0;
  for (const EcdfStep& step : steps) {
    if (step.spent <= spent) share = step.share;
  }
  return share;
}

Quartiles quartiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

double median(std::vector<double> values) { return quartiles(std::move(values)).median; }

}  // namespace maxwrench
