#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "maxwrench/strategies.h"
#include "tests/support/edited_copy.h"
#include "tests/support/support.h"
#include "tests/support/table.h"

namespace maxwrench {
namespace {

using nlohmann::json;

/// What solve writes is what it says, and eval agrees.
TEST(TrajectorySolve, WritesTheTableThatItFound) {
  const TemporaryFolder folder;
  const CommandResult result = run_maxwrench(
      "solve planar/trajectory --budget 300 --seed 2 --json --out t/best.csv", folder.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json best = json::parse(result.out);
  EXPECT_EQ(best["status"], "best_found");
  EXPECT_EQ(best["seed"], 2);
  EXPECT_EQ(best["search"], "slp");
  EXPECT_LE(best["evaluations"], 300);
  const json start = json::parse(run_maxwrench("eval planar/trajectory --json").out);
  EXPECT_GE(best["value"], start["value"]);
  const CommandResult again =
      run_maxwrench("eval planar/trajectory --json --theta-r t/best.csv", folder.path());
  const json trajectory = json::parse(again.out);
  EXPECT_EQ(trajectory["status"], "optimal");
  EXPECT_EQ(trajectory["theta_r"], best["theta_r"]);
  EXPECT_EQ(trajectory["value"], best["value"]);
  EXPECT_EQ(trajectory["value_between_knots"], best["value_between_knots"]);
  const std::string table = read_text(folder.path() / "t/best.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), trajectory["task"]["k"].get<int>() + 1);
  EXPECT_NE(run_maxwrench("solve planar/trajectory --budget 30").out.find("\nbest_found\n"),
            std::string::npos);
}

TEST(TrajectorySolve, IsTheSameAtAnyThreadCount) {
  std::string first;
  for (const char* threads : {"1", "2", "8"}) {
    json trajectory =
        json::parse(run_maxwrench("solve planar/trajectory --budget 200 --json --threads " +
                                  std::string(threads))
                        .out);
    trajectory.erase("wall_s");
    if (first.empty()) first = trajectory.dump();
    EXPECT_EQ(trajectory.dump(), first) << threads;
  }
}

/// A static task is a trajectory of one knot for a trajectory search; what it finds is a posture
/// like any other, which `eval` confirms, and no worse than that of a search of postures.
TEST(TrajectorySolve, SupportsAStaticTaskToo) {
  for (const char* wrench : {"pure", "any"}) {
    const std::string words = "solve uvms/lift --json --wrench " + std::string(wrench);
    json first;
    for (const char* threads : {"1", "8"}) {
      const CommandResult result = run_maxwrench(words + " --search slp --threads " + threads);
      ASSERT_EQ(result.exit_status, 0) << result.err;
      json best = json::parse(result.out);
      best.erase("wall_s");
      if (first.is_null()) first = best;
      EXPECT_EQ(best, first);
    }
    EXPECT_EQ(first["status"], "best_found");
    EXPECT_EQ(first["search"], "slp");
    EXPECT_EQ(first["solver"], wrench == std::string("pure") ? "facets" : "condensed");
    EXPECT_LE(first["evaluations"], 20000);
    std::string theta_r;
    for (const json& angle : first["theta_r"])
      theta_r += (theta_r.empty() ? "" : ",") + angle.dump();
    const json again = json::parse(run_maxwrench("eval uvms/lift --json --wrench " +
                                                 std::string(wrench) + " --theta-r=" + theta_r)
                                       .out);
    EXPECT_EQ(again["status"], "optimal");
    EXPECT_EQ(again["beta"], first["beta"]);
    const json other = json::parse(run_maxwrench(words + " --search crs2").out);
    EXPECT_GE(first["beta"].get<double>(), 0.999 * other["beta"].get<double>());
  }
}

/// On the way are programs in whose restoration phase Ipopt, with the corrector of Mehrotra,
/// follows a null pointer.
TEST(TrajectorySolve, SLOW_IpoptSurvivesItsRestoration) {
  const std::string words =
      "solve planar/trajectory --search annealing --budget 40 --json --solver ";
  const CommandResult ipopt = run_maxwrench(words + "ipopt");
  ASSERT_EQ(ipopt.exit_status, 0) << ipopt.err;
  const CommandResult clp = run_maxwrench(words + "clp");
  EXPECT_NEAR(json::parse(ipopt.out)["value"], json::parse(clp.out)["value"], 1e-6);
}

/// Of the product, what the words choose; a scheme of its own each.
TEST(TrajectoryRun, WritesTheSameValuesAtAnyThreadCount) {
  std::string first;
  for (const char* threads : {"1", "2", "8"}) {
    const TemporaryFolder folder;
    const CommandResult result = run_maxwrench(
        "run planar/trajectory search=slp solver=ipm wrench=pure budget=60 --out . --threads " +
            std::string(threads),
        folder.path());
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const std::string values = read_table(folder.path() / "values.csv");
    EXPECT_EQ(std::count(values.begin(), values.end(), '\n'), 4) << values;
    for (const char* scheme : {"forward", "ends", "spline"}) {
      EXPECT_NE(values.find(",60," + std::string(scheme) + ",,best_found,"), std::string::npos);
    }
    if (first.empty()) first = values;
    EXPECT_EQ(values, first) << threads << " threads";
  }
}

TEST(TrajectoryCompare, RacesEverySearchOfTrajectories) {
  std::string first;
  for (int run = 0; run < 2; ++run) {
    const TemporaryFolder folder;
    const CommandResult result = run_maxwrench(
        "compare planar/trajectory --scheme ends --budget 20 --seeds 1 --out .", folder.path());
    ASSERT_EQ(result.exit_status, 0) << result.err;
    for (const auto& table : {trajectory_searches(), searches()}) {
      for (const SearchEntry& search : table) {
        EXPECT_NE(result.out.find("\n" + std::string(search.name)), std::string::npos);
      }
    }
    const std::string values = read_table(folder.path() / "search_comparison.csv");
    EXPECT_NE(values.find(",slp,1,20,ends,"), std::string::npos) << values;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "trajectory_comparison.svg"));
    if (run == 0) first = values;
    EXPECT_EQ(values, first);
  }
}

/// Its poses are an input too.
TEST(TrajectorySolve, DoesNotReplaceThePath) {
  EditedCopy copy;
  const std::string poses = "0,0,0,0,0,0,0\n1,0.1,0,0,0,0,0\n2,0.1,0.1,0,0,0,0\n";
  std::ofstream(copy.path() / "poses.csv") << poses;
  std::string text = read_text(copy.path() / "trajectory.toml");
  for (const char* block : {"[pose]", "[path]"}) {
    const std::size_t begin = text.find(block), end = text.find("\n[", begin);
    text.erase(begin, end - begin + 1);
  }
  text += "\n[path]\nkind = \"poses\"\nfile = \"poses.csv\"\n";
  const std::size_t T = text.find("\nT = ") + 1;
  std::ofstream(copy.path() / "own.toml") << text.erase(T, text.find('\n', T) - T + 1);
  ASSERT_LT(run_maxwrench("eval own.toml", copy.path()).exit_status, 2)
      << run_maxwrench("eval own.toml", copy.path()).err;
  for (const char* words :
       {"solve own.toml --budget 9 --out ./poses.csv", "eval own.toml --write poses.csv",
        "plot own.toml --out poses.csv", "simulate own.toml --figure poses.csv",
        "view own.toml --budget 9 --out poses.csv"}) {
    const CommandResult result = run_maxwrench(words, copy.path());
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_NE(result.err.find("which is also the file of path.file"), std::string::npos)
        << result.err;
  }
  EXPECT_EQ(read_text(copy.path() / "poses.csv"), poses);
}

}  // namespace
}  // namespace maxwrench
