#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lib/robot/chain.h"
#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "solvers/explain/parts.h"
#include "solvers/solve/active_limits.h"
#include "solvers/solve/format.h"
#include "tests/support/changed_limits.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

class InstantsOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tasks, InstantsOf,
                         testing::Values("uvms/valve_trajectory", "planar/trajectory",
                                         "uvms/valve_impulse"));

/// A limit counts at all instants, so the sum of its rates is the derivative of the value.
TEST_P(InstantsOf, RatesAddUpToTheDerivativeOfTheValue) {
  const Problem task = load_problem(GetParam());
  const auto answer_of = [&](const Problem& changed) {
    return evaluate(changed, constant_knots(task, task.theta_r_default));
  };
  const Answer answer = answer_of(task);
  ASSERT_TRUE(answer.has_value()) << answer.reason.c_str();
  const Explanation explanation = explain(answer);
  EXPECT_EQ(explanation.missing, "");
  ASSERT_FALSE(explanation.instants.empty());
  EXPECT_TRUE(explanation.limits.empty());
  EXPECT_EQ(explanation.efforts.missing, "the task is in time");
  std::map<std::pair<std::string, LimitSide>, std::pair<double, double>> sums;  // limit, rate
  for (const InstantLimits& instant : explanation.instants) {
    ASSERT_FALSE(instant.limits.empty());
    for (const LimitRate& limit : instant.limits) {
      sums[{limit.name, limit.side}].first = limit.limit;
      sums[{limit.name, limit.side}].second += limit.rate;
    }
  }
  for (const auto& [which, sum] : sums) {
    const auto& [limit, rate] = sum;
    const Eigen::Index i = actuator_named(task.robot, which.first);
    if (i < 0) continue;  // a rate of an effort
    const double step = 1e-5 * std::abs(limit);
    const double up = answer_of(with_limit(task, i, which.second, limit + step)).beta();
    const double down = answer_of(with_limit(task, i, which.second, limit - step)).beta();
    const double least = std::min(up - answer.beta(), answer.beta() - down) / step;
    const double most = std::max(up - answer.beta(), answer.beta() - down) / step;
    EXPECT_GE(rate, least - 1e-4 * (1 + std::abs(least))) << which.first;
    EXPECT_LE(rate, most + 1e-4 * (1 + std::abs(most))) << which.first;
  }
}

/// The limits of commands count like others, also if no effort has a price.
TEST(InstantsOfALag, MultipliersOfCommandsCount) {
  const Problem task = load_problem("planar/trajectory");
  Answer answer = evaluate(task, constant_knots(task, task.theta_r_default));
  ASSERT_TRUE(answer.has_value()) << answer.reason.c_str();
  TrajectorySolution& solution = answer.trajectory.solution;
  solution.lambda.setZero();
  solution.mu.setZero();
  solution.kappa.setZero(task.robot.actuators(), solution.lambda.cols() - 1);
  solution.kappa(0, 0) = 1e-9;  // rounding
  solution.kappa(1, 0) = 1;
  const std::string name = actuator_name(task.robot, 1);
  EXPECT_EQ(dearest_efforts(answer), name);
  Explanation explanation;
  explain_instants(answer, explanation);
  ASSERT_EQ(explanation.instants.size(), 1U);
  ASSERT_EQ(explanation.instants[0].limits.size(), 1U);
  EXPECT_EQ(explanation.instants[0].limits[0].name, "command of " + name);
}

}  // namespace
}  // namespace maxwrench
