#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/race/comparison.h"

// Searches side by side over one problem and over several, by the expected time to a thousandth
// below the best known value.

namespace maxwrench {

/// The contenders of one problem, best first: by that time, then by how far the median of their
/// values stays below. Those without attempts are left out.
std::vector<const Contender*> ranking(const Comparison& comparison);

/// What a search had spent on one problem when it came to a share below the best, for each seed;
/// `kNever` for each where it does not serve.
std::vector<Spent> hits_of(const Comparison& comparison, const std::string& search, double share);

/// Whether a search is plain: one method of postures that knows no more than values and gradients.
bool is_plain(const std::string& search);

/// One search on all problems.
struct Standing {
  std::string search;
  bool is_default = false;  ///< on one of the problems
  int served = 0;           ///< problems
  /// Expected seconds to a thousandth on each problem [problems], infinity where the search does
  /// not serve or none of its attempts got there.
  std::vector<double> seconds;
  /// The median and the largest over all problems of how many times the best search's `seconds`
  /// that is.
  double typical = kInfinity, worst = kInfinity;
  /// Of all problems and seeds, the share that came to each of `kTargetShares`; what is not served
  /// is not reached.
  std::array<double, kTargetShares.size()> reached = {};
};

/// Best first: by `typical`, then by the share that came to a thousandth.
std::vector<Standing> standings(std::span<const Comparison> comparisons);

/// The names of the first ones, at most `count`, and in any case of the defaults.
std::vector<std::string> leaders(const std::vector<Standing>& standings, std::size_t count);

/// The distribution over (problem, seed, target of `kTargetShares`) of what a search had spent when
/// it got there. Problems that it does not serve count as not reached.
std::vector<EcdfStep> target_ecdf(std::span<const Comparison> comparisons,
                                  const std::string& search, Cost cost);

}  // namespace maxwrench
