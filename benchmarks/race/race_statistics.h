#pragma once

#include <array>
#include <span>
#include <vector>

#include "maxwrench/types.h"

// Statistics of runs of searches, with or without a target: pure functions of the cost at which
// each run's best value rose.

namespace maxwrench {

/// The cost of a run. A pointer to a member selects a cost: &Spent::evaluations or &Spent::seconds.
struct Spent {
  double evaluations = 0;
  double seconds = 0;  ///< processor time
};
using Cost = double Spent::*;
inline constexpr Spent kNever = {kInfinity, kInfinity};

/// A rise of the best value to `value`, at the cost `spent`.
struct Rise {
  Spent at;
  double value = -kInfinity;
};

/// One search with one seed on one problem.
struct RaceRun {
  std::vector<Rise> rises;   ///< costs and values ascend
  Spent spent;               ///< cost of the whole run
  bool interrupted = false;  ///< counts as a failure, whatever it found
};

/// The distances of the targets from the best known value, as shares of it.
inline constexpr std::array<double, 4> kTargetShares = {1e-1, 1e-2, 1e-3, 1e-4};

/// The value that is a share of |best_known| below `best_known`. Infinity, which nothing reaches,
/// if `best_known` is -infinity: there is none.
double target_below(double best_known, double share);

/// The cost of a run when its best value first reached `target`, `kNever` if it did not.
Spent first_hit(const RaceRun& run, double target);
/// The best value at a cost, -infinity before the first value.
double value_after(const RaceRun& run, Cost cost, double spent);

/// The number of runs that reached the target.
int reached(std::span<const RaceRun> runs, double target);

/// The expected running time (Hansen, Auger, Ros, Mersmann, Tusar, Brockhoff: COCO, 2021):
///
///     ERT = (sum over all runs of the cost until the target or the end) / (number of runs
///     that reached the target),
///
/// the expected cost of a search that is restarted with other seeds until it reaches the target.
/// Infinity if no run reaches it.
double expected_running_time(std::span<const RaceRun> runs, double target, Cost cost);

/// From the cost `spent` on, a share `share` of all has reached its targets.
struct EcdfStep {
  double spent = 0;
  double share = 0;
};

/// The empirical distribution of first hits: one step at each value, ascending. Infinite values
/// count as never reached. No steps if no value is finite.
std::vector<EcdfStep> ecdf(std::vector<double> hits);
/// The share reached at the cost `spent`.
double share_reached(std::span<const EcdfStep> steps, double spent);

/// The median and the quartiles of values, some of which may be infinite. They are linear between
/// two values at distance 1/(n - 1), so the median of an even number is the mean of the two middle
/// ones; infinite if one of the two is.
struct Quartiles {
  double low = kInfinity, median = kInfinity, high = kInfinity;
};
/// All infinite if there are no values.
Quartiles quartiles(std::vector<double> values);
double median(std::vector<double> values);

}  // namespace maxwrench
