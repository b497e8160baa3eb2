#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/explain.h"
#include "maxwrench/scenario.h"
#include "maxwrench/solve.h"
#include "tests/support/changed_limits.h"
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
    // This posture is not the best. Torques about all axes do not depend on it.
    EXPECT_EQ(e.best.missing.empty(), name == "torques") << name;
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

/// The task with another limit of an actuator, in all scenarios in which it is not lost.
Problem with_list_limit(Problem task, Eigen::Index i, LimitSide side, double limit) {
  const Zonotope all = task.scenarios.limits.front().actuation;
  for (ScenarioLimits& limits : task.scenarios.limits) {
    Eigen::VectorXd low = limits.actuation.u_min, high = limits.actuation.u_max;
    if (low[i] != all.u_min[i] || high[i] != all.u_max[i]) continue;
    (side == LimitSide::kLower ? low : high)[i] = limit;
    limits.actuation = with_limits(limits.actuation, low, high);
  }
  return task;
}

/// With the posture optimised again, the rates are differences of optima near it.
TEST(ListExplain, SLOW_BestPosturesHaveRatesOfTheWholeList) {
  struct Best {
    const char *wrench, *tables;
  };
  for (const Best& each :
       {Best{"set = [[0,0,0,0,0,1], [0,0,0,0,0,-1]]", ""},
        Best{kLift, "[loss]\ncases = [['rear_left_vertical']]\n"}, Best{kLift, kParameters}}) {
    const Problem task = scenario_task(each.wrench, each.tables);
    const Answer answer = solve(task);
    const Explanation e = explain(answer);
    ASSERT_EQ(e.best.missing, "") << each.wrench;
    EXPECT_LT(e.best.residual, 1e-6 * (1 + e.beta));
    const Eigen::VectorXd& theta_r = answer.posture.theta_r;
    const auto best = [&](const Problem& changed) {
      Problem near = changed;
      near.theta_r_min = near.theta_r_min.cwiseMax(Eigen::VectorXd(theta_r.array() - 0.02));
      near.theta_r_max = near.theta_r_max.cwiseMin(Eigen::VectorXd(theta_r.array() + 0.02));
      near.theta_r_default = theta_r.cwiseMax(near.theta_r_min).cwiseMin(near.theta_r_max);
      Options options;
      options.search = "facet_sqp";
      options.budget = 1000;
      return solve(near, options).beta();
    };
    int tried = 0;
    for (const LimitRate& limit : e.best.limits) {
      const Eigen::Index i = actuator_named(task.robot, limit.name);
      if (i < 0 || !e.best.unique) continue;
      const double step = 1e-3 * std::abs(limit.limit);
      const double rate = (best(with_list_limit(task, i, limit.side, limit.limit + step)) -
                           best(with_list_limit(task, i, limit.side, limit.limit - step))) /
                          (2 * step);
      EXPECT_NEAR(rate, limit.rate, 4e-3 * std::max(1.0, std::abs(rate)))
          << each.wrench << " " << limit.name;
      ++tried;
    }
    EXPECT_GE(tried, 2) << each.wrench;
  }
}

}  // namespace
}  // namespace maxwrench
