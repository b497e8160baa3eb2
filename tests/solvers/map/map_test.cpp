#include "maxwrench/map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>

#include "maxwrench/evaluations.h"
#include "maxwrench/load.h"
#include "maxwrench/task.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

MapPlan plan_over(std::vector<MapAxis> over) {
  MapPlan plan;
  plan.over = std::move(over);
  return plan;
}

Options with_budget(long budget, int threads = 2) {
  Options options;
  options.budget = budget;
  options.threads = threads;
  return options;
}

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
TEST(Map, OfEachOfSeveralWrenches) {
  const Problem task = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/turn_both_ways.toml");
  const CapabilityMap found = map(task, plan_over({{"wrench", 1, 2, 2}}), with_budget(20000));
  ASSERT_EQ(found.cells.size(), 2u);
  for (const MapCell& cell : found.cells) EXPECT_NEAR(cell.beta, 35.4083, 0.036);
}

/// A bound is never below a value; a cell that holds nothing has none.
TEST(Map, ProvesBounds) {
  MapPlan plan = plan_over({{"azimuth", 0, 1.5, 2}});
  plan.bound = true;
  plan.check = 1;
  const CapabilityMap found = map(load_problem("planar/force"), plan, with_budget(500));
  for (const MapCell& cell : found.cells) {
    EXPECT_GE(cell.bound, cell.beta * (1 - 1e-12));
    EXPECT_LE(cell.bound, cell.beta * 1.0011);
    ASSERT_TRUE(cell.scratch);
    EXPECT_LE(*cell.scratch, cell.bound);
  }
  EXPECT_EQ(found.checked(), 2);
  EXPECT_EQ(found.improved(), 0);
  EXPECT_EQ(found.proven(), 2);
  EXPECT_LE(found.widest_gap(), 0.0011);
  EXPECT_THAT(summary(found), HasSubstr("proven    2 of 2 cells with a value to 0.1 %"));
  const auto object = nlohmann::json::parse(to_json(found));
  EXPECT_EQ(object["proven"], 2);
  EXPECT_EQ(object["largest_bound"], std::max(found.cells[0].bound, found.cells[1].bound));
}

/// Gaps of 0, 0.5 / 1, 1 / 2 and 0.2 / 2 = 10 %; a cell without a value has none.
TEST(Map, CountsBounds) {
  CapabilityMap made;
  made.plan.bound = true;
  made.plan.gap = 0.1;
  const auto add = [&](double beta, double bound) {
    MapCell cell;
    cell.conclude(std::isnan(beta) ? Status::kNoneFound : Status::kBestFound);
    cell.beta = beta;
    cell.bound = bound;
    made.cells.push_back(cell);
  };
  add(1, 1);
  add(1, 1.5);
  add(-2, -1);
  add(2, 2.2);
  add(std::nan(""), kInfinity);
  EXPECT_EQ(made.proven(), 2);
  EXPECT_DOUBLE_EQ(made.widest_gap(), 0.5);
  add(3, kInfinity);
  EXPECT_EQ(made.proven(), 2);
  EXPECT_EQ(made.widest_gap(), kInfinity);
}

/// The check of a map whose cells had one evaluation, at the default posture, still finds the
/// optimum of planar/force, 3.4775 N (proven): it does not use the budget of the cells.
TEST(Map, ChecksWithABudgetOfItsOwn) {
  MapPlan plan = plan_over({{"azimuth", 0, 0, 1}});
  plan.check = 1;
  const Problem task = load_problem("planar/force");
  const CapabilityMap found = map(task, plan, with_budget(1));
  const double best = solve(posed(task, plan.over, Eigen::VectorXd::Zero(1)), {}).beta();
  ASSERT_TRUE(found.cells[0].scratch);
  EXPECT_LT(found.cells[0].beta, 0.9 * best);
  EXPECT_NEAR(*found.cells[0].scratch, best, 1e-3 * best);
  EXPECT_EQ(found.improved(), 1);
  plan.check_budget = 1;
  EXPECT_LT(map(task, plan, with_budget(1)).cells[0].scratch.value_or(0), 0.9 * best);
}

/// What has no bound is refused before the first cell.
TEST(Map, RefusesBoundsAtOnce) {
  MapPlan plan = plan_over({{"x", 0, 1, 2}});
  plan.bound = true;
  plan.computed = [](const MapCell&) { FAIL() << "a cell was computed"; };
  const Problem task = load_problem("uvms/lift");
  Options options = with_budget(20);
  options.measure = "manipulability";
  EXPECT_THAT(rejection_of([&] { map(task, plan, options); }),
              HasSubstr("measure: got 'manipulability'"));
  options.measure = "linf_polytope";
  plan.seconds = std::nan("");
  EXPECT_THAT(rejection_of([&] { map(task, plan, options); }), HasSubstr("seconds: got nan"));
  plan.seconds = 60;
  plan.gap = 0;
  EXPECT_THAT(rejection_of([&] { map(task, plan, options); }), HasSubstr("gap: got 0"));
  plan.gap = 1e-3;
  Problem geared = task;
  geared.robot.joints[2].gear = Gear{1, 1, 0};
  EXPECT_THAT(rejection_of([&] { map(geared, plan, options); }), HasSubstr("by a gear"));
}

