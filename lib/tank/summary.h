#pragma once

#include "maxwrench/tank.h"

namespace maxwrench {

/// How well `run` held its wrench (see TankSummary and `run_tank`). `lost`: whether the posture was
/// lost.
TankSummary summarise(const Problem& problem, const TargetWrench& target,
                      const TankOptions& options, const TankRun& run, bool lost);
/// The same for an experiment in time, which counts as the hold as a whole.
TankSummary summarise(const TankScript& script, const TankOptions& options, const TankRun& run,
                      bool lost);

}  // namespace maxwrench
