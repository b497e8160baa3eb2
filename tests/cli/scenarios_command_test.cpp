#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(ScenariosCommand, EvalSaysWhatDecides) {
  const CommandResult result = run_maxwrench("eval examples/tasks/turn_both_ways.toml --scenarios");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("decides  wrench 1"));
  EXPECT_THAT(result.out, HasSubstr("wrench 2"));
  const json object =
      json::parse(run_maxwrench("eval examples/tasks/turn_both_ways.toml --scenarios --json").out);
  EXPECT_EQ(object["decides"], "wrench 1");
  ASSERT_EQ(object["scenarios"].size(), 2u);
  EXPECT_NEAR(object["scenarios"][0]["high"], object["beta"], 1e-9);
  EXPECT_NEAR(object["critical"][5], object["beta"], 1e-9);
}

/// Of a ball the direction is named. A task with this direction alone has the same value, and none
/// of 360 others has less. One scenario has nothing to name.
TEST(ScenariosCommand, EvalNamesTheDirectionOfABall) {
  const std::string file = MAXWRENCH_SOURCE_DIR "/examples/tasks/push_anywhere.toml";
  const std::string out = run_maxwrench("eval " + file).out;
  const std::string words = "decides  force along [";
  ASSERT_THAT(out, HasSubstr(words));
  std::istringstream numbers(out.substr(out.find(words) + words.size()));
  Eigen::Vector3d direction;
  char comma = ' ';
  numbers >> direction[0] >> comma >> direction[1] >> comma >> direction[2];
  EXPECT_NEAR(direction.norm(), 1, 1e-4);
  EXPECT_EQ(direction[2], 0);
  const Problem task = load_problem(file);
  Problem one = task;
  one.scenarios = {};
  const auto value_along = [&](const Eigen::Vector3d& along) {
    one.c << along.normalized(), 0, 0, 0;
    return evaluate(one, one.theta_r_default).beta();
  };
  const double beta = evaluate(task, task.theta_r_default).beta();
  EXPECT_NEAR(value_along(direction), beta, 1e-4 * beta);
  for (int k = 0; k < 360; ++k) {
    const double angle = k * M_PI / 180;
    EXPECT_GE(value_along({std::cos(angle), std::sin(angle), 0}), beta * (1 - 1e-9));
  }
  EXPECT_THAT(run_maxwrench("eval examples/tasks/carry_steel.toml").out, Not(HasSubstr("decides")));
}

/// `worst` is what `decides` says in words: its changes are corners of the task's intervals, and a
/// task in which nothing else is uncertain has the same value.
TEST(ScenariosCommand, EvalGivesTheDataOfWhatDecides) {
  const std::string eval = "eval examples/tasks/turn_guaranteed.toml --json";
  const json object = json::parse(run_maxwrench(eval).out), &worst = object["worst"];
  const std::string decides = object["decides"];
  EXPECT_TRUE(worst["wrench"].is_null());
  EXPECT_TRUE(worst["current"].is_null());
  EXPECT_EQ(worst["c"], json::parse("[0, 0, 0, 0, 0, 1]"));
  ASSERT_EQ(worst["deltas"].size(), 5u) << worst;
  EXPECT_NEAR(std::abs(worst["deltas"]["mass.link_4"].get<double>()), 0.1, 1e-15);
  EXPECT_NEAR(std::abs(worst["deltas"]["com.link_2"][0].get<double>()), 0.01, 1e-15);
  EXPECT_EQ(worst["deltas"]["com.link_2"][1], 0);
  const double trim = worst["deltas"]["trim"];
  EXPECT_THAT(decides, HasSubstr(trim > 0 ? "trim +0.2 kg" : "trim -0.2 kg"));
  for (const char* lost : {"dead", "limp", "locked", "weaker"}) EXPECT_TRUE(worst[lost].empty());
  const json both =
      json::parse(run_maxwrench("eval examples/tasks/turn_both_ways.toml --json").out);
  EXPECT_EQ(both["worst"]["wrench"], "wrench 1");
  EXPECT_EQ(both["worst"]["c"], json::parse("[0, 0, 0, 0, 0, 1]"));
  const json plain = json::parse(run_maxwrench("eval uvms/valve --json").out);
  EXPECT_FALSE(plain.contains("worst"));
}

