#include "solvers/wrench/efforts.h"

namespace maxwrench {
namespace {

/// How far w may move, relative to 1 + |w|.
constexpr double kReach = 1e-8;

/// The wrench program with each w_j within `reach` of the capability's.
bool solve_near(const WrenchProgram& program, double reach, LpSolver& solver,
                Capability& capability) {
  WrenchProgram near = program;
  const Eigen::VectorXd step =
      Eigen::VectorXd::Constant(program.columns(), reach * (1 + capability.w.norm()));
  near.w_min = (capability.w - step).cwiseMax(program.w_min);
  near.w_max = (capability.w + step).cwiseMin(program.w_max);
  LpSolution solution;
  solver.solve(assemble(near), solution);
  if (solution.status != Status::kOptimal) return false;
  capability.u = solution.x.head(program.actuation->actuators());
  if (reach == 0) return true;
  capability.w = solution.x.tail(program.columns());
  capability.beta = program.c_w.dot(capability.w);
  return true;
}

}  // namespace

void fill_efforts(const WrenchProgram& program, LpSolver& solver, Capability& capability) {
  for (const double reach : {0.0, kReach}) {
    if (solve_near(program, reach, solver, capability)) return;
  }
  capability.status = Status::kNumericalError;
  capability.reason = "no efforts found for the optimal wrench";
}

}  // namespace maxwrench
