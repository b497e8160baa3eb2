#include "maxwrench/map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>

#include "lib/math/random.h"
#include "maxwrench/evaluations.h"
#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/task.h"
#include "tests/support/maps.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

void expect_same(const CapabilityMap& a, const CapabilityMap& b) {
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    EXPECT_EQ(a.cells[i].index, b.cells[i].index);
    EXPECT_EQ(a.cells[i].status, b.cells[i].status);
    EXPECT_EQ(a.cells[i].evaluations, b.cells[i].evaluations);
    if (a.cells[i].status != Status::kBestFound) continue;
    EXPECT_EQ(a.cells[i].beta, b.cells[i].beta);
    EXPECT_EQ(a.cells[i].theta_r, b.cells[i].theta_r);
  }
}

/// Each value is that of its posture, and no posture of a grid over theta_r is better.
TEST(Map, CellsAreBestPostures) {
  const Problem task = load_problem("planar/force");
  const MapPlan plan = plan_over({{"yaw", -0.6, 0.6, 3}, {"azimuth", 0, 1.5, 4}});
  const CapabilityMap found = map(task, plan, with_budget(1000));
  EXPECT_EQ(found.status, Status::kBestFound);
  ASSERT_EQ(found.cells.size(), 12u);
  constexpr int kSide = 41;
  Evaluations::Rows grid(kSide * kSide, 2);
  for (int i = 0; i < kSide * kSide; ++i) {
    for (int k = 0; k < 2; ++k) {
      const double share = static_cast<double>(k == 0 ? i / kSide : i % kSide) / (kSide - 1);
      grid(i, k) = task.theta_r_min[k] + share * (task.theta_r_max[k] - task.theta_r_min[k]);
    }
  }
  for (const MapCell& cell : found.cells) {
    const Problem here = posed(task, plan.over, cell.at);
    // c is (cos, sin) of the azimuth in the plane.
    EXPECT_NEAR(here.c[0], std::cos(cell.at[1]), 1e-12);
    EXPECT_NEAR(here.c[1], std::sin(cell.at[1]), 1e-12);
    EXPECT_EQ(cell.beta, evaluate(here, cell.theta_r).beta());
    const Evaluations values = evaluate_each(here, grid);
    double best = -kInfinity;
    for (const double beta : values.beta) best = std::max(best, std::isnan(beta) ? best : beta);
    EXPECT_GE(cell.beta, best - 1e-9);
    EXPECT_LE(cell.beta, 1.2 * best);  // and the grid comes near it
  }
}

/// The pose of a cell is that of a task whose pose is free, at the same offsets.
TEST(Map, OffsetsAreThoseOfFreePoses) {
  const Problem task = load_problem("uvms/lift");
  Problem free = task;
  free.free.axes = {0, 1, 2, 3, 4, 5};
  free.pose.R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  free.pose.p = {0.1, -2, 3};
  Problem fixed = free;
  fixed.free.axes.clear();
  Random random(3);
  const Eigen::VectorXd s = Eigen::VectorXd::NullaryExpr(6, [&] { return random.uniform(-1, 1); });
  std::vector<MapAxis> over;
  for (int k = 5; k >= 0; --k) over.push_back({kTwistAxes[static_cast<std::size_t>(k)], -1, 1, 2});
  const Pose<double> here = posed(fixed, over, s.reverse()).pose;
  Eigen::VectorXd theta_r(task.redundancy() + 6);
  theta_r << task.theta_r_default, s;
  const Pose<double> there = pose_at(free, theta_r);
  EXPECT_LT((here.R - there.R).norm(), 1e-14);
  EXPECT_LT((here.p - there.p).norm(), 1e-14);
  EXPECT_EQ(posed(fixed, over, s.reverse()).c, task.c);  // in the world: it does not turn
}

/// A wrench in axes of the end effector turns with the pose. A quarter turn about z takes x to y.
TEST(Map, WrenchesOfTheEndEffectorTurn) {
  Problem task = load_problem("uvms/lift");
  task.wrench_in_end_effector = true;
  task.c << 1, 0, 0, 0, 0, 0;
  const std::vector<MapAxis> over = {{"yaw", 0, 2, 2}};
  const Problem turned = posed(task, over, Eigen::VectorXd::Constant(1, M_PI / 2));
  EXPECT_NEAR(turned.c[1], 1, 1e-12);
  // The azimuth is in those axes, too.
  const std::vector<MapAxis> both = {{"yaw", 0, 2, 2}, {"azimuth", 0, 2, 2}};
  const Problem back = posed(task, both, Eigen::Vector2d(M_PI / 2, -M_PI / 2));
  EXPECT_NEAR(back.c[0], 1, 1e-12);
}

