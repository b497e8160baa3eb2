#pragma once

#include "maxwrench/tank.h"

namespace maxwrench {

/// How well the hold of `run` went (see TankSummary and `run_tank`). `lost`: the posture was.
TankSummary summarise(const Problem& problem, const TargetWrench& target,
                      const TankOptions& options, const TankRun& run, bool lost);
/// The same of an experiment in time, all of which is the hold.
TankSummary summarise(const TankScript& script, const TankRun& run, bool lost);

}  // namespace maxwrench
