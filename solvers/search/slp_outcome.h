#pragma once

#include "solvers/search/probe.h"

namespace maxwrench {

class KnotClimber;

/// How far a plan that is worth nothing keeps away from one that is worth something.
inline constexpr double kRetreats[] = {0.97, 0.9, 0.75, 0.5};
/// Evaluations of one judgement, at most.
extern const long kJudged;

/// What `slp` has found, and what its best plan is worth, see `KnotClimber::worth`.
struct SlpOutcome {
  Part found;
  double worth = -kInfinity;

  /// Whether a plan is better, by more than `margin` relative to 1 + |what counts|; of two that are
  /// worth nothing the one of higher value.
  bool improves(double its_worth, double its_value, double margin) const;
};

/// Makes the best plan of a climber the outcome's if it is worth more. One that is worth nothing
/// goes back some of the way from the outcome's. Takes at most `kJudged` evaluations, which stand
/// in the climber's trace.
void judge(KnotClimber& climber, EvaluationCounter& progress, SlpOutcome& outcome);

}  // namespace maxwrench
