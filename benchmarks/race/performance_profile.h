#pragma once

#include <string>
#include <vector>

#include "benchmarks/race/race_statistics.h"

namespace maxwrench {

/// Several methods on the same instances. `cost[i][j]` is the cost of method i on instance j,
/// infinity if it failed or does not support the instance.
struct BenchmarkSet {
  std::string title;
  std::string unit;  ///< of the costs
  std::vector<std::string> methods;
  std::vector<std::vector<double>> cost;
  std::string reference =
      "";  ///< the method that `stand` compares with; if empty or unknown, the first in its order

  std::size_t instances() const { return cost.empty() ? 0 : cost.front().size(); }
};

/// The cost of each method as a multiple of that of the cheapest method on the same instance,
///
///     r_ij = cost_ij / min_i' cost_i'j,
///
/// infinity where it failed: methods×instances. The distribution of a method's ratios is its
/// performance profile, rho_i(tau) = |{j : r_ij <= tau}| / instances (Dolan, More: Benchmarking
/// optimization software with performance profiles, 2002): `ecdf` of one line. An instance that no
/// method solves counts in the denominator.
std::vector<std::vector<double>> performance_ratios(const BenchmarkSet& benchmark_set);

/// One method of a benchmark set, compared with the reference.
struct MethodStanding {
  std::string method, reference;
  long solved = 0, instances = 0;
  double share_best = 0;    ///< rho(1)
  double share_double = 0;  ///< rho(2)
  double cost = kInfinity;  ///< the median over all instances
  /// The median ratio of its cost to that of the reference, over the instances that at least one of
  /// them solved, and its 95 % bootstrap interval; NaN for the reference.
  double times = kInfinity, times_low = kInfinity, times_high = kInfinity;
  /// Wilcoxon's signed rank test of the logarithms of these ratios, corrected by Holm for all
  /// methods of the benchmark set; NaN for the reference.
  double p = 1;
};

/// Best first: by rho(2), then by rho(1), then by the median of the costs.
std::vector<MethodStanding> stand(const BenchmarkSet& benchmark_set);

}  // namespace maxwrench
