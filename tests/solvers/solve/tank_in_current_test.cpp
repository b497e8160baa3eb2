#include <gtest/gtest.h>

#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/tank.h"
#include "tests/support/task_in_time.h"

namespace maxwrench {
namespace {

TrajectoryExperiment carried_out(const Problem& problem) {
  const TrajectorySolverEntry& lp = trajectory_solvers().front();
  TrajectoryEvaluator evaluator(problem, Wrench::kPure, lp.make);
  evaluator.evaluate(default_knots(problem));
  evaluator.evaluate_between_knots();
  return simulate_trajectory(problem, evaluator.trajectory(), Wrench::kPure, lp, {}, "cvode",
                             TankOptions());
}

/// The controller knows the current, as it knows the rest of the model.
TEST(TankInCurrent, SLOW_HoldsWhatWasPlannedForTheCurrent) {
  const Problem flowing =
      task_in_time("valve_trajectory", "", "[environment]\ncurrent = [0.2, 0.1, 0]\n");
  const TrajectoryExperiment held = carried_out(flowing);
  EXPECT_TRUE(held.run.summary.held) << held.run.summary.missed;
  const TankSummary& summary = held.run.summary;
  EXPECT_LT(summary.planned,
            carried_out(load_problem("uvms/valve_trajectory")).run.summary.planned);
}

}  // namespace
}  // namespace maxwrench
