#pragma once

#include "lib/posture.h"
#include "lib/wrench_program.h"

namespace maxwrench {

/// The capability at theta_r: of the valid branches of the second arm the one with the best value,
/// the first of equal ones; without a second contact there is one posture. `model` and the posture
/// stay on that branch, so its gradient is that of the branch: where the best branch changes, beta
/// has a kink, and where a branch ends (at a limit, a singularity or a collision) it may jump. The
/// capability is left alone if no posture is valid.
const Posture& evaluate_best(PostureModel& model, const Eigen::VectorXd& theta_r, Measure& measure,
                             bool efforts, WrenchProgram& program, Capability& capability);

}  // namespace maxwrench
