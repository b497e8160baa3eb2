#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "maxwrench/evaluations.h"
#include "maxwrench/load.h"
#include "maxwrench/pareto.h"
#include "solvers/pareto/weighted.h"
#include "solvers/solve/method.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

/// planar/force with another direction in the plane.
Goal planar_goal(double azimuth) {
  Goal goal{load_problem("planar/force")};
  goal.task.c << std::cos(azimuth), std::sin(azimuth), 0, 0, 0, 0;
  return goal;
}

Options small_budget() {
  Options options;
  options.budget = 2000;
  options.threads = 2;
  return options;
}

/// The weighted value at the posture of a grid over theta_r where it is largest.
double grid_value(const std::vector<Goal>& goals, const Eigen::VectorXd& weights) {
  constexpr int kSide = 61;
  const Problem& task = goals.front().task;
  Evaluations::Rows grid(kSide * kSide, 2);
  for (int i = 0; i < kSide * kSide; ++i) {
    const double shares[2] = {double(i / kSide) / (kSide - 1), double(i % kSide) / (kSide - 1)};
    for (int k = 0; k < 2; ++k) {
      grid(i, k) = task.theta_r_min[k] + shares[k] * (task.theta_r_max[k] - task.theta_r_min[k]);
    }
  }
  Eigen::VectorXd least = Eigen::VectorXd::Constant(kSide * kSide, kInfinity);
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const double weight = weights[static_cast<Eigen::Index>(k)];
    if (weight == 0) continue;
    const Eigen::VectorXd beta = evaluate_each(goals[k].task, grid).beta;
    for (Eigen::Index i = 0; i < beta.size(); ++i) {
      least[i] = std::isnan(beta[i]) ? -kInfinity : std::min(least[i], beta[i] / weight);
    }
  }
  return least.maxCoeff();
}

TEST(Front, OfTwoDirectionsIsNotBelowAGrid) {
  const std::vector<Goal> goals = {planar_goal(0), planar_goal(std::numbers::pi / 2)};
  FrontPlan plan;
  plan.points = 5;
  plan.bound = true;
  const Front front = pareto(goals, plan, small_budget());
  EXPECT_EQ(front.status, Status::kBestFound);
  ASSERT_FALSE(front.points.empty());
  EXPECT_EQ(front.points.size() + static_cast<std::size_t>(front.dominated), 5u);
  for (const FrontPoint& point : front.points) {
    const double grid = grid_value(goals, point.weights);
    EXPECT_GE(point.t, grid - 1e-9);
    EXPECT_GE(point.bound, point.t * (1 - 1e-12));  // proven: 0.1 %
    EXPECT_LE(point.bound, point.t * 1.0011);
    EXPECT_LE(grid, point.bound);
    for (Eigen::Index k = 0; k < 2; ++k) {
      EXPECT_EQ(point.beta[k],
                evaluate(goals[static_cast<std::size_t>(k)].task, point.theta_r).beta());
      EXPECT_GE(point.beta[k], point.t * point.weights[k] * (1 - 1e-12));
    }
    for (const FrontPoint& other : front.points) {  // none dominates another
      EXPECT_FALSE((other.beta.array() > point.beta.array()).all());
    }
  }
  EXPECT_GE(front.compromise.t, grid_value(goals, front.compromise.weights) - 1e-9);
  const auto json = nlohmann::json::parse(to_json(front));
  EXPECT_EQ(json["points"].size(), front.points.size());
  const std::string csv = front_csv(front);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            front.points.size() + 2);
}

/// A task against itself has no trade-off: one posture has all of both.
TEST(Front, OfATaskAgainstItselfIsItsBest) {
  FrontPlan plan;
  plan.points = 3;
  const Front front = pareto({planar_goal(0.4), planar_goal(0.4)}, plan, small_budget());
  const double best = front.own[0].beta();
  for (const FrontPoint& point : front.points) EXPECT_NEAR(point.beta[0], best, 2e-3 * best);
  EXPECT_NEAR(front.compromise.t, 1, 2e-3);
}

/// Three tasks have one posture; its worst share is at least that of any grid posture.
TEST(Front, OfThreeTasksIsOnePosture) {
  const std::vector<Goal> goals = {planar_goal(0), planar_goal(1.5), planar_goal(3)};
  FrontPlan plan;
  plan.points = 0;
  const Front front = pareto(goals, plan, small_budget());
  EXPECT_TRUE(front.points.empty());
  EXPECT_GE(front.compromise.t, grid_value(goals, front.compromise.weights) - 1e-9);
  EXPECT_LE(front.compromise.t, 1 + 1e-3);
  EXPECT_THAT(summary(front), HasSubstr("one posture for all tasks"));
}

/// With few evaluations the search for a weight finds more for one task than the search for it
/// alone. This is then the task's best, in which all weights are measured.
TEST(Front, OwnValuesAreTheLargestOfAll) {
  const std::vector<Goal> goals = {{load_problem("uvms/valve"), "linf_polytope", Wrench::kPure},
                                   {load_problem("uvms/lift"), "ellipsoid", Wrench::kPure}};
  FrontPlan plan;
  plan.points = 3;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Options options;
    options.budget = 300;
    options.seed = seed;
    const Front front = pareto(goals, plan, options);
    ASSERT_GT(front.compromise.theta_r.size(), 0);
    for (const FrontPoint& point : front.points) {
      EXPECT_LE(point.t, (1 + 1e-5) * std::sqrt(2)) << seed;
      for (Eigen::Index k = 0; k < 2; ++k) {
        EXPECT_LE(point.beta[k], front.own[static_cast<std::size_t>(k)].beta() * (1 + 1e-5))
            << seed;
      }
    }
    EXPECT_LE(front.compromise.t, 1 + 1e-5) << seed;
  }
}

