#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "benchmarks/suite/journal.h"
#include "benchmarks/tables/case_file.h"
#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/table.h"
#include "cli/suite/row_writer.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"
#include "solvers/solve/row.h"
#include "tests/support/edited_copy.h"
#include "tests/support/support.h"
#include "tests/support/table.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

const std::string kSmallSuite = fmt::format(R"(
[[product]]
problem = ["planar/force", "dual_arm/bar_wall"]
wrench = "all"
solver = "all"
search = ["sample", "crs2+cmaes"]
seeds = 2
budget = {}
[[product]]
problem = "planar/trajectory"
search = ["sample", "slp"]
budget = 20
)",
                                            samples(200));

class RunSuite : public testing::Test {
 protected:
  RunSuite() { std::ofstream(folder_.path() / "suite.toml") << kSmallSuite; }
  CommandResult run(const std::string& words) {
    return run_maxwrench("run suite.toml " + words, folder_.path());
  }
  std::string read(const std::string& file) const { return read_text(folder_.path() / file); }
  std::string table(const std::string& file) const { return read_table(folder_.path() / file); }
  /// What one thread writes without being disturbed.
  std::string undisturbed() {
    EXPECT_LT(run("--threads 1 --out one").exit_status, 2);  // 1: a row has no value
    return table("one/values.csv");
  }

  TemporaryFolder folder_;
};

TEST_F(RunSuite, SLOW_GivesTheSameValuesAtAnyThreadCount) {
  const std::string one = undisturbed();
  for (const char* threads : {"2", "8"}) {
    if (kSanitized && threads == std::string("8")) continue;
    ASSERT_LT(run(fmt::format("--threads {} --out {}", threads, threads)).exit_status, 2);
    EXPECT_EQ(table(threads + std::string("/values.csv")), one);
    EXPECT_EQ(read(threads + std::string("/values.csv.gz")), read("one/values.csv.gz"));
  }
}

TEST_F(RunSuite, SLOW_GoesOnAfterItWasKilled) {
  const std::string one = undisturbed();
  bool had_rows = false;
  for (int kill = 0; kill < 10; ++kill) {
    run_maxwrench(fmt::format("--version > /dev/null; timeout -s KILL {:.2f} '" MAXWRENCH_COMMAND
                              "' run suite.toml --threads 2 --out killed",
                              0.03 * std::pow(1.6, kill)),
                  folder_.path());
    const std::string rows = read("killed/values.csv.part");
    had_rows |= std::count(rows.begin(), rows.end(), '\n') > 1;
  }
  EXPECT_TRUE(had_rows);
  EXPECT_LT(run("--out killed").exit_status, 2);
  EXPECT_EQ(table("killed/values.csv"), one);
  EXPECT_FALSE(fs::exists(folder_.path() / "killed/values.csv.part"));
}

TEST_F(RunSuite, AFolderHasOneRunAtATime) {
  const std::string one = undisturbed();
  Table held(folder_.path() / "one/values.csv", value_columns(), case_columns().size());
  held.hold();
  fs::remove(folder_.path() / "one/suite.toml");
  const CommandResult second = run("--again --out one");
  EXPECT_EQ(second.exit_status, 2);
  EXPECT_EQ(std::count(second.err.begin(), second.err.end(), '\n'), 1) << second.err;
  EXPECT_NE(second.err.find("values.csv.part"), std::string::npos) << second.err;
  EXPECT_FALSE(fs::exists(folder_.path() / "one/suite.toml"));
  EXPECT_EQ(table("one/values.csv"), one);
}

bool keeps_rows() { return names_sources(version()); }