/// In time as well, with the instant.
TEST(ScenariosCommand, EvalSaysWhatDecidesInTime) {
  const std::string eval = "eval examples/tasks/turn_along_with_a_dead_thruster.toml --scenarios";
  const CommandResult result = run_maxwrench(eval);
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("decides  front_"));
  const json object = json::parse(run_maxwrench(eval + " --json").out);
  ASSERT_EQ(object["scenarios"].size(), 3u);
  double least = 1e9;
  std::string name;
  for (const json& each : object["scenarios"]) {
    if (each["high"] >= least) continue;
    least = each["high"];
    name = each["name"];
  }
  EXPECT_EQ(object["decides"], name);
  ASSERT_EQ(object["worst"]["dead"].size(), 1u);
  EXPECT_EQ(object["worst"]["dead"][0].get<std::string>() + " dead", name);
  EXPECT_NEAR(object["beta"], least, 1e-6);
  bool found = false;
  for (const json& instant : object["instants"]) found |= instant["t"] == object["decides_at"];
  EXPECT_TRUE(found);
  for (const json& actuator : object["actuators"]) {
    const bool dead = name == actuator["name"].get<std::string>() + " dead";
    EXPECT_EQ(actuator["min"] == 0 && actuator["max"] == 0, dead) << actuator["name"];
  }
  const CommandResult explained =
      run_maxwrench("eval examples/tasks/turn_along_with_a_dead_thruster.toml --explain");
  EXPECT_EQ(explained.exit_status, 0) << explained.err;
  EXPECT_THAT(explained.out, HasSubstr(" s (" + name + "): "));
  const json alone = json::parse(
      run_maxwrench("eval examples/tasks/turn_along_with_a_dead_thruster.toml --nominal --json")
          .out);
  const json shipped = json::parse(run_maxwrench("eval uvms/valve_trajectory --json").out);
  EXPECT_EQ(alone["beta"], shipped["beta"]);
}

/// The tank carries out each scenario, and a proof has a part for each.
TEST(ScenariosCommand, SLOW_SimulatesAndProvesEachScenarioInTime) {
  const TemporaryFolder folder;
  const std::string task = " examples/tasks/turn_along_with_a_dead_thruster.toml ";
  const CommandResult ran = run_maxwrench("simulate" + task + "--json");
  EXPECT_EQ(ran.exit_status, 0) << ran.err;
  const json object = json::parse(ran.out);
  EXPECT_EQ(object["held"], true);
  ASSERT_EQ(object["scenarios"].size(), 3u);
  double least = 1e9;
  for (const json& each : object["scenarios"]) least = std::min<double>(least, each["factor"]);
  EXPECT_EQ(object["reading"], least);
  const std::string proof = (folder.path() / "turn.proof").string();
  const CommandResult proven =
      run_maxwrench("certify" + task +
                    "--theta-r 3.06428133,0.68946096,0.42879605,-3.0277901 --certificate " + proof);
  EXPECT_EQ(proven.exit_status, 0) << proven.err;
  EXPECT_THAT(proven.out, HasSubstr("of 3 scenarios"));
  const json checked = json::parse(run_maxwrench("verify " + proof + " --json").out);
  EXPECT_EQ(checked["status"], "verified") << checked;
  EXPECT_NEAR(checked["guaranteed"], 12.0718, 0.001);
}

TEST(ScenariosCommand, TellsWhenAFailureIsNoticed) {
  const json object =
      json::parse(run_maxwrench("simulate uvms/lift --planned 14.5 --dies front_left_vertical=5.5 "
                                "--noticed-after 0.25 --json")
                      .out);
  ASSERT_EQ(object["dies"].size(), 1u);
  EXPECT_EQ(object["dies"][0]["name"], "front_left_vertical");
  EXPECT_EQ(object["dies"][0]["t"], 5.5);
  EXPECT_EQ(object["dies"][0]["noticed_after"], 0.25);
}

