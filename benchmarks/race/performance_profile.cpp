#include "benchmarks/race/performance_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "benchmarks/race/significance.h"

namespace maxwrench {
namespace {

/// The cost of a method as a multiple of that of `reference`, over the instances that at least one
/// of them solved: zero where only the method did, infinity where only the reference did.
std::vector<double> paired_ratios(const std::vector<double>& method,
                                  const std::vector<double>& reference) {
  std::vector<double> ratios;
  for (std::size_t j = 0; j < method.size(); ++j) {
    if (!std::isfinite(method[j]) && !std::isfinite(reference[j])) continue;
    ratios.push_back(std::isfinite(method[j]) ? method[j] / reference[j] : kInfinity);
  }
  return ratios;
}

void set_beside(const std::vector<double>& ratios, MethodStanding& standing) {
  standing.times = median(ratios);
  const ConfidenceInterval interval = median_interval(ratios);
  standing.times_low = interval.low;
  standing.times_high = interval.high;
  std::vector<double> logarithms;
  for (const double ratio : ratios) logarithms.push_back(std::log(ratio));
  standing.p = wilcoxon_signed_rank(logarithms);
}

const std::vector<double>& costs_of(const BenchmarkSet& benchmark_set, const std::string& method) {
  const auto found = std::find(benchmark_set.methods.begin(), benchmark_set.methods.end(), method);
  return benchmark_set.cost[static_cast<std::size_t>(found - benchmark_set.methods.begin())];
}

/// The standings from the performance profiles, best first.
std::vector<MethodStanding> profiles_in_order(const BenchmarkSet& benchmark_set) {
  const std::vector<std::vector<double>> ratios = performance_ratios(benchmark_set);
  std::vector<MethodStanding> all;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    MethodStanding& standing = all.emplace_back();
    standing.method = benchmark_set.methods[i];
    standing.instances = static_cast<long>(ratios[i].size());
    const std::vector<EcdfStep> profile = ecdf(ratios[i]);
    standing.share_best = share_reached(profile, 1);
    standing.share_double = share_reached(profile, 2);
    standing.solved = std::count_if(ratios[i].begin(), ratios[i].end(),
                                    [](double ratio) { return std::isfinite(ratio); });
    standing.cost = median(benchmark_set.cost[i]);
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::tuple(-a.share_double, -a.share_best, a.cost) <
           std::tuple(-b.share_double, -b.share_best, b.cost);
  });
  return all;
}

}  // namespace

std::vector<std::vector<double>> performance_ratios(const BenchmarkSet& benchmark_set) {
  std::vector<std::vector<double>> ratios = benchmark_set.cost;
  for (const auto& costs : benchmark_set.cost) assert(costs.size() == benchmark_set.instances());
  for (std::size_t j = 0; j < benchmark_set.instances(); ++j) {
    double least = kInfinity;
    for (const auto& costs : benchmark_set.cost) least = std::min(least, costs[j]);
    for (auto& line : ratios) line[j] = std::isfinite(line[j]) ? line[j] / least : kInfinity;
  }
  return ratios;
}

std::vector<MethodStanding> stand(const BenchmarkSet& benchmark_set) {
  std::vector<MethodStanding> all = profiles_in_order(benchmark_set);
  if (all.empty()) return all;
  const bool has_reference = std::find(benchmark_set.methods.begin(), benchmark_set.methods.end(),
                                       benchmark_set.reference) != benchmark_set.methods.end();
  const std::string reference = has_reference ? benchmark_set.reference : all.front().method;
  std::vector<double> p;
  for (MethodStanding& standing : all) {
    standing.reference = reference;
    if (standing.method == reference) {
      standing.times = standing.times_low = standing.times_high = standing.p = NAN;
      continue;
    }
    set_beside(
        paired_ratios(costs_of(benchmark_set, standing.method), costs_of(benchmark_set, reference)),
        standing);
    p.push_back(standing.p);
  }
  p = holm(p);
  auto next = p.begin();
  for (MethodStanding& standing : all) {
    if (standing.method != reference) standing.p = *next++;
  }
  return all;
}

}  // namespace maxwrench