/// A torn line is no row; what is whole is not computed again, unless the sources were changed.
TEST_F(RunSuite, SLOW_KeepsTheRowsOfAJournal) {
  const std::string one = undisturbed();
  fs::remove(folder_.path() / "one/values.csv.gz");
  std::ofstream(folder_.path() / "one/values.csv.part") << one.substr(0, one.size() - 5);
  const auto rows = std::count(one.begin(), one.end(), '\n') - 1;
  const CommandResult dry = run("--dry --out one");
  EXPECT_NE(dry.out.find(fmt::format("{} rows, {} of them to run", rows, keeps_rows() ? 1 : rows)),
            std::string::npos)
      << dry.out;
  EXPECT_EQ(dry.err.find("computed again") == std::string::npos, keeps_rows());
  const std::string more = run("--out one").out;
  EXPECT_EQ(more.find(fmt::format(", {} of them existed before", rows - 1)) != std::string::npos,
            keeps_rows())
      << more;
  EXPECT_EQ(table("one/values.csv"), one);
  EXPECT_EQ(run("--again --out one").out, fmt::format("{} rows in one/values.csv.gz\n", rows));
  EXPECT_EQ(table("one/values.csv"), one);
}

TEST_F(RunSuite, SLOW_ShardsMergeToOneRun) {
  const std::string one = undisturbed();
  for (const char* index : {"1", "2", "3"}) {
    ASSERT_LT(run(fmt::format("--shard {0}/3 --out part{0}", index)).exit_status, 2);
  }
  const CommandResult merged = run_maxwrench("merge all part3 part1 part2", folder_.path());
  ASSERT_EQ(merged.exit_status, 0) << merged.err;
  EXPECT_EQ(read("all/values.csv.gz"), read("one/values.csv.gz"));
  EXPECT_EQ(read("all/suite.toml"), kSmallSuite);
  const CommandResult less = run_maxwrench("merge less part3 part1", folder_.path());
  const auto rows = std::count(one.begin(), one.end(), '\n') - 1;
  EXPECT_EQ(less.out.find(fmt::format("{} rows", rows)), std::string::npos) << less.out;
  EXPECT_EQ(run("--dry --out less").out.find(", 0 of them to run"), std::string::npos);
  EXPECT_NE(run("--dry --out all")
                .out.find(fmt::format("{} rows, {} of them to run", rows, keeps_rows() ? 0 : rows)),
            std::string::npos);
  const std::string times = table("all/times.csv");
  EXPECT_EQ(std::count(times.begin(), times.end(), '\n'), std::count(one.begin(), one.end(), '\n'));
}

/// Rows are of the files of their task and of one version; ".dirty" is none, nor is what no commit
/// is known of.
TEST_F(RunSuite, RowsOfEditedTasksAndOtherVersionsAreNotThere) {
  EditedCopy robot;
  const std::string task = robot.path() / "force.toml";
  std::ofstream(folder_.path() / "suite.toml")
      << "[[product]]\nproblem = '" << task << "'\nsearch = 'sample'\nbudget = 20\n";
  ASSERT_EQ(run("--out one").exit_status, 0);
  const fs::path one = folder_.path() / "one";
  const CsvFile csv = read_csv(one / "values.csv.gz", value_columns());
  const Case c = case_of(csv, 0);
  const Problem problem = load_problem(task);
  EXPECT_EQ(RowsThere(one).has(problem, c), keeps_rows());
  EXPECT_FALSE(RowsThere(one, "another").has(problem, c));
  for (const auto& [kept, known] :
       {std::pair{"1.0.dirty", false}, {"1.0+unknown", false}, {"1.0", true}}) {
    std::string times = table("one/times.csv");
    const std::size_t comma = times.rfind(',');
    std::ofstream(one / "times.csv.gz") << times.replace(comma + 1, times.size(), kept) << '\n';
    EXPECT_EQ(RowsThere(one, kept).has(problem, c), known) << kept;
  }
  for (const char* file : {"force.toml", "vehicle.toml", "vehicle.urdf"}) {
    std::ofstream(robot.path() / file, std::ios::app) << " \n";
    EXPECT_FALSE(RowsThere(one, "1.0").has(load_problem(task), c)) << file;
    fs::resize_file(robot.path() / file, fs::file_size(robot.path() / file) - 2);
    EXPECT_TRUE(RowsThere(one, "1.0").has(load_problem(task), c)) << file;
  }
}