/// Each is rejected in one line that names the option.
TEST(ScenariosCommand, RejectsWhatCannotDie) {
  for (const std::string words :
       {"--dies rudder=1", "--dies front_left_vertical", "--dies front_left_vertical=nan",
        "--dies front_left_vertical=-1",
        "--dies front_left_vertical=", "--dies front_left_vertical=99", "--noticed-after 1",
        "--dies front_left_vertical=1 --noticed-after nan"}) {
    const CommandResult refused = run_maxwrench("simulate uvms/lift " + words);
    EXPECT_EQ(refused.exit_status, 2) << words << refused.out;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
}

/// The nominal task is the shipped one.
TEST(ScenariosCommand, NominalIsWithoutUncertainty) {
  const json nominal =
      json::parse(run_maxwrench("eval examples/tasks/turn_guaranteed.toml --nominal --json").out);
  const json shipped = json::parse(run_maxwrench("eval uvms/valve --json").out);
  EXPECT_EQ(nominal["beta"], shipped["beta"]);
  EXPECT_FALSE(nominal.contains("decides"));
  EXPECT_EQ(nominal["task_digest"], "");  // no file holds this task
}

TEST(ScenariosCommand, SampleIsNeverBelowTheGuarantee) {
  const json object = json::parse(
      run_maxwrench("eval examples/tasks/turn_guaranteed.toml --sample 200 --seed 4 --json").out);
  EXPECT_EQ(object["sample"]["drawn"], 200);
  EXPECT_EQ(object["sample"]["below"], 0);
  EXPECT_GE(object["sample"]["least"].get<double>(), object["beta"].get<double>() - 1e-9);
}

/// Model i of a seed is the same in any posture, run and number of models. A model is below what it
/// is compared with if its value is, and a guaranteed value of another posture may be compared.
TEST(ScenariosCommand, ModelsAreRowsOfATable) {
  const TemporaryFolder folder;
  const auto models = [&](const std::string& options) {
    const std::string file = folder.path() / "models.csv";
    const CommandResult result = run_maxwrench(
        "eval examples/tasks/lift_guaranteed.toml --sample " + options + " --models " + file);
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return read_text(file);
  };
  const std::string many = models("300 --seed 7"), few = models("40 --seed 7");
  EXPECT_EQ(std::count(many.begin(), many.end(), '\n'), 301);
  EXPECT_EQ(many.substr(0, few.size()), few);
  EXPECT_NE(models("40 --seed 8"), few);
  const json object = json::parse(
      run_maxwrench("eval examples/tasks/lift_guaranteed.toml --sample 300 --seed 7 --json "
                    "--guaranteed 28")
          .out);
  long below = 0;
  std::istringstream lines(many);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "model,beta");
  while (std::getline(lines, line)) below += std::stod(line.substr(line.find(',') + 1)) < 28;
  EXPECT_GT(below, 0);
  EXPECT_LT(below, 300);
  EXPECT_EQ(object["sample"]["below"], below);
  EXPECT_EQ(object["sample"]["guaranteed"], 28);
}

TEST(ScenariosCommand, SensitivityRanksThrusters) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "sensitivity uvms/valve --budget 300 --search crs2 --actuators front_left_vertical,"
      "q1_shoulder_yaw --figure " +
      (folder.path() / "losses.svg").string());
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("front_left_vertical dead"));
  EXPECT_THAT(result.out, HasSubstr("q1_shoulder_yaw limp"));
  EXPECT_THAT(read_text(folder.path() / "losses.svg"), HasSubstr("front_left_vertical dead"));
}

/// Pictures show the value of the list, with the efforts of the scenario that decides.
TEST(ScenariosCommand, PicturesHaveTheValueOfTheList) {
  const TemporaryFolder folder;
  const std::string task = "examples/tasks/lift_with_a_dead_thruster.toml", beta = "14.56 N";
  const std::string svg = (folder.path() / "a.svg").string(),
                    html = (folder.path() / "a.html").string();
  EXPECT_EQ(run_maxwrench("plot " + task + " --out " + svg).exit_status, 0);
  EXPECT_THAT(read_text(svg), HasSubstr(beta));
  EXPECT_EQ(run_maxwrench("view " + task + " --out " + html).exit_status, 0);
  EXPECT_THAT(read_text(html), HasSubstr("14.556"));
}

