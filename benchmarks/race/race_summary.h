#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/race/comparison.h"

// Compares searches on one problem and on several, by the expected time to a thousandth below the
// best known value.

namespace maxwrench {

/// The contenders of one problem, best first: by that time, then by the shortfall of the median of
/// their values. Contenders without attempts are left out.
std::vector<const Contender*> ranking(const Comparison& comparison);

/// The cost of a search on one problem when it reached a share below the best, for each seed;
/// `kNever` for each seed if it does not support the problem.
std::vector<Spent> hits_of(const Comparison& comparison, const std::string& search, double share);

/// Whether a search is plain: a single method of postures that uses only values and gradients.
bool is_plain(const std::string& search);

/// One search on all problems.
struct Standing {
  std::string search;
  bool is_default = false;  ///< on any of the problems
  int supported = 0;        ///< number of supported problems
  /// Expected seconds to a thousandth on each problem [problems]; infinity where the search does
  /// not support the problem or none of its attempts reached it.
  std::vector<double> seconds;
  /// The median and the largest ratio, over all problems, of these seconds to the best search's.
  double typical = kInfinity, worst = kInfinity;
  /// The share of all problems and seeds that reached each of `kTargetShares`. Problems that are
  /// not supported count as not reached.
  std::array<double, kTargetShares.size()> reached = {};
};

/// Best first: by `typical`, then by the share that reached a thousandth.
std::vector<Standing> standings(std::span<const Comparison> comparisons);

/// The names of the first ones, at most `count`, and always those of the defaults.
std::vector<std::string> leaders(const std::vector<Standing>& standings, std::size_t count);

/// The distribution of the cost of a search when it reached a target, over (problem, seed, target
/// of `kTargetShares`). Problems that it does not support count as not reached.
std::vector<EcdfStep> target_ecdf(std::span<const Comparison> comparisons,
                                  const std::string& search, Cost cost);

}  // namespace maxwrench
