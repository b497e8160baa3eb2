#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "maxwrench/load.h"
#include "maxwrench/map.h"
#include "maxwrench/task.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/maps.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

/// A bound is never below a value; a cell that holds nothing has none.
TEST(MapBounds, ProvesBounds) {
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
TEST(MapBounds, CountsBounds) {
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
TEST(MapBounds, ChecksWithABudgetOfItsOwn) {
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
TEST(MapBounds, RefusesBoundsAtOnce) {
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
TEST(MapBounds, CountsWhatASearchFromScratchImproves) {
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

}  // namespace
}  // namespace maxwrench
