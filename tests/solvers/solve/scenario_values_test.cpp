#include "solvers/solve/scenario_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "maxwrench/load.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"

// What each scenario of a task in time allows at each instant.

namespace maxwrench {
namespace {

constexpr const char* kDeadThruster =
    MAXWRENCH_SOURCE_DIR "/examples/tasks/turn_along_with_a_dead_thruster.toml";

Answer at_default(const Problem& task) { return evaluate(task, task.theta_r_default); }

/// Without limits of effort rates the instants are independent: the value of a scenario alone is
/// the least of its numbers, and that of the list the least of all.
TEST(ScenarioValues, WithoutRatesTheLeastIsTheValue) {
  Problem task = load_problem(kDeadThruster);
  task.motion->rates = false;
  const Answer answer = at_default(task);
  ASSERT_TRUE(answer.has_value());
  const Eigen::MatrixXd values = scenario_values(answer);
  const std::vector<ScenarioEnds> ends = scenario_ends(answer);
  ASSERT_EQ(values.rows(), 3);
  ASSERT_EQ(static_cast<std::size_t>(values.rows()), ends.size());
  ASSERT_EQ(static_cast<std::size_t>(values.cols()), answer.trajectory.instants.size());
  for (Eigen::Index s = 0; s < values.rows(); ++s) {
    const double high = ends[static_cast<std::size_t>(s)].high;
    EXPECT_NEAR(values.row(s).minCoeff(), high, 1e-9 * (1 + high)) << s;
  }
  EXPECT_NEAR(values.minCoeff(), answer.beta(), 1e-9 * (1 + answer.beta()));
  // The instant that decides is where the least is.
  Eigen::Index worst = 0, at = 0;
  values.minCoeff(&worst, &at);
  EXPECT_NEAR(values(worst, answer.trajectory.decides_at), values(worst, at), 1e-9);
}

/// Rates only take away, and a general solver of linear programs finds the same.
TEST(ScenarioValues, AreOptimaOfTheInstantsAlone) {
  const Answer answer = at_default(load_problem(kDeadThruster));
  const Eigen::MatrixXd values = scenario_values(answer);
  EXPECT_GE(values.minCoeff(), answer.beta() - 1e-9);
  const auto simplex = find_lp_solver("simplex").make();
  for (const int i : {0, 17, answer.program.size() - 1}) {
    LpSolution solution;
    simplex->solve(assemble(answer.program.instants[static_cast<std::size_t>(i)]), solution);
    ASSERT_EQ(solution.status, Status::kOptimal);
    const int length = answer.program.length();
    EXPECT_NEAR(values(i / length, i % length), solution.objective, 1e-8);
  }
}

TEST(ScenarioValues, OtherTasksAreRejected) {
  EXPECT_THROW(scenario_values(at_default(load_problem("planar/force"))), std::invalid_argument);
  EXPECT_THROW(scenario_values(at_default(load_problem("planar/trajectory"))),
               std::invalid_argument);
  EXPECT_THROW(scenario_values(Answer{}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
