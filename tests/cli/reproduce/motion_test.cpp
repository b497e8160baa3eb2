#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "benchmarks/suite/product.h"
#include "cli/reproduce/reproduce.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "tests/support/support.h"
#include "tests/support/table.h"

namespace maxwrench {
namespace {

constexpr long kSmallBudget = 40;

/// The fields of the lines of a table without line breaks and quotes in what is asked for.
std::vector<std::vector<std::string>> fields(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(read_table(file));
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    auto& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

/// The rows of trajectories that were searched have their tables beside them, whose values they
/// repeat; the table of the paper has the same ones. Returns how many there are. (The folder may
/// have rows of others.)
int expect_trajectories(const std::filesystem::path& folder, const std::string& text, long budget) {
  const auto rows = fields(folder / "values.csv");
  const auto at = [&](const std::vector<std::string>& row, const char* column) {
    const auto& names = rows.front();
    return row.at(
        static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin()));
  };
  int trajectories = 0;
  for (const auto& row : rows) {
    const std::string problem_name = at(row, "problem"), scheme = at(row, "scheme");
    std::string file = problem_name + "_" + scheme + ".csv";
    std::replace(file.begin(), file.end(), '/', '_');
    const bool of_the_table = at(row, "search") == trajectory_searches().front().name &&
                              at(row, "wrench") == "pure" &&
                              at(row, "budget") == std::to_string(budget);
    if (!of_the_table || !std::filesystem::exists(folder / "trajectories" / file)) continue;
    Problem problem = load_problem(problem_name);
    set_scheme("scheme", scheme, problem);
    const Answer trajectory =
        evaluate(problem, load_knots(folder / "trajectories" / file, problem), {});
    EXPECT_TRUE(trajectory.trajectory.collision.empty()) << file;
    EXPECT_NEAR(trajectory.trajectory.value, std::stod(at(row, "beta")), 1e-6) << file;
    EXPECT_NE(text.find(fmt::format("{:>8.2f}", trajectory.trajectory.value)), std::string::npos)
        << file;
    ++trajectories;
  }
  return trajectories;
}

TEST(ReproduceMotion, SLOW_FillsTheTablesAlikeAtAnyThreadCount) {
  std::string first;
  for (const int threads : {1, 2}) {
    const TemporaryFolder folder;
    const PaperTable table = reproduce_motion(folder.path(), threads, kSmallBudget);
    EXPECT_TRUE(table.all_solved);
    EXPECT_EQ(table.text, read_text(folder.path() / "uvms_motion.txt"));
    if (first.empty()) first = table.text;
    EXPECT_EQ(table.text, first);
    EXPECT_EQ(expect_trajectories(folder.path(), table.text, kSmallBudget), 6);
    for (const char* task : {"uvms_valve_trajectory", "uvms_valve_impulse"}) {
      for (const char* figure : {".svg", "_postures.svg", "_stills.svg"}) {
        EXPECT_TRUE(std::filesystem::exists(folder.path() / (std::string(task) + figure)));
      }
    }
  }
  EXPECT_EQ(first.find("nan"), std::string::npos) << first;
  EXPECT_EQ(first.find("-0.000"), std::string::npos) << first;
}

TEST(ReproduceMotion, ShippedTrajectoriesAreWorthWhatTheirRowsSay) {
  const std::filesystem::path results(MAXWRENCH_SOURCE_DIR "/results");
  EXPECT_EQ(expect_trajectories(results, read_text(results / "uvms_motion.txt"), kTrajectoryBudget),
            6);
}

}  // namespace
}  // namespace maxwrench
