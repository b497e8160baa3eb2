#pragma once

#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// The wrench program of a posture whose first columns are those of W, all free. c_w is zero. The
/// columns of a second contact follow, with their limits.
WrenchProgram program_along(const Problem& problem, const Posture& posture, const Matrix6Xd& W);

/// The same for the columns E of a wrench set, followed for Wrench::kAny by an orthonormal basis of
/// what remains of W_any orthogonal to E. Throws std::invalid_argument if E is not 1 to 3
/// independent columns of finite numbers, or the sizes of the posture are not those of the robot.
WrenchProgram wrench_set_program(const Problem& problem, const Posture& posture, const Matrix6Xd& E,
                                 Wrench wrench);

}  // namespace maxwrench
