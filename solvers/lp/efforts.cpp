#include "solvers/lp/efforts.h"

namespace maxwrench {

void fill_efforts(const WrenchProgram& program, LpSolver& solver, Capability& capability) {
  WrenchProgram fixed = program;
  fixed.w_min = fixed.w_max = capability.w;
  LpSolution solution;
  solver.solve(assemble(fixed), solution);
  if (solution.status != Status::kOptimal) {
    capability.status = Status::kNumericalError;
    capability.reason = "no efforts found for the optimal wrench";
    return;
  }
  capability.u = solution.x.head(program.actuation->actuators());
}

}  // namespace maxwrench