/// Free components only add wrenches: pure against any, any is at least pure at each posture.
TEST(Front, OfPureAgainstAny) {
  Goal any = planar_goal(0);
  any.wrench = Wrench::kAny;
  FrontPlan plan;
  plan.points = 3;
  const Front front = pareto({planar_goal(0), any}, plan, small_budget());
  EXPECT_EQ(front.status, Status::kBestFound);
  for (const FrontPoint& point : front.points) EXPECT_GE(point.beta[1], point.beta[0] - 1e-6);
}

/// Of an independent model, front valve and lift: at 50 degrees t = 0.71311 with (16.2305,
/// 59.2217), at 30 degrees t = 0.94458.
TEST(Front, SLOW_OfValveAndLiftIsThatOfTheIndependentModel) {
  FrontPlan plan;
  plan.points = 10;
  const Front front = pareto({{load_problem("uvms/valve")}, {load_problem("uvms/lift")}}, plan);
  const auto at = [&front](double degrees) {
    for (const FrontPoint& point : front.points) {
      if (std::abs(point.phi * 180 / std::numbers::pi - degrees) < 1e-6) return point;
    }
    return FrontPoint();
  };
  EXPECT_NEAR(at(50).t, 0.71311, 0.001 * 0.71311);
  ASSERT_EQ(at(50).beta.size(), 2);
  EXPECT_NEAR(at(50).beta[0], 16.2305, 0.02);
  EXPECT_NEAR(at(50).beta[1], 59.2217, 0.06);
  EXPECT_NEAR(at(30).t, 0.94458, 0.001 * 0.94458);
  EXPECT_NEAR(front.own[0].beta(), 35.4083, 0.036);
  EXPECT_NEAR(front.own[1].beta(), 108.4095, 0.11);
}

TEST(WeightedObjective, IsTheLeastWithItsGradient) {
  const std::vector<Goal> goals = {planar_goal(0), planar_goal(1.2)};
  std::vector<Method> methods;
  std::vector<std::unique_ptr<Objective>> parts;
  methods.reserve(2);
  for (const Goal& goal : goals) {
    methods.push_back(resolve(goal.task, Case()));
    parts.push_back(make_objective(goal.task, methods.back()));
  }
  const Eigen::Vector2d weights(2, 0.5);
  const auto objective = make_weighted_objective(parts, weights);
  Random random(5);
  int compared = 0;
  for (int i = 0; i < samples(60); ++i) {
    Eigen::VectorXd theta_r = random_theta_r(goals[0].task, random), gradient(2);
    const double value = objective->evaluate(theta_r, &gradient);
    const double a = parts[0]->evaluate(theta_r) / 2, b = parts[1]->evaluate(theta_r) / 0.5;
    EXPECT_EQ(value, std::min(a, b));
    if (value == -kInfinity || std::abs(a - b) < 0.1) continue;
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 2; ++k) {
      Eigen::VectorXd low = theta_r, high = theta_r;
      low[k] -= kStep;
      high[k] += kStep;
      const double slope = (objective->evaluate(high) - objective->evaluate(low)) / (2 * kStep);
      const double one_sided = (objective->evaluate(high) - value) / kStep;
      if (std::abs(slope - one_sided) > 1e-4) continue;  // a kink
      EXPECT_NEAR(gradient[k], slope, 1e-4 * (1 + std::abs(slope)));
      ++compared;
    }
  }
  EXPECT_GT(compared, samples(60) / 4);
  // A weight of zero leaves a task out.
  const auto second = make_weighted_objective(parts, Eigen::Vector2d(0, 1));
  EXPECT_EQ(second->evaluate(goals[0].task.theta_r_default),
            parts[1]->evaluate(goals[0].task.theta_r_default));
}

TEST(Front, RejectsTasksThatDoNotSuit) {
  const auto rejected = [](const Goal& a, const Goal& b, const FrontPlan& plan = {}) {
    return rejection_of([&] { pareto({a, b}, plan); });
  };
  const Goal planar = planar_goal(0);
  EXPECT_THAT(rejected(planar, {load_problem("uvms/lift")}), HasSubstr("the same robot"));
  Goal moved = planar;
  moved.task.pose.p.x() += 1;
  EXPECT_THAT(rejected(planar, moved), HasSubstr("the same pose"));
  Goal limited = planar;
  limited.task.theta_r_max[0] -= 0.1;
  EXPECT_THAT(rejected(planar, limited), HasSubstr("the same theta_r"));
  EXPECT_THAT(rejected({load_problem("uvms/valve")}, {load_problem("uvms/valve_trajectory")}),
              HasSubstr("expected a static task"));
  FrontPlan plan;
  plan.points = 1;
  EXPECT_THAT(rejected(planar, planar, plan), HasSubstr("points: got 1"));
  plan.points = -3;
  EXPECT_THAT(rejected(planar, planar, plan), HasSubstr("points: got -3"));
  plan = {};
  plan.bound = true;
  Goal any = planar;
  any.wrench = Wrench::kAny;
  EXPECT_THAT(rejected(planar, any, plan), HasSubstr("certify: got"));
  EXPECT_THAT(rejection_of([&] { pareto({planar}); }), HasSubstr("two or more"));
  EXPECT_THAT(rejection_of([&] { pareto({planar, planar, planar}); }), HasSubstr("expected 0"));
}

}  // namespace
}  // namespace maxwrench
