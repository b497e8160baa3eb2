#pragma once

#include <array>
#include <span>
#include <vector>

#include "maxwrench/types.h"

// What runs of searches that stop at a target, or do not, are worth: pure functions of what each
// run had spent by when its best value rose.

namespace maxwrench {

/// What a run has spent. A member of it is a cost: &Spent::evaluations or &Spent::seconds.
struct Spent {
  double evaluations = 0;
  double seconds = 0;  ///< of the processor
};
using Cost = double Spent::*;
inline constexpr Spent kNever = {kInfinity, kInfinity};

/// The best value rose to `value` when this was spent.
struct Rise {
  Spent at;
  double value = -kInfinity;
};

/// One search with one seed on one problem.
struct RaceRun {
  std::vector<Rise> rises;   ///< both costs and the values ascend
  Spent spent;               ///< in the whole run
  bool interrupted = false;  ///< counts as a failure, whatever it had found
};

/// How far below the best known value the targets are, as shares of it.
inline constexpr std::array<double, 4> kTargetShares = {1e-1, 1e-2, 1e-3, 1e-4};

/// The value that lies a share of |best_known| below `best_known`; infinity, which nothing reaches,
/// if that is -infinity: none.
double target_below(double best_known, double share);

/// What the run had spent when its best value first reached `target`, `kNever` if it failed to.
Spent first_hit(const RaceRun& run, double target);
/// The best value when so much was spent, -infinity before the first.
double value_after(const RaceRun& run, Cost cost, double spent);

/// The runs that reached the target.
int reached(std::span<const RaceRun> runs, double target);

/// The expected running time (Hansen, Auger, Ros, Mersmann, Tusar, Brockhoff: COCO, 2021):
///
///     ERT = (sum over all runs of what was spent until the target or the end) / (number of runs
///     that reached the target),
///
/// what a search costs that is started again with another seed until it gets there. Infinity if no
/// run does.
double expected_running_time(std::span<const RaceRun> runs, double target, Cost cost);

/// From `spent` on, `share` of all have reached their targets.
struct EcdfStep {
  double spent = 0;
  double share = 0;
};

/// The empirical distribution of first hits: one step at each of their values, ascending; those
/// that are infinite count as never reached. No steps if none is finite.
std::vector<EcdfStep> ecdf(std::vector<double> hits);
/// The share that was reached by `spent`.
double share_reached(std::span<const EcdfStep> steps, double spent);

/// The middle and the quarters of values of which some may be infinite. Between two values at
/// distance 1/(n - 1) it is linear, so that the median of an even number is the mean of the two
/// middle ones; infinite if one of the two is.
struct Quartiles {
  double low = kInfinity, median = kInfinity, high = kInfinity;
};
/// Of no values: all infinite.
Quartiles quartiles(std::vector<double> values);
double median(std::vector<double> values);

}  // namespace maxwrench