struct Refusal {
  const char *words, *line;
};

class ScenarioRefusals : public testing::TestWithParam<Refusal> {};

/// In a folder of its own, so that a command that is not refused leaves nothing among the sources.
TEST_P(ScenarioRefusals, AreOneLine) {
  const TemporaryFolder folder;
  std::string words = GetParam().words;
  if (const std::size_t at = words.find("examples/"); at != std::string::npos) {
    words.insert(at, MAXWRENCH_SOURCE_DIR "/");
  }
  const CommandResult result = run_maxwrench(words, folder.path());
  EXPECT_EQ(result.exit_status, 2) << result.out;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr(GetParam().line));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(ScenariosCommand, ExplainNamesTheScenario) {
  const CommandResult result =
      run_maxwrench("eval examples/tasks/lift_with_a_dead_thruster.toml --explain");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NE(result.out.find("in the scenario that decides, "), std::string::npos) << result.out;
}

TEST(ScenariosCommand, ACertificateOfAListIsVerified) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "list.proof").string();
  const std::string task = "examples/tasks/lift_with_a_dead_thruster.toml";
  const CommandResult proof =
      run_maxwrench("certify " + task + " --gap 0.01 --certificate " + file);
  EXPECT_EQ(proof.exit_status, 0) << proof.err;
  const CommandResult checked = run_maxwrench("verify " + file);
  EXPECT_EQ(checked.exit_status, 0) << checked.err << checked.out;
  EXPECT_NE(checked.out.find("\nverified\n"), std::string::npos) << checked.out;
  const CommandResult other = run_maxwrench("verify " + file + " --problem uvms/lift");
  EXPECT_EQ(other.exit_status, 1) << other.err << other.out;
}

INSTANTIATE_TEST_SUITE_P(
    All, ScenarioRefusals,
    testing::Values(
        Refusal{"eval uvms/valve --scenarios",
                "--scenarios: got uvms/valve, a task without a list"},
        Refusal{"eval examples/tasks/lift_guaranteed.toml --guaranteed 3", "--guaranteed"},
        Refusal{"eval examples/tasks/lift_guaranteed.toml --sample 3 --guaranteed nan",
                "guaranteed: got nan"},
        Refusal{"eval uvms/valve --sample 10", "--sample: got uvms/valve, a task without a list"},
        Refusal{"certify examples/tasks/push_anywhere.toml --wrench any --certificate x.proof",
                "certificate"},
        Refusal{"eval uvms/lift --explain --at 1.5", "--at: got '1.5'"},
        Refusal{"eval uvms/lift --explain --at 0.5 --share 0.5", "--at: got '0.5'"},
        Refusal{"eval uvms/lift --at 0.5", "not a URDF"},
        Refusal{"eval examples/tasks/push_anywhere.toml --solver simplex", "solver"},
        Refusal{"eval examples/tasks/turn_both_ways.toml --measure ellipsoid", "measure"},
        Refusal{"eval examples/tasks/turn_both_ways.toml --write x.mps", "--write: got"},
        Refusal{"plot examples/tasks/turn_both_ways.toml --style outline --out x.svg",
                "list of scenarios"},
        Refusal{"certify examples/tasks/turn_in_current.toml --certificate x.proof",
                "--certificate: got a task with currents"},
        Refusal{"eval examples/tasks/carry_steel.toml --wrench any",
                "wrench: got any, expected pure"},
        Refusal{"eval uvms/valve_trajectory --scenarios", "--scenarios: got uvms/valve_trajectory"},
        Refusal{"sensitivity uvms/valve --joints-are locked --friction 1", "--friction: got 1"},
        Refusal{"sensitivity uvms/valve --brake 1", "--brake: got 1"},
        Refusal{"sensitivity uvms/valve_trajectory", "sensitivity"},
        Refusal{"sensitivity uvms/valve --actuators wing", "--actuators: got"}));

}  // namespace
}  // namespace maxwrench
