#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/dictionary.h"
#include "cli/report/page.h"
#include "tests/support/support.h"
#include "tests/support/table.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// A run and a race of a few rows, once.
const fs::path& small_run() {
  static const TemporaryFolder kFolder;
  static const bool kRan = [] {
    run_maxwrench("run planar/force wrench=any budget=100 --out run", kFolder.path());
    run_maxwrench("compare planar/force --seeds 2 --budget 100 --out run", kFolder.path());
    return run_maxwrench("run planar/force wrench=any budget=100 --out again", kFolder.path())
               .exit_status < 2;
  }();
  EXPECT_TRUE(kRan);
  return kFolder.path();
}

std::vector<std::string> columns_of(const fs::path& file) {
  std::istringstream in(csv_text(file));
  std::string header;
  EXPECT_TRUE(std::getline(in, header)) << file;
  return split_csv(header);
}

void expect_known_columns(const fs::path& file) {
  for (const std::string& column : columns_of(file)) {
    EXPECT_NE(find_meaning(column), nullptr) << file << ": " << column;
  }
}

TEST(Report, SLOW_EveryColumnIsInTheDictionary) {
  const fs::path out = small_run() / "columns";
  ASSERT_EQ(run_maxwrench("report run --out columns", small_run()).exit_status, 0);
  ASSERT_EQ(run_maxwrench("report --compare run again --out columns", small_run()).exit_status, 0);
  int files = 0;
  for (const fs::path& folder : {small_run() / "run", out}) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename();
      if (!name.ends_with(".csv") && !name.ends_with(".csv.gz")) continue;
      expect_known_columns(entry.path());
      ++files;
    }
  }
  EXPECT_EQ(files, 4 + 13);
  EXPECT_TRUE(fs::exists(out / "report.html"));
  EXPECT_TRUE(fs::exists(out / "solvers_1.svg"));
  EXPECT_TRUE(fs::exists(out / "changes.html"));
}

/// No column stands in the dictionary twice, and none of it is nothing's.
TEST(Report, TheDictionaryIsOne) {
  std::vector<std::string> columns;
  for (const ColumnMeaning& entry : dictionary()) {
    columns.emplace_back(entry.column);
    EXPECT_NE(std::string(entry.meaning), "");
  }
  std::sort(columns.begin(), columns.end());
  EXPECT_EQ(std::adjacent_find(columns.begin(), columns.end()), columns.end());
}

