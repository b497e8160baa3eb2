#include "solvers/solve/scenario_values.h"

#include <limits>
#include <stdexcept>

#include "maxwrench/strategies.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The optimum of one program. A wrench that is held, and the start of an impulse, have none: it is
/// infinite if efforts balance them.
double value_of(const WrenchProgram& program, WrenchSolver& solver, Capability& result) {
  solver.solve(program, false, result);
  if (result.status == Status::kUnbounded) return kInfinity;
  if (result.status != Status::kOptimal) return kNone;
  const bool fixed = (program.w_min.array() == program.w_max.array()).all();
  return fixed || program.c_w.isZero(0) ? kInfinity : result.beta;
}

}  // namespace

Eigen::MatrixXd scenario_values(const Answer& answer) {
  if (!answer.task || !answer.task->motion || answer.task->scenarios.empty() ||
      answer.program.size() == 0) {
    throw std::invalid_argument(
        "scenarios: got no trajectory of a task with a list, expected one that was evaluated");
  }
  const TrajectoryProgram& program = answer.program;
  Eigen::MatrixXd values(program.scenarios, program.length());
  const auto solver = find_wrench_solver("condensed").make();
  Capability result;
  for (int i = 0; i < program.size(); ++i) {
    values(i / program.length(), i % program.length()) =
        value_of(program.instants[static_cast<std::size_t>(i)], *solver, result);
  }
  return values;
}

}  // namespace maxwrench
