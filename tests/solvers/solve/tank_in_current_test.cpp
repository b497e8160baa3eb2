#include <gtest/gtest.h>

#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/tank.h"
#include "tests/support/task_in_time.h"

namespace maxwrench {
namespace {

TrajectoryExperiment carried_out(const Problem& planned_for, const Problem& robot) {
  const TrajectorySolverEntry& lp = trajectory_solvers().front();
  TrajectoryEvaluator evaluator(planned_for, Wrench::kPure, lp.make);
  evaluator.evaluate(default_knots(planned_for));
  evaluator.evaluate_between_knots();
  return simulate_trajectory(robot, evaluator.trajectory(), Wrench::kPure, lp, {}, "cvode",
                             TankOptions());
}

/// The controller knows the current, as it knows the rest of the model.
TEST(TankInCurrent, SLOW_HoldsWhatWasPlannedForTheCurrent) {
  const Problem flowing =
      task_in_time("valve_trajectory", "", "[environment]\ncurrent = [0.2, 0.1, 0]\n");
  const TrajectoryExperiment held = carried_out(flowing, flowing);
  EXPECT_TRUE(held.run.summary.held) << held.run.summary.missed;
  const Problem still = load_problem("uvms/valve_trajectory");
  EXPECT_NE(held.run.summary.held_wrench,
            carried_out(still, still).run.summary.held_wrench);
}

}  // namespace
}  // namespace maxwrench