/// Improved are: 2 beside 1, a value beside none; not: 1.0009 beside 1, none beside none.
TEST(Map, CountsWhatASearchFromScratchImproves) {
  CapabilityMap made;
  const auto add = [&](bool found, double beta, std::optional<double> scratch) {
    MapCell cell;
    cell.conclude(found ? Status::kBestFound : Status::kNoneFound);
    cell.beta = beta;
    cell.scratch = scratch;
    made.cells.push_back(cell);
  };
  const double none = std::nan("");
  add(true, 1, 2);
  add(false, none, 1);
  add(true, 1, 1.0009);
  add(true, 1, 0.5);
  add(false, none, -kInfinity);
  add(true, 1, std::nullopt);
  EXPECT_EQ(made.checked(), 5);
  EXPECT_EQ(made.improved(), 2);
  EXPECT_EQ(made.best(), made.cells.data());
}

/// Out of reach there is no value, which is a result.
TEST(Map, OutOfReachNothingIsFound) {
  const CapabilityMap found =
      map(load_problem("fixed/push"), plan_over({{"x", 9, 10, 2}}), with_budget(20));
  EXPECT_EQ(found.status, Status::kNoneFound);
  ASSERT_EQ(found.cells.size(), 2u);
  EXPECT_EQ(found.cells[0].status, Status::kNoneFound);
  EXPECT_TRUE(std::isnan(found.cells[0].beta));
  EXPECT_EQ(found.best(), nullptr);
  const auto object = nlohmann::json::parse(to_json(found));
  EXPECT_TRUE(object["largest"].is_null());
  EXPECT_THAT(summary(found), HasSubstr("none_found"));
}

struct BadPlan {
  const char* name;
  MapPlan plan;
  const char *task, *line;
};
void PrintTo(const BadPlan& bad, std::ostream* out) { *out << bad.name; }

class BadMapPlan : public testing::TestWithParam<BadPlan> {};

TEST_P(BadMapPlan, IsRejectedInOneLine) {
  const Problem task = load_problem(GetParam().task);
  const std::string line = rejection_of([&] { map(task, GetParam().plan); });
  EXPECT_THAT(line, HasSubstr(GetParam().line));
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

MapPlan changed(MapPlan plan, const std::function<void(MapPlan&)>& change) {
  change(plan);
  return plan;
}

const MapPlan kSmall = plan_over({{"x", 0, 1, 2}});

INSTANTIATE_TEST_SUITE_P(
    All, BadMapPlan,
    testing::Values(
        BadPlan{"Huge", plan_over({{"x", 0, 1, 1000000}, {"z", 0, 1, 1000000}}), "uvms/lift",
                "over: got a grid of 1e+12 cells, expected at most 1e+06"},
        BadPlan{"Order", plan_over({{"x", 1, 0, 2}}), "uvms/lift", "expected low < high"},
        BadPlan{"Unknown", plan_over({{"w", 0, 1, 2}}), "uvms/lift", "one of the coordinates x y"},
        BadPlan{"NaN", plan_over({{"x", std::nan(""), 1, 2}}), "uvms/lift", "finite limits"},
        BadPlan{"Infinite", plan_over({{"x", 0, kInfinity, 2}}), "uvms/lift", "finite limits"},
        BadPlan{"None", plan_over({{"x", 0, 1, 0}}), "uvms/lift", "at least one value"},
        BadPlan{"One", plan_over({{"x", 0, 1, 1}}), "uvms/lift", "the same limits"},
        BadPlan{"Twice", plan_over({{"x", 0, 1, 2}, {"x", 0, 1, 2}}), "uvms/lift", "once"},
        BadPlan{"Empty", plan_over({}), "uvms/lift", "over: got nothing"},
        BadPlan{"Far", plan_over({{"x", 0, 1e9, 2}}), "uvms/lift", "at most 1e+06"},
        BadPlan{"InTime", kSmall, "uvms/valve_trajectory", "a task in time"},
        BadPlan{"OneWrench", plan_over({{"wrench", 1, 2, 2}}), "uvms/lift", "has one wrench"},
        BadPlan{"ThirdOfTwo", plan_over({{"wrench", 1, 3, 3}}),
                MAXWRENCH_SOURCE_DIR "/examples/tasks/turn_both_ways.toml", "from 1 to 2"},
        BadPlan{"Ball", plan_over({{"azimuth", 0, 1, 2}}),
                MAXWRENCH_SOURCE_DIR "/examples/tasks/push_anywhere.toml",
                "expected it for a task with one force"},
        BadPlan{"OutOfPlane", plan_over({{"elevation", 0, 1, 2}}), "planar/force",
                "expected directions within the wrenches that do work"},
        BadPlan{"Refine", changed(kSmall, [](MapPlan& p) { p.refine = 99; }), "uvms/lift",
                "refine: got 99"},
        BadPlan{"Tolerance", changed(kSmall, [](MapPlan& p) { p.tolerance = std::nan(""); }),
                "uvms/lift", "tolerance: got nan"},
        BadPlan{"Check", changed(kSmall, [](MapPlan& p) { p.check = 2; }), "uvms/lift",
                "check: got 2"},
        BadPlan{"CheckBudget", changed(kSmall, [](MapPlan& p) { p.check_budget = -1; }),
                "uvms/lift", "check_budget: got -1"},
        BadPlan{"Shard", changed(kSmall, [](MapPlan& p) { p.shard = 2; }), "uvms/lift",
                "shard: got '2/1'"}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace maxwrench
