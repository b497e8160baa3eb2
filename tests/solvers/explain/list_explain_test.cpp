#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/explain.h"
#include "maxwrench/scenario.h"
#include "maxwrench/solve.h"
#include "tests/support/list_tasks.h"

namespace maxwrench {
namespace {

/// The value with one limit of an actuator in another place, in all scenarios.
double value_with_limit(Problem task, const Eigen::VectorXd& theta_r, Eigen::Index i, bool upper,
                        double by) {
  for (ScenarioLimits& each : task.scenarios.limits) {
    Eigen::VectorXd u_min = each.actuation.u_min, u_max = each.actuation.u_max;
    (upper ? u_max : u_min)[i] += by;
    each.actuation = with_limits(each.actuation, u_min, u_max);
  }
  task.robot.actuation = task.scenarios.limits.front().actuation;
  Options options;
  options.check_collision = false;
  return evaluate(task, theta_r, options).beta();
}

/// What binds in the scenario that decides is what moves the value of the list.
TEST(ListExplain, RatesAreThoseOfTheList) {
  for (const ListForm& form : list_forms()) {
    const std::string name = form.name;
    const Problem task = scenario_task(form.wrench, form.tables);
    // A posture where nothing is symmetric.
    const Eigen::VectorXd theta_r = task.theta_r_default + Eigen::Vector4d(0.1, 0.2, -0.15, 0.3);
    Options options;
    options.check_collision = false;
    const Answer answer = evaluate(task, theta_r, options);
    ASSERT_TRUE(answer.has_value()) << name << answer.reason.str();
    const Explanation e = explain(answer);
    ASSERT_EQ(e.missing, "") << name;
    EXPECT_EQ(e.scenario, describe(task.scenarios, answer.capability.decides)) << name;
    EXPECT_EQ(e.best.missing, "the task has a list of scenarios");
    double sum = e.budget.weight + e.budget.buoyancy + e.budget.trim + e.budget.other;
    for (const BindingLimit& limit : e.limits) sum += limit.share;
    EXPECT_NEAR(sum, e.beta, 1e-8 * (1 + std::abs(e.beta))) << name;
    EXPECT_FALSE(e.limits.empty()) << name;
    const Robot& robot = task.robot;
    // Losses have limits of their own.
    if (task.scenarios.limits.size() > 1) continue;
    for (const BindingLimit& limit : e.limits) {
      Eigen::Index i = 0;
      const auto thrusters = static_cast<Eigen::Index>(robot.thrusters.size());
      const auto name_of = [&](Eigen::Index k) {
        return k < thrusters ? robot.thrusters[static_cast<std::size_t>(k)].name
                             : robot.joints[static_cast<std::size_t>(k - thrusters)].name;
      };
      while (name_of(i) != limit.name) ++i;
      const bool upper = limit.side == LimitSide::kUpper;
      constexpr double kStep = 1e-5;
      // Where scenarios meet, the rates for rising and falling limits differ.
      const double up = (value_with_limit(task, theta_r, i, upper, kStep) - answer.beta()) / kStep;
      const double down =
          (answer.beta() - value_with_limit(task, theta_r, i, upper, -kStep)) / kStep;
      EXPECT_LE(std::min(std::abs(up - limit.rate), std::abs(down - limit.rate)),
                1e-5 * (1 + std::abs(limit.rate)))
          << name << " " << limit.name << " " << up << " " << down << " " << limit.rate;
    }
  }
}

TEST(ListExplain, NamesTheScenario) {
  const Problem task = scenario_task(kLift, "[loss]\nany = 1\n");
  const Answer answer = evaluate(task, task.theta_r_default);
  const Explanation e = explain(answer);
  EXPECT_NE(e.scenario.find("dead"), std::string::npos);
  EXPECT_TRUE(summary(e).starts_with("in the scenario that decides, " + e.scenario + "\n"));
  EXPECT_NE(to_json(e).find("\"scenario\""), std::string::npos);
}

}  // namespace
}  // namespace maxwrench
