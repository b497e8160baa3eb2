#pragma once

#include "solvers/search/probe.h"

namespace maxwrench {

class SlpRun;

/// If the objective has no value for a new trajectory, trajectories at these shares of the way to
/// it from the best one are tried.
inline constexpr double kRetreats[] = {0.97, 0.9, 0.75, 0.5};
/// The most evaluations of one `judge`.
extern const long kJudged;

/// What `slp` has found by its objective, and the trajectory from which it continues.
struct SlpOutcome {
  Part found;
  Candidate trajectory;       ///< with its value at the instants
  double worth = -kInfinity;  ///< the objective's value of it, see `SlpRun::worth`

  /// Whether a trajectory is better, by more than `margin` relative to 1 + |value|. Compares the
  /// objective's values, or the values at the instants if the objective has a value for neither.
  bool improves(double its_worth, double its_value, double margin) const;
};

/// If the objective's value of a local search's best trajectory is larger than the outcome's, makes
/// it the outcome's trajectory. If the objective has no value for it, tries trajectories between
/// the outcome's and it. Takes at most `kJudged` evaluations, which are counted in the local
/// search's `found`.
void judge(SlpRun& slp_run, SearchRun& run, SlpOutcome& outcome);

}  // namespace maxwrench
