#include "solvers/solve/tank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "benchmarks/tables/write_file.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

using Json = nlohmann::ordered_json;

Json tank_of(const Answer& answer) {
  return scene_of(*answer.task, {}, {{"default", answer, true}})["shown"][0]["tank"];
}

Answer default_answer(const Problem& problem) {
  return evaluate(problem, problem.theta_r_default.transpose());
}

/// `simulate` evaluates the trajectory and runs the experiment by itself.
TEST(SceneTank, ReadsWhatSimulateReads) {
  for (const char* name : {"mobile/trajectory", "uvms/lift_impulse"}) {
    const Json tank = tank_of(default_answer(load_problem(name)));
    const CommandResult result = run_maxwrench(std::string("simulate ") + name + " --json");
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const Json run = Json::parse(result.out);
    EXPECT_EQ(tank["status"], run["status"]);
    EXPECT_EQ(tank["held"], run["held"]);
    EXPECT_EQ(tank["planned"], run["planned"]);
    EXPECT_EQ(tank["asked"], run["asked"]);
    EXPECT_EQ(tank["reading"], run["at_t_h"].is_null() ? run["low"] : run["at_t_h"]) << name;
    const auto times = tank["curve"]["t"].get<std::vector<double>>();
    const auto reading = tank["curve"]["reading"].get<std::vector<double>>();
    ASSERT_EQ(times.size(), reading.size());
    ASSERT_EQ(times.size(), tank["curve"]["planned"].size());
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    EXPECT_NEAR(times.back(), run["end"].get<double>(), 1e-5);
    const auto [low, high] = std::minmax_element(reading.begin(), reading.end());
    // Six digits of the curve.
    EXPECT_NEAR(*low, run["low"].get<double>(), 1e-5 * std::abs(run["low"].get<double>())) << name;
    EXPECT_NEAR(*high, run["high"].get<double>(), 1e-5 * run["high"].get<double>()) << name;
    const auto at = static_cast<std::size_t>(high - reading.begin());
    EXPECT_NEAR(times[at], run["t_high"].get<double>(), 1e-5);
  }
}

/// 3000 periods of 0.01 s: lowest and highest readings of stretches, so none is lost.
TEST(SceneTank, SLOW_ALongExperimentKeepsItsExtremes) {
  const TemporaryFolder folder;
  std::string task = read_text(MAXWRENCH_SOURCE_DIR "/problems/mobile/trajectory.toml");
  const auto replace = [&task](const std::string& from, const std::string& to) {
    const std::size_t at = task.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    task.replace(at, from.size(), to);
  };
  replace("T = 3\n", "T = 30\n");
  replace("rover.toml", MAXWRENCH_SOURCE_DIR "/problems/mobile/rover.toml");
  write_file((folder.path() / "slow.toml").string(), task);
  const Answer answer = default_answer(load_problem((folder.path() / "slow.toml").string()));
  const Json tank = tank_of(answer);
  ASSERT_EQ(tank["status"], "reached") << tank["reason"];
  const auto reading = tank["curve"]["reading"].get<std::vector<double>>();
  EXPECT_LE(reading.size(), 2000U);
  EXPECT_GE(reading.size(), 1000U);
  ScriptOptions script;
  script.margin = TankOptions().margin;
  const TankRun run =
      simulate_trajectory(*answer.task, answer.trajectory, answer.choice.wrench,
                          trajectory_solvers().front(), script, "cvode", TankOptions())
          .run;
  ASSERT_GT(run.samples.size(), 2900U);
  const auto less = [](const TankSample& a, const TankSample& b) { return a.reading < b.reading; };
  const auto [low, high] = std::minmax_element(run.samples.begin(), run.samples.end(), less);
  const auto [drawn_low, drawn_high] = std::minmax_element(reading.begin(), reading.end());
  EXPECT_NEAR(*drawn_low, low->reading, 1e-5 * low->reading);
  EXPECT_NEAR(*drawn_high, high->reading, 1e-5 * high->reading);
}

TEST(SceneTank, HasNothingToCarryOutWithoutAValue) {
  const Answer answer = default_answer(load_problem("uvms/valve_trajectory"));
  Answer none = answer;
  none.conclude(Status::kInfeasible, "made up");
  EXPECT_TRUE(tank_of(none).is_null());
  const Json scene = scene_of(*answer.task, {}, {{"default", answer}});
  EXPECT_FALSE(scene["shown"][0].contains("tank"));  // only if asked for
}

TEST(SceneTank, RejectsWhatTheTankDoesNotSupport) {
  const auto rejects = [](const char* words, const char* expected) {
    const CommandResult result = run_maxwrench(std::string("view --tank ") + words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  };
  rejects("planar/force", "--tank: got planar/force, a static task, expected a task in time");
  rejects(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/lift.toml",
          "expected a task in time with one wrench along c");
}

}  // namespace
}  // namespace maxwrench
