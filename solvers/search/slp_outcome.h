#pragma once

#include "solvers/search/probe.h"

namespace maxwrench {

class SlpRun;

/// How far a trajectory that is worth nothing keeps away from one that is worth something.
inline constexpr double kRetreats[] = {0.97, 0.9, 0.75, 0.5};
/// Evaluations of one judgement, at most.
extern const long kJudged;

/// What `slp` has found by its objective, and the trajectory from which it goes on.
struct SlpOutcome {
  Part found;
  Candidate trajectory;       ///< with its value at the instants
  double worth = -kInfinity;  ///< what the objective makes of it, see `SlpRun::worth`

  /// Whether a trajectory is better, by more than `margin` relative to 1 + |what counts|; of two
  /// that are worth nothing the one of higher value.
  bool improves(double its_worth, double its_value, double margin) const;
};

/// Makes the best trajectory of a climber the outcome's if it is worth more. One that is worth
/// nothing goes back some of the way from the outcome's. Takes at most `kJudged` evaluations, which
/// stand in what the climber has found.
void judge(SlpRun& slp_run, SearchRun& run, SlpOutcome& outcome);

}  // namespace maxwrench