TEST(Report, SLOW_SaysTheSameAgain) {
  const CommandResult first = run_maxwrench("report run --out first", small_run());
  const CommandResult second = run_maxwrench("report run --out second", small_run());
  ASSERT_EQ(first.exit_status, 0) << first.err;
  EXPECT_NE(first.out.find("Lower-level solvers"), std::string::npos);
  const std::string values = read_table(small_run() / "run/values.csv");
  const auto made = fmt::format(" ({} rows)", std::count(values.begin(), values.end(), '\n') - 1);
  EXPECT_NE(read_text(small_run() / "first/report.html").find(made), std::string::npos) << made;
  EXPECT_NE(first.out.find("The race: profiles and significance"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(small_run() / "first")) {
    if (entry.path().extension() != ".csv") continue;
    EXPECT_EQ(read_text(entry.path()), read_text(small_run() / "second" / entry.path().filename()));
  }
}

/// What a table says in `columns` (empty: in all), numbers to six digits: `reproduce` may have run
/// here, on a machine that rounds otherwise.
std::vector<std::vector<std::string>> contents(const fs::path& file,
                                               std::vector<std::string> columns) {
  if (columns.empty()) columns = columns_of(file);
  const CsvFile csv = read_csv(file, columns);
  std::vector<std::vector<std::string>> all;
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    std::vector<std::string>& cells = all.emplace_back();
    for (const std::string& column : columns) {
      const std::string& text = csv.text(row, column);
      double value = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      const bool is_number = error == std::errc() && end == text.data() + text.size();
      cells.push_back(is_number ? fmt::format("{:.6g}", value) : text);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The tables that stand beside our results, which the paper reads, are of these results; times,
/// which `reproduce` measures again for its own rows, are not compared.
TEST(Report, SLOW_TablesOfOurResultsAreOfThem) {
  const fs::path results = fs::path(MAXWRENCH_SOURCE_DIR) / "results";
  const TemporaryFolder folder;
  ASSERT_EQ(run_maxwrench("report " + results.string() + " --out new", folder.path()).exit_status,
            0);
  using Columns = std::vector<std::string>;
  for (const auto& [file, columns] :
       {std::pair{"tasks.csv", Columns{"problem", "measure", "wrench", "scheme", "rows", "solved",
                                       "best", "unit"}},
        {"solvers.csv", {"benchmark_set", "solver", "solved", "instances"}},
        {"searches.csv", {"search", "rows", "solved", "near"}},
        {"failures.csv", {}},
        {"integrators.csv", {"benchmark_set", "integrator", "solved", "instances"}},
        {"experiments.csv",
         {"problem", "wrench", "solver", "scheme", "integrator", "planned", "reading", "unit",
          "evaluations", "reason"}},
        {"dictionary.csv", {}},
        {"race_standings.csv", {}}}) {
    expect_known_columns(results / "report" / file);
    EXPECT_EQ(contents(folder.path() / "new" / file, columns),
              contents(results / "report" / file, columns))
        << file;
  }
}

/// Two runs of the same sources differ in their times at most.
TEST(Report, ComparesFolders) {
  const CommandResult result = run_maxwrench("report --compare run again", small_run());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NE(result.out.find(" are the same, 0 within rounding\nnone\n"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("Rows in only one folder\nnone\n"), std::string::npos);
  std::string changed = read_table(small_run() / "again/values.csv");
  changed.replace(changed.find(",best_found,") + 12, 1, "9");
  fs::create_directories(small_run() / "changed");
  std::ofstream(small_run() / "changed/values.csv") << changed;
  const CommandResult other = run_maxwrench("report --compare run changed", small_run());
  EXPECT_NE(other.out.find(" within rounding\nproblem"), std::string::npos) << other.out;
  EXPECT_NE(other.out.find("Times: ratio of b to a\nnone\n"), std::string::npos);
}

/// Failures are rows with their reason; what a file holds is no markup.
TEST(Report, ListsFailures) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "values.csv")
      << "problem,measure,wrench,solver,search,seed,budget,scheme,integrator,status,beta,unit,"
         "beta_linf,"
         "evaluations,reason\n"
         "f/a,m,pure,facets,s,1,9,,,infeasible,,N,,9,\"<b>\"\"too\"\" weak & old\"\n"
         "f/a,m,pure,facets,s,2,9,,,infeasible,,N,,9,\"<b>\"\"too\"\" weak & old\"\n";
  const CommandResult result = run_maxwrench("report .", folder.path());
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NE(result.out.find("   2  infeasible  <b>\"too\" weak & old  f/a"), std::string::npos)
      << result.out;
  const std::string page = read_text(folder.path() / "report/report.html");
  EXPECT_NE(page.find("<td>&lt;b&gt;&quot;too&quot; weak &amp; old</td>"), std::string::npos);
  EXPECT_EQ(page.find("http://", page.find("<body>")), std::string::npos);  // no figure either
}

TEST(Report, RejectsWhatIsNoResult) {
  const TemporaryFolder folder;
  for (const char* words : {"report nowhere", "report --compare . .", "report . .", "report",
                            "report --compare .", "report . --out ''"}) {
    const CommandResult result = run_maxwrench(words, folder.path());
    EXPECT_EQ(result.exit_status, 2) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "") << words;
  }
  EXPECT_NE(
      run_maxwrench("report nowhere", folder.path()).err.find("nowhere/values.csv.gz: got no"),
      std::string::npos);
}

TEST(Report, TablesForPeopleAndPrograms) {
  const ReportTable table{
      "t", "T", "", {"search", "beta", "us"}, {{"a,b", 1.0 / 3, 1.0 / 3}, {"c", 12.0, NAN}}};
  EXPECT_EQ(csv_of_table(table),
            "search,beta,us\n\"a,b\",0.3333333333333333,0.3333333333333333\nc,12,\n");
  EXPECT_EQ(text_of_table(table, 9),
            "T\n"
            "search        beta      us\n"
            "a,b     0.33333333  0.3333\n"
            "c               12       -\n");
  EXPECT_EQ(text_of_table(table, 0), "T\nsearch  beta  us\nand 2 more\n");
  const std::string html = html_of_table(table, 1);
  EXPECT_NE(html.find("<td>a,b</td><td class=\"n\">0.33333333</td>"), std::string::npos);
  EXPECT_NE(html.find("The first 1 of 2 rows; the rest is in t.csv."), std::string::npos);
  EXPECT_NE(html.find("title=\"[unit] largest value found"), std::string::npos);
}

}  // namespace
}  // namespace maxwrench