TEST_F(RunSuite, ContradictionsAreNotMerged) {
  ASSERT_LT(run("--out one").exit_status, 2);
  fs::copy(folder_.path() / "one", folder_.path() / "two");
  std::string changed = table("two/values.csv");
  changed.replace(changed.find(",best_found,") + 12, 1, "9");
  std::ofstream(folder_.path() / "two/values.csv.gz") << changed;
  const CommandResult result = run_maxwrench("merge all one two", folder_.path());
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.err.find("two/values.csv.gz: got a row of dual_arm/bar_wall,"),
            std::string::npos)
      << result.err;
  EXPECT_TRUE(fs::is_empty(folder_.path() / "all"));
  EXPECT_EQ(run_maxwrench("merge all nowhere", folder_.path()).exit_status, 2);
  for (const char* journal : {"one/values.csv.part", "one/times.csv.part"}) {
    const Journal held(folder_.path() / journal);
    const CommandResult early = run_maxwrench("merge all one", folder_.path());
    EXPECT_EQ(early.exit_status, 2);
    EXPECT_EQ(
        early.err.find(fmt::format("maxwrench: {}: got a file that is being written", journal)), 0U)
        << early.err;
  }
}

TEST_F(RunSuite, CountsAndNamesItsRows) {
  const std::string commands = run("--commands").out;
  const auto rows = std::count(commands.begin(), commands.end(), '\n');
  EXPECT_NE(run("--dry").out.find(fmt::format("{} rows, {} of them to run", rows, rows)),
            std::string::npos);
  const std::string one = undisturbed();
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n') - 1, rows);
  const std::string first = commands.substr(10, commands.find('\n') - 10);  // after "maxwrench "
  const CommandResult again = run_maxwrench(first + " --json");
  EXPECT_EQ(again.exit_status, 0) << again.err;
  const std::size_t row = one.find('\n') + 1;
  const std::size_t beta = again.out.find("\"beta\":") + 7;
  EXPECT_NE(one.substr(row, one.find('\n', row) - row).find(again.out.substr(beta, 12)),
            std::string::npos)
      << again.out;
}

/// Experiments of a static task and of one in time: the same rows on two threads, and the reading
/// of the command that stands for each.
TEST_F(RunSuite, SLOW_CarriesOutExperiments) {
  std::ofstream(folder_.path() / "suite.toml")
      << "[[product]]\nproblem = ['uvms/lift', 'uvms/lift_impulse']\nintegrator = 'cvode'\n";
  ASSERT_EQ(run("--threads 1 --out one").exit_status, 0);
  ASSERT_EQ(run("--threads 2 --out two").exit_status, 0);
  EXPECT_EQ(read("one/values.csv.gz"), read("two/values.csv.gz"));
  const CsvFile csv = read_csv(folder_.path() / "one/values.csv.gz", value_columns());
  ASSERT_EQ(csv.rows.size(), 2U);
  std::istringstream commands(run("--commands").out);
  const char* const readings[] = {"mean", "at_t_h"};
  for (std::size_t i = 0; i < 2; ++i) {
    std::string command;
    std::getline(commands, command);
    ASSERT_TRUE(command.starts_with("maxwrench simulate ")) << command;
    const auto said = nlohmann::json::parse(run_maxwrench(command.substr(10) + " --json").out);
    EXPECT_EQ(said[readings[i]], csv.number(i, "beta")) << command;
    EXPECT_EQ(said["planned"], csv.number(i, "beta_linf")) << command;
  }
  const CommandResult report = run_maxwrench("report one", folder_.path());
  EXPECT_NE(report.out.find("Experiments in the virtual tank"), std::string::npos);
  EXPECT_EQ(run_maxwrench("verify one/values.csv.gz", folder_.path()).exit_status, 0);
}

TEST_F(RunSuite, BadWordsAreRejected) {
  for (const char* words : {"seed=1", "--shard 0/3", "--shard 4/3", "--shard 1", "--shard a/b"}) {
    const CommandResult result = run(words);
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace maxwrench