/// A factor of limits is what an uncertain strength makes of them, also of a list with a loss; and
/// for a single actuator it changes its own limits only.
TEST(Map, FactorsAreThoseOfLimits) {
  const std::string loss = "[loss]\nany = 1\n";
  for (const std::string& tables : {std::string(), loss}) {
    const Problem task = scenario_task(kLift, tables);
    for (const char* key : {"thrust", "torque"}) {
      const Problem weaker = scenario_task(kLift, tables + "[uncertainty]\n" + key + " = 0.3\n");
      const Problem here = posed(task, {{key, 0.5, 1, 2}}, Eigen::VectorXd::Constant(1, 0.7));
      const double expected = evaluate(weaker, task.theta_r_default).beta();
      EXPECT_NEAR(evaluate(here, task.theta_r_default).beta(), expected, 1e-9) << key;
      EXPECT_LT(expected, evaluate(task, task.theta_r_default).beta() + 1e-9);
    }
  }
  const Problem task = load_problem("uvms/lift");
  const Problem here = posed(task, {{"q3_elbow", 2, 3, 2}}, Eigen::VectorXd::Constant(1, 3));
  Eigen::VectorXd u_max = task.robot.actuation.u_max;
  u_max[10] *= 3;
  EXPECT_EQ(here.robot.actuation.u_max, u_max);
  EXPECT_STREQ(map_unit("q3_elbow"), "-");
}

TEST(Map, IsTheSameAtAnyNumberOfThreadsAndInParts) {
  const Problem task = load_problem("uvms/lift");
  MapPlan plan = plan_over({{"roll", -1, 1, 9}, {"pitch", -1.4, 1.4, 6}});
  plan.refine = 1;
  plan.tolerance = 0.2;
  const CapabilityMap one = map(task, plan, with_budget(200, 1));
  EXPECT_GT(one.cells.size(), 54u);
  expect_same(one, map(task, plan, with_budget(200, 3)));
  CapabilityMap joined = one;
  std::map<std::vector<long>, MapCell> parts;
  for (int shard = 1; shard <= 3; ++shard) {
    MapPlan part = plan;
    part.shard = shard;
    part.shards = 3;
    for (const MapCell& cell : map(task, part, with_budget(200)).cells) {
      const auto [there, is_new] = parts.emplace(cell.index, cell);
      if (!is_new) {
        EXPECT_EQ(there->second.beta, cell.beta);
      }
    }
  }
  joined.cells.clear();
  for (const auto& [index, cell] : parts) joined.cells.push_back(cell);
  expect_same(one, joined);
}

/// A run that is stopped keeps its cells, and the next one computes the others only.
TEST(Map, GoesOnWhereItWasStopped) {
  const Problem task = load_problem("planar/force");
  MapPlan plan = plan_over({{"azimuth", 0, 6, 17}});
  const CapabilityMap whole = map(task, plan, with_budget(200));
  EXPECT_EQ(whole.computed, 17);
  std::map<std::vector<long>, MapCell> kept;
  std::mutex mutex;
  plan.computed = [&](const MapCell& cell) { kept.emplace(cell.index, cell); };
  plan.known = [&](const std::vector<long>& index) -> std::optional<MapCell> {
    const std::lock_guard guard(mutex);
    const auto found = kept.find(index);
    return found == kept.end() ? std::nullopt : std::optional(found->second);
  };
  Options stopped = with_budget(200, 1);
  stopped.interrupted = [&] { return kept.size() >= 7; };
  const CapabilityMap part = map(task, plan, stopped);
  EXPECT_EQ(part.status, Status::kBudgetExhausted);
  EXPECT_GE(kept.size(), 7u);
  EXPECT_LT(kept.size(), 17u);
  const auto before = static_cast<long>(kept.size());
  const CapabilityMap rest = map(task, plan, with_budget(200, 1));
  EXPECT_EQ(rest.computed, 17 - before);
  expect_same(whole, rest);
}

/// In open water and still, only the direction of gravity in the axes of the pose counts.
TEST(Map, SaysWhatChangesNothing) {
  const Problem lift = load_problem("uvms/lift");
  const MapPlan plan =
      plan_over({{"x", -1, 1, 2}, {"z", -1, 1, 2}, {"pitch", -1, 1, 2}, {"yaw", -1, 1, 2}});
  EXPECT_EQ(map(lift, plan, with_budget(50)).unchanging,
            (std::vector<std::string>{"x", "z", "yaw"}));
  // On a fixed base the place matters.
  const Problem push = load_problem("fixed/push");
  EXPECT_TRUE(map(push, plan_over({{"x", -0.1, 0.1, 2}}), with_budget(50)).unchanging.empty());
}

/// Each of both senses of the torque alone has the value of uvms/valve, 35.4083 N m (proven).
TEST(Map, SLOW_OfEachOfSeveralWrenches) {
  const Problem task = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/turn_both_ways.toml");
  const CapabilityMap found = map(task, plan_over({{"wrench", 1, 2, 2}}), with_budget(20000));
  ASSERT_EQ(found.cells.size(), 2u);
  for (const MapCell& cell : found.cells) EXPECT_NEAR(cell.beta, 35.4083, 0.036);
}

/// Out of reach there is no value, which is a result.
TEST(Map, SLOW_OutOfReachNothingIsFound) {
  const CapabilityMap found =
      map(load_problem("fixed/push"), plan_over({{"x", 9, 9, 1}}), with_budget(20));
  EXPECT_EQ(found.status, Status::kNoneFound);
  ASSERT_EQ(found.cells.size(), 1u);
  EXPECT_EQ(found.cells[0].status, Status::kNoneFound);
  EXPECT_TRUE(std::isnan(found.cells[0].beta));
  EXPECT_EQ(found.best(), nullptr);
  const auto object = nlohmann::json::parse(to_json(found));
  EXPECT_TRUE(object["largest"].is_null());
  EXPECT_THAT(summary(found), HasSubstr("none_found"));
}

}  // namespace
}  // namespace maxwrench
