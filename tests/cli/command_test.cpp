#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/suite/row_writer.h"
#include "maxwrench/strategies.h"
#include "maxwrench/version.h"
#include "tests/support/edited_copy.h"
#include "tests/support/support.h"
#include "tests/support/table.h"

namespace maxwrench {
namespace {

using nlohmann::json;

TEST(Command, OwnFilesGiveTheSameAnswerAsShippedOnes) {
  const EditedCopy copy;
  const std::string words = " --theta-r 0.3,-0.7 --json";
  const json own = json::parse(
      run_maxwrench("eval '" + (copy.path() / "force.toml").string() + "'" + words).out);
  const json shipped = json::parse(run_maxwrench("eval planar/force" + words).out);
  EXPECT_EQ(own["beta"], shipped["beta"]);
}

TEST(Command, CheckSaysHowTheSecondContactActs) {
  const CommandResult wall = run_maxwrench("check dual_arm/bar_wall");
  EXPECT_EQ(wall.exit_status, 0) << wall.err;
  EXPECT_NE(wall.out.find("second contact right_tool: plane at [-0.2, -0.5, 0] m, into the "
                          "environment along [0, -1, 0]; dependent right_q1_shoulder_yaw, "),
            std::string::npos)
      << wall.out;
  EXPECT_NE(wall.out.find("second contact exerts [0, 0, 1, 0, 0, 0], 0 .. inf"), std::string::npos);
  EXPECT_EQ(run_maxwrench("check uvms/valve").out.find("second contact"), std::string::npos);
}

/// Wide numbers stay apart.
TEST(Command, EvalSeparatesNumbersByBlanks) {
  const std::string out = run_maxwrench("eval fixed/push").out;
  const std::size_t begin = out.find("\nh ") + 2;
  std::istringstream words(out.substr(begin, out.find('\n', begin) - begin));
  int count = 0;
  for (std::string word; words >> word; ++count) {
    EXPECT_EQ(word.find('-', 1), std::string::npos) << word;
  }
  EXPECT_EQ(count, 6);
}

TEST(Command, OneEvaluationIsOne) {
  for (const char* words : {"eval planar/force", "eval planar/trajectory"}) {
    EXPECT_NE(run_maxwrench(words).out.find("; 1 evaluation in "), std::string::npos) << words;
  }
  EXPECT_NE(run_maxwrench("solve planar/force --budget 20").out.find("; 20 evaluations in "),
            std::string::npos);
}

TEST(Command, SolveSaysThatItSearchedAndHow) {
  const std::string out = run_maxwrench("solve planar/force --budget 20").out;
  EXPECT_NE(out.find("\nbest_found by facet_sqp+cmaes: the evaluations ran out\n"),
            std::string::npos)
      << out;
  EXPECT_EQ(out.find("optimal"), std::string::npos) << out;
}

TEST(Command, EvalReportsTheSecondContact) {
  const CommandResult text = run_maxwrench("eval planar/two_arms");
  EXPECT_EQ(text.exit_status, 0) << text.err;
  EXPECT_NE(text.out.find("\nh_2 "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("postures: "), std::string::npos) << text.out;
  // Its theta_r ends with the regrasp coordinate. Beyond the reach there is no solution.
  const CommandResult away = run_maxwrench("eval dual_arm/bar_wall --theta-r 0.2,0.15 --json");
  EXPECT_EQ(away.exit_status, 1);
  const json object = json::parse(away.out);
  EXPECT_EQ(object["status"], "invalid_posture");
  EXPECT_EQ(object["ik_solutions"]["valid"], 0);
  EXPECT_EQ(object["ik_solutions"]["unreachable"], 1);
  EXPECT_TRUE(object["h_2"].is_null());
  // A search counts over all its evaluations.
  const json best =
      json::parse(run_maxwrench("solve dual_arm/bar_wall --budget 300 --search grid --json").out);
  EXPECT_EQ(best["status"], "best_found");
  EXPECT_EQ(best["theta_r"].size(), 2);
  EXPECT_EQ(best["h_2"].size(), 6);
  EXPECT_GT(best["ik_solutions"]["valid"], 10);
  EXPECT_GT(best["ik_solutions"]["collision"], 10);
}

/// Only the direction of c counts.
TEST(Command, EvalTakesAnyLengthOfC) {
  EditedCopy copy;
  copy.replace("force.toml", "c = [1, 0, 0, 0, 0, 0]", "c = [1e200, 0, 0, 0, 0, 0]");
  const auto beta = [&](const std::string& problem) {
    return json::parse(run_maxwrench("eval " + problem + " --json", copy.path()).out)["beta"];
  };
  EXPECT_EQ(beta("force.toml"), beta("planar/force"));
}

TEST(Command, SolveSaysThatTheSecondArmDoesNotReach) {
  EditedCopy copy;
  copy.replace("two_arms.toml", "xyz = [-0.02, -0.25, 0]", "xyz = [-0.02, -25, 0]");
  const CommandResult result = run_maxwrench("solve two_arms.toml --budget 50", copy.path());
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.out.find("postures: 0 valid"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("none_found: nothing that was evaluated has a value"),
            std::string::npos)
      << result.out;
}

TEST(Command, EvalPrintsOneObjectWithEverything) {
  const CommandResult result = run_maxwrench(
      "eval planar/force --theta-r 0.3,-0.7 --measure linf_polytope --wrench any --solver simplex "
      "--json");
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const json object = json::parse(result.out);
  for (const char* key :
       {"beta_linf", "beta_linf_unit", "problem",     "measure",   "wrench", "solver",
        "search",    "seed",           "status",      "reason",    "beta",   "unit",
        "theta_r",   "theta",          "w",           "h",         "u",      "lambda",
        "gradient",  "residual",       "evaluations", "undecided", "wall_s", "version"}) {
    EXPECT_TRUE(object.contains(key)) << key;
  }
  EXPECT_EQ(object["status"], "optimal");
  EXPECT_TRUE(object["search"].is_null());
  EXPECT_NEAR(object["theta"]["rpy"][2], 10 * M_PI / 180 + 0.4, 1e-12);
  EXPECT_EQ(object["h"].size(), 6U);
  EXPECT_EQ(object["u"].size(), 6U);
  EXPECT_LT(object["residual"]["balance"], 1e-9);
  EXPECT_NEAR(object["beta"], object["h"][0], 1e-12);
}

/// 240 more thrusters without thrust change nothing but the number of facets.
void add_idle_thrusters(EditedCopy& copy) {
  std::string thrusters;
  for (int i = 0; i < 240; ++i) {
    thrusters += "[[thrusters.list]]\nname = \"idle_" + std::to_string(i) +
                 "\"\nposition = [0, 0, 0]\ndirection = [" + std::to_string(i + 1) +
                 ", 7, 0]\nforce_min = 0\nforce_max = 0\n\n";
  }
  copy.replace("vehicle.toml", "[end_effectors.tool]", thrusters + "[end_effectors.tool]");
}

TEST(Command, BoxTakesOverWhereThereAreTooManyFacets) {
  EditedCopy copy;
  add_idle_thrusters(copy);
  const CommandResult few = run_maxwrench("eval planar/force --theta-r 0.3,-0.7 --json");
  const CommandResult many =
      run_maxwrench("eval force.toml --theta-r 0.3,-0.7 --json", copy.path());
  ASSERT_EQ(many.exit_status, 0) << many.err;
  // A request for facets is rejected, not answered by another solver.
  const CommandResult asked =
      run_maxwrench("eval force.toml --theta-r 0.3,-0.7 --solver facets", copy.path());
  EXPECT_EQ(asked.exit_status, 2);
  EXPECT_NE(asked.err.find("too many facets"), std::string::npos) << asked.err;
  const json a = json::parse(few.out), b = json::parse(many.out);
  EXPECT_EQ(a["solver"], "facets");
  EXPECT_EQ(b["solver"], "condensed");
  EXPECT_NEAR(a["beta"], b["beta"], 1e-9);
}

/// Whatever evaluates chooses the solver that supports the robot.
TEST(Command, WriteAndCompareTakeBoxWhereThereAreTooManyFacets) {
  EditedCopy copy;
  add_idle_thrusters(copy);
  const CommandResult eval = run_maxwrench("eval force.toml --json --write p.mps", copy.path());
  ASSERT_EQ(eval.exit_status, 0) << eval.err;
  const json program = json::parse(run_maxwrench("lp p.mps --json", copy.path()).out);
  EXPECT_NEAR(program["objective"], json::parse(eval.out)["beta"], 1e-9);
  const CommandResult compare =
      run_maxwrench("compare force.toml --budget 50 --seeds 1 --out .", copy.path());
  EXPECT_EQ(compare.exit_status, 0) << compare.err;
  EXPECT_NE(compare.out.find("\ngrid                condensed     "), std::string::npos)
      << compare.out;
}

TEST(Command, RunTakesTaskFiles) {
  const EditedCopy copy;
  std::filesystem::create_directory(copy.path() / "a=b");
  std::filesystem::rename(copy.path() / "force.toml", copy.path() / "a=b" / "force.toml");
  std::filesystem::rename(copy.path() / "vehicle.toml", copy.path() / "a=b" / "vehicle.toml");
  std::filesystem::rename(copy.path() / "vehicle.urdf", copy.path() / "a=b" / "vehicle.urdf");
  const CommandResult result = run_maxwrench(
      "run a=b/force.toml two_arms.toml measure=ellipsoid search=grid wrench=pure budget=9 --out .",
      copy.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const std::string values = read_table(copy.path() / "values.csv");
  EXPECT_EQ(std::count(values.begin(), values.end(), '\n'), 3) << values;
  EXPECT_NE(values.find("\na=b/force.toml,ellipsoid,pure,none,grid,1,9,"), std::string::npos);
  EXPECT_NE(values.find("\ntwo_arms.toml,ellipsoid,pure,none,grid,1,9,"), std::string::npos);
  const CommandResult none = run_maxwrench("run two_arms.toml measure=foo --out .", copy.path());
  EXPECT_EQ(none.exit_status, 2);
  for (const MeasureEntry& measure : measures()) {
    // Those of accelerations do not support a second contact.
    EXPECT_EQ(none.err.find(measure.name) == std::string::npos, measure.acceleration) << none.err;
  }
}

TEST(Command, CheckAndListDescribeTasksInTime) {
  const CommandResult jet = run_maxwrench("check uvms/jet_trajectory");
  EXPECT_EQ(jet.exit_status, 0) << jet.err;
  for (const char* part :
       {"trajectory of 10 s, 10 knots of theta_r, scheme spline, 4 instants per interval",
        "path from [0, 0, 0] m", "turned by 1.5708 rad", "c turns with the end effector"}) {
    EXPECT_NE(jet.out.find(part), std::string::npos) << part << jet.out;
  }
  const CommandResult impulse = run_maxwrench("check uvms/lift_impulse");
  for (const char* part : {"impulse of 2.5 s, 4 knots", "peak at knot 3, start static at"})
    EXPECT_NE(impulse.out.find(part), std::string::npos) << part << impulse.out;
  EXPECT_NE(run_maxwrench("list").out.find("impulse of 2.5 s, redundancy 4"), std::string::npos);
}

/// Tasks in time take much longer: they are left out unless they are named.
TEST(Command, RunTakesAllStaticTasks) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "run measure=manipulability search=grid wrench=pure budget=5 --out .", folder.path());
  EXPECT_LT(result.exit_status, 2) << result.err;  // not every grid so small has a valid posture
  const std::string values = read_table(folder.path() / "values.csv");
  EXPECT_NE(values.find("\nuvms/valve,"), std::string::npos);
  EXPECT_EQ(values.find("trajectory"), std::string::npos);
  EXPECT_EQ(values.find("impulse"), std::string::npos);
}

/// A table may grow on several machines, so each time says where it was measured.
TEST(Command, TimesSayOnWhichMachine) {
  const TemporaryFolder folder;
  const std::string words = "run planar/force measure=ellipsoid search=grid wrench=pure budget=9 ";
  ASSERT_EQ(run_maxwrench(words + "--out . --threads 2", folder.path()).exit_status, 0);
  std::istringstream times(read_table(folder.path() / "times.csv"));
  std::string header, row;
  ASSERT_TRUE(std::getline(times, header) && std::getline(times, row));
  EXPECT_NE(header.find(",wall_s,us_per_evaluation,cpu_s,threads,machine,build,sources,version"),
            std::string::npos);
  const std::string version = run_maxwrench("--version").out;
  EXPECT_NE(version.find(row.substr(row.rfind(',') + 1)), std::string::npos) << row;
  const std::string machine = read_text(folder.path() / "machine.txt");
  const std::size_t begin = machine.find("processor ") + 10;
  const std::string processor = machine.substr(begin, machine.find('\n', begin) - begin);
  EXPECT_NE(row.find(",1," + processor), std::string::npos) << row;  // each case has one thread
}

/// Two rows fit on the disk, more do not: those two are kept, and the next run goes on.
TEST(Command, RowsThatWereFinishedAreKept) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "limited") << "ulimit -f 4\nexec '" MAXWRENCH_COMMAND "' \"$@\"\n";
  const std::string words = "run planar/force solver=none budget=50 --out .";
  const CommandResult result =
      run_maxwrench("--version > /dev/null; sh limited " + words, folder.path());
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.err.find("File too large"), std::string::npos) << result.err;
  const std::string rows = read_text(folder.path() / "values.csv.part");
  EXPECT_GE(std::count(rows.begin(), rows.end(), '\n'), 2) << rows;
  EXPECT_LE(rows.size(), 4 * 1024);
  const CommandResult next = run_maxwrench(words, folder.path());
  EXPECT_EQ(next.out.find("of them existed before") != std::string::npos, names_sources(version()))
      << next.out << next.err;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

