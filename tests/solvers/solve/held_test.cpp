#include "maxwrench/held.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory_proof.h"
#include "solvers/solve/tank.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Options few_evaluations() {
  Options options;
  options.budget = kSanitized ? 100 : 400;
  options.threads = 1;
  return options;
}

/// The reading is that of an experiment of its own with the same knots and the same planned wrench.
TEST(SolveHeld, SLOW_WhatIsReportedIsHeldAgain) {
  const Problem task = load_problem("planar/trajectory");
  HeldOptions how;
  how.simulations = 6;
  const HeldTrajectory held = solve_held(task, few_evaluations(), how);
  ASSERT_EQ(held.status, Status::kBestFound) << held.reason.c_str();
  EXPECT_LE(held.simulations, how.simulations);
  EXPECT_GE(held.reading, held.first);
  EXPECT_TRUE(held.run.summary.held);
  EXPECT_EQ(held.answer.task->motion->thruster_lag, how.tank.thruster_lag);

  const Problem& planned = *held.answer.task;
  TrajectoryEvaluator evaluator(planned, Wrench::kPure, trajectory_solvers().front().make);
  evaluator.evaluate(held.answer.trajectory.knots);
  evaluator.evaluate_between_knots();
  ScriptOptions script;
  script.planned = held.share * evaluator.trajectory().value_between_knots;
  const TankRun again = simulate_trajectory(planned, evaluator.trajectory(), Wrench::kPure,
                                            trajectory_solvers().front(), script, "cvode", {})
                            .run;
  EXPECT_TRUE(again.summary.held);
  EXPECT_DOUBLE_EQ(again.summary.low, held.reading);
  EXPECT_THAT(summary(held), HasSubstr("best_found"));
  const auto object = nlohmann::json::parse(to_json(held));
  EXPECT_EQ(object["status"], "best_found");
  EXPECT_DOUBLE_EQ(object["tank"]["reading"].get<double>(), held.reading);
}

TEST(SolveHeld, AnInterruptionEndsItEarly) {
  const Problem task = load_problem("planar/trajectory");
  Options options = few_evaluations();
  options.interrupted = [] { return true; };
  const HeldTrajectory held = solve_held(task, options, {});
  EXPECT_EQ(held.status, Status::kBudgetExhausted);
  EXPECT_LE(held.simulations, 1);
}

/// An interruption after the first experiments keeps the best of them.
TEST(SolveHeld, SLOW_AnInterruptionKeepsWhatIsHeld) {
  const Problem task = load_problem("planar/trajectory");
  Options options = few_evaluations();
  long done = 0;
  options.progress = [&](long simulations) { done = simulations; };
  options.interrupted = [&] { return done >= 3; };
  const HeldTrajectory held = solve_held(task, options, {});
  EXPECT_EQ(held.status, Status::kBudgetExhausted);
  EXPECT_EQ(held.stopped, "interrupted");
  EXPECT_EQ(held.simulations, 3);
  EXPECT_TRUE(held.run.summary.held);
  EXPECT_GE(held.reading, held.first);
  EXPECT_TRUE(held.answer.has_posture());
}

/// What `solve` finds moves a joint too fast between its instants, so no share of its wrench is
/// held. What is proven with the lag is held; the tank asks for 0.5 % less of it.
TEST(SolveHeld, SLOW_StartsAtATrajectoryThatHoldsBetweenItsInstants) {
  Problem task = load_problem("uvms/valve_impulse");
  HeldOptions how;
  how.simulations = 8;
  const HeldTrajectory held = solve_held(task, {}, how);
  ASSERT_EQ(held.status, Status::kBestFound) << held.reason.c_str();
  task.motion->thruster_lag = how.tank.thruster_lag;
  const TrajectoryProof proof = solve_proven(task);
  ASSERT_EQ(proof.status, Status::kProven) << proof.reason.c_str();
  EXPECT_NEAR(held.first, 0.995 * proof.answer.trajectory.value_between_knots, 0.05);
  EXPECT_GE(held.reading, held.first);
}

TEST(SolveHeld, RejectsWhatTheTankDoesNotSupport) {
  const auto rejects = [](const char* name, const HeldOptions& how, const char* words,
                          Options options = few_evaluations()) {
    EXPECT_THAT([&] { solve_held(load_problem(name), options, how); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(words)))
        << name;
  };
  rejects("planar/force", {}, "a static task");
  HeldOptions none;
  none.simulations = 0;
  rejects("planar/trajectory", none, "simulations: got 0");
  HeldOptions soft;
  soft.integrator = "rk4";
  rejects("planar/trajectory", soft, "integrator: got rk4");
  HeldOptions wrong;
  wrong.tank.thruster_lag = std::nan("");
  rejects("planar/trajectory", wrong, "thruster_lag");
  Options other = few_evaluations();
  other.measure = "l2_polytope";
  rejects("planar/trajectory", {}, "measure: got l2_polytope", other);
}

}  // namespace
}  // namespace maxwrench
