#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/changed_limits.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

double best_rate(const Explanation& explanation, const std::string& name, LimitSide side) {
  for (const LimitRate& limit : explanation.best.limits) {
    if (limit.name == name && limit.side == side) return limit.rate;
  }
  return 0;
}

/// An independent model gives these values (to the digits shown).
TEST(BestPosture, SLOW_RatesOfTheValveAreTheReferenceValues) {
  const Explanation explanation = explain(solve(load_problem("uvms/valve")));
  ASSERT_EQ(explanation.best.missing, "");
  EXPECT_LT(explanation.best.residual, 1e-6);
  EXPECT_TRUE(explanation.best.unique);
  EXPECT_NEAR(best_rate(explanation, "front_right_vertical", LimitSide::kLower), -0.4173, 5e-5);
  EXPECT_NEAR(best_rate(explanation, "rear_right_vertical", LimitSide::kLower), -0.4014, 5e-5);
  EXPECT_NEAR(best_rate(explanation, "rear_left_vertical", LimitSide::kUpper), 0.0159, 5e-5);
  EXPECT_NEAR(best_rate(explanation, "q1_shoulder_yaw", LimitSide::kLower), -0.2622, 5e-5);
}

class BestPostureOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tasks, BestPostureOf,
                         testing::Values("uvms/valve", "uvms/lift", "mobile/push"));

/// The best value near a posture, so that no other optimum of nearly the same value takes over.
double best_near(Problem task, const Eigen::VectorXd& theta_r) {
  task.theta_r_min = task.theta_r_min.cwiseMax(Eigen::VectorXd(theta_r.array() - 0.02));
  task.theta_r_max = task.theta_r_max.cwiseMin(Eigen::VectorXd(theta_r.array() + 0.02));
  task.theta_r_default =
      Eigen::VectorXd(theta_r).cwiseMax(task.theta_r_min).cwiseMin(task.theta_r_max);
  Options options;
  options.search = "facet_sqp";
  options.budget = 1000;
  return solve(task, options).beta();
}

/// Solved again with each limit in turn a little larger and smaller.
TEST_P(BestPostureOf, SLOW_RatesAreDifferencesOfOptimaThatAreSolvedAgain) {
  const Problem task = load_problem(GetParam());
  const Answer answer = solve(task);
  const Eigen::VectorXd& theta_r = answer.posture.theta_r;
  const Explanation explanation = explain(answer);
  ASSERT_EQ(explanation.best.missing, "");
  double largest = 0;
  for (const LimitRate& limit : explanation.best.limits) {
    const Eigen::Index i = actuator_named(task.robot, limit.name);
    const bool position = limit.name.starts_with("position of ");
    if (i < 0 && !position) continue;
    const double step = position ? 1e-3 : 1e-3 * std::abs(limit.limit);
    const auto best = [&](double moved) {
      if (!position) return best_near(with_limit(task, i, limit.side, moved), theta_r);
      Problem changed = task;
      for (int j = 0; j < task.redundancy(); ++j) {
        if (limit.name != "position of " + task.theta_r_name(j)) continue;
        const bool lower = limit.side == LimitSide::kLower;
        (lower ? changed.theta_r_min : changed.theta_r_max)[j] = moved;
      }
      return best_near(changed, theta_r);
    };
    const double rate = (best(limit.limit + step) - best(limit.limit - step)) / (2 * step);
    largest = std::max(largest, std::abs(rate));
    EXPECT_NEAR(rate, limit.rate, 4e-3 * std::max(largest, std::abs(rate))) << limit.name;
  }
  EXPECT_GT(largest, 0);
}

/// With any wrench and with a second contact the program has more columns.
TEST(BestPosture, RatesScaleWithTheLimitsWithoutLoad) {
  // The vehicle has no load, so beta is homogeneous of degree one in the limits: the shares of all
  // limits add up to beta, at a best posture as well (the limits of theta_r are not at work there).
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    Options options;
    options.wrench = wrench;
    const Answer answer = solve(load_problem("planar/force"), options);
    const Explanation explanation = explain(answer);
    ASSERT_EQ(explanation.best.missing, "");
    double sum = 0;
    for (const LimitRate& limit : explanation.best.limits) {
      if (!limit.name.starts_with("position") && !limit.name.starts_with("clearance")) {
        sum += limit.rate * limit.limit;
      }
    }
    EXPECT_NEAR(sum, answer.beta(), 1e-7);
  }
}

TEST(BestPosture, AwayFromAnOptimumHasNoRates) {
  const Problem task = load_problem("uvms/lift");
  const Explanation explanation = explain(evaluate(task, task.theta_r_default.transpose()));
  EXPECT_TRUE(explanation.best.limits.empty());
  EXPECT_NE(explanation.best.missing.find("no local optimum"), std::string::npos);
  EXPECT_GT(explanation.best.residual, 1e-3);
  Eigen::VectorXd near = solve(task).posture.theta_r;
  near[0] += 1e-4;
  EXPECT_TRUE(explain(evaluate(task, near.transpose())).best.limits.empty());
}

TEST(BestPosture, OfGivenJointsHasNoRates) {
  const Problem task = make_problem(cartesian_push(Vector6d::Unit(0)));
  EXPECT_EQ(explain(evaluate_posture(task, Eigen::Vector2d::Zero())).best.missing,
            "all joints are given");
}

}  // namespace
}  // namespace maxwrench