TEST(Command, EveryMeasureHasAValueAtAnOrdinaryPosture) {
  for (const MeasureEntry& measure : measures()) {
    const CommandResult result = run_maxwrench(
        "eval uvms/valve --theta-r 3.0,1.2,1.1,0.4 --json --measure " + std::string(measure.name));
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const json object = json::parse(result.out);
    EXPECT_EQ(object["status"], "optimal") << measure.name;
    EXPECT_EQ(object["gradient"].size(), 4U);
    const char* const of_torque = measure.acceleration ? "rad/s^2" : "N m";
    EXPECT_EQ(object["unit"], measure.unit ? measure.unit : of_torque);
    EXPECT_EQ(object["beta_linf_unit"], "N m");
    EXPECT_GT(object["beta_linf"], 0);
  }
  const json score =
      json::parse(run_maxwrench("eval planar/force --measure manipulability --json").out);
  for (const char* key : {"w", "h", "u"}) EXPECT_TRUE(score[key].is_null()) << key;
}

TEST(Command, ReachAndLimitsAreOtherStatuses) {
  const CommandResult limit = run_maxwrench("eval planar/force --theta-r 2,0 --json");
  EXPECT_EQ(limit.exit_status, 1);
  EXPECT_EQ(json::parse(limit.out)["status"], "invalid_posture");
  EXPECT_TRUE(json::parse(limit.out)["beta"].is_null());
  // A tool out of the vehicle's plane cannot be reached by a base on {x, y, yaw}.
  EditedCopy copy;
  copy.replace("force.toml", "xyz = [0, 0, 0]", "xyz = [0, 0, 1]");
  const CommandResult reach =
      run_maxwrench("eval '" + (copy.path() / "force.toml").string() + "' --json");
  EXPECT_EQ(reach.exit_status, 1);
  EXPECT_NE(std::string(json::parse(reach.out)["reason"]).find("unreachable"), std::string::npos);
}

TEST(Command, SelfCollisionIsReportedAndCanBeIgnored) {
  const std::string folded = "eval planar/force --theta-r=-1.0471,-1.0471";
  EXPECT_EQ(run_maxwrench(folded + " --ignore-collision").exit_status, 0);
  const CommandResult result = run_maxwrench(folded + " --json");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_TRUE(json::parse(result.out)["reason"].get<std::string>().starts_with("self-collision: "));
}

TEST(Command, SLOW_RunWritesTheSameValuesAtAnyThreadCount) {
  std::string first;
  for (const char* threads : {"1", "2", "8"}) {
    const TemporaryFolder folder;
    const CommandResult result =
        run_maxwrench(fmt::format("run problem=planar/force budget={} --out . --threads {}",
                                  std::max(samples(400), 40), threads),
                      folder.path());
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const std::string values = read_table(folder.path() / "values.csv");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "times.csv.gz"));
    EXPECT_GT(std::count(values.begin(), values.end(), '\n'), 20);
    if (first.empty()) first = values;
    EXPECT_EQ(values, first) << threads << " threads";
  }
}

}  // namespace
}  // namespace maxwrench
