#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/map.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/maps.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

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
        BadPlan{"NoFactor", plan_over({{"thrust", 0, 1, 2}}), "uvms/lift", "factors above 0"},
        BadPlan{"NoThrusters", plan_over({{"thrust", 0.5, 1, 2}}), "fixed/push",
                "the robot has no thrusters"},
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
                "shard: got '2/1'"},
        BadPlan{"TooManyShards",
                changed(kSmall,
                        [](MapPlan& p) {
                          p.shard = 2;
                          p.shards = 1000;
                        }),
                "uvms/lift", "shard: got 1000 parts, expected at most"}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace maxwrench
