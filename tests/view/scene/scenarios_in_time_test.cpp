#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "maxwrench/load.h"
#include "maxwrench/sensitivity.h"
#include "view/scene/scene.h"

// The scenarios of a task in time, as a page shows them.

namespace maxwrench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kListInTime =
    MAXWRENCH_SOURCE_DIR "/examples/tasks/turn_along_with_a_dead_thruster.toml";

Json scene_at_default(const Problem& problem) {
  const Eigen::MatrixXd theta_r = problem.theta_r_default.transpose();
  return scene_of(problem, {}, {{"default", evaluate(problem, theta_r)}});
}

TEST(ScenariosInTime, ThoseWithLeastComeFirst) {
  const Problem problem = load_problem(kListInTime);
  const Json scene = scene_at_default(problem);
  const Json& shown = scene["shown"][0];
  const Json& scenarios = shown["scenarios"];
  EXPECT_EQ(scenarios["count"], 3);
  const Json& ends = scenarios["ends"];
  ASSERT_EQ(ends.size(), 3u);
  // The list reaches what its worst scenario reaches alone, and the least of its numbers or less.
  EXPECT_EQ(ends[0]["name"], scenarios["decides"]);
  EXPECT_NEAR(ends[0]["high"].get<double>(), shown["beta"].get<double>(), 1e-9);
  EXPECT_LE(ends[0]["high"], ends[1]["high"]);
  EXPECT_LE(ends[1]["high"], ends[2]["high"]);
  ASSERT_EQ(scenarios["t"].size(), shown["frames"].size());
  for (std::size_t i = 0; i < scenarios["t"].size(); ++i) {
    EXPECT_EQ(scenarios["t"][i], shown["frames"][i]["t"]);
  }
  for (const Json& each : ends) {
    ASSERT_EQ(each["values"].size(), scenarios["t"].size());
    for (const Json& value : each["values"]) {
      EXPECT_GE(value.get<double>(), each["high"].get<double>() - 1e-9) << each["name"];
    }
  }
  // Its efforts are within its limits: the dead thruster has none.
  const Json& actuators = scene["robot"]["actuators"];
  const auto dead = std::find_if(actuators.begin(), actuators.end(), [](const Json& actuator) {
    return actuator["name"] == "front_left_vertical";
  });
  ASSERT_NE(dead, actuators.end());
  const auto i = static_cast<std::size_t>(dead - actuators.begin());
  EXPECT_EQ(scenarios["decides"], "front_left_vertical dead");
  EXPECT_EQ(scenarios["u_min"][i], 0);
  EXPECT_EQ(scenarios["u_max"][i], 0);
  for (const Json& frame : shown["frames"]) EXPECT_NEAR(frame["u"][i].get<double>(), 0, 1e-12);
}

TEST(ScenariosInTime, ATaskWithoutAListHasNone) {
  EXPECT_TRUE(
      scene_at_default(load_problem("planar/trajectory"))["shown"][0]["scenarios"].is_null());
}

/// A value of each scenario at the peak only; infinity is no number of JSON.
TEST(ScenariosInTime, OfAnImpulseThePeakCounts) {
  Problem problem = load_problem("uvms/valve_impulse");
  const Problem list = load_problem(kListInTime);
  problem.scenarios = list.scenarios;
  for (ScenarioWrench& wrench : problem.scenarios.wrenches) wrench.c = problem.c;
  const Json shown = scene_at_default(problem)["shown"][0];
  const Json& scenarios = shown["scenarios"];
  ASSERT_EQ(scenarios["ends"].size(), 3u);
  for (const Json& each : scenarios["ends"]) {
    EXPECT_EQ(std::count_if(each["values"].begin(), each["values"].end(),
                            [](const Json& value) { return value.is_number(); }),
              1)
        << each["name"];
  }
}

}  // namespace
}  // namespace maxwrench
