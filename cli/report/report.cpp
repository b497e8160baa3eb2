#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>

#include "benchmarks/suite/results.h"
#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/report/page.h"

namespace maxwrench {
namespace {

/// The most rows of a table that are printed on the terminal.
constexpr std::size_t kMostPrinted = 40;

struct ReportOptions {
  std::vector<std::string> folders;
  bool compare = false;
  std::string out;
};

/// The rest of the line of machine.txt that begins with `start`.
std::string fact_of(const Results& results, const std::string& start) {
  std::istringstream lines(results.machine);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(start + " ")) return line.substr(start.size() + 1);
  }
  return "unknown";
}

/// The number of different names that the rows have in each column that a suite chooses.
std::string extent_of(const std::vector<ResultRow>& rows) {
  std::set<std::string> problems, measures, lps, searches, integrators;
  std::set<std::uint64_t> seeds;
  for (const ResultRow& row : rows) {
    problems.insert(row.choice.problem);
    measures.insert(row.choice.measure);
    if (row.choice.solver != kNoSolver) lps.insert(row.choice.solver);
    if (row.is_experiment()) integrators.insert(row.choice.integrator);
    if (!row.choice.search.empty()) searches.insert(row.choice.search);
    seeds.insert(row.choice.seed);
  }
  const auto failed =
      std::count_if(rows.begin(), rows.end(), [](const ResultRow& row) { return !row.solved(); });
  return fmt::format(
      "{}, {} of them without a value; problems {}, measures {}, lower-level solvers {}, searches "
      "{}, seeds {}, integrators {}",
      rows.size(), failed, problems.size(), measures.size(), lps.size(), searches.size(),
      seeds.size(), integrators.size());
}

/// The versions that made the rows, with their numbers of rows; for a race, the version of the
/// folder.
std::string versions_of(const Results& results) {
  if (results.versions.empty()) return fact_of(results, "maxwrench");
  std::vector<std::string> versions;
  for (const auto& [version, rows] : results.versions) {
    versions.push_back(fmt::format("{} ({} rows)", version, rows));
  }
  return fmt::format("{}", fmt::join(versions, ", "));
}

/// Adds the facts about one folder to the page; `mark` is appended to their names.
void describe(const Results& results, const std::string& mark, PageHead& head) {
  head.facts.emplace_back("folder" + mark, results.folder.string());
  head.facts.emplace_back("version" + mark, versions_of(results));
  head.facts.emplace_back("machine" + mark, fact_of(results, "processor") + ", " +
                                                fact_of(results, "cores") + " cores");
  head.facts.emplace_back("rows" + mark, extent_of(results.rows));
  if (!results.suite.empty()) head.texts.emplace_back("suite" + mark, results.suite);
  if (!results.machine.empty()) head.texts.emplace_back("machine.txt" + mark, results.machine);
}

void write_report(const std::filesystem::path& folder, const std::string& page,
                  const PageHead& head, const std::vector<ReportSection>& sections) {
  for (const ReportSection& section : sections) {
    write_file(folder / (section.table.name + ".csv"), csv_of_table(section.table));
    for (std::size_t i = 0; i < section.figures.size(); ++i) {
      write_file(folder / fmt::format("{}_{}.svg", section.table.name, i + 1), section.figures[i]);
    }
  }
  write_file(folder / page, html_page(head, sections));
  fmt::print("{}\n", (folder / page).string());
}

void print_sections(const std::vector<ReportSection>& sections) {
  for (const ReportSection& section : sections) {
    if (section.printed) fmt::print("{}\n", text_of_table(section.table, kMostPrinted));
  }
}

PageHead head_of(const std::string& title) {
  return {
      title, {{"made", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))}}, {}};
}

void report_folder(const ReportOptions& options) {
  const std::filesystem::path folder(options.folders.front());
  const Results results = read_results(folder);
  PageHead head = head_of("maxwrench: what was measured");
  describe(results, "", head);
  std::vector<ReportSection> sections = run_sections(results);
  const std::vector<ReportSection> race = race_sections(results.races);
  sections.insert(sections.begin() + 2, race.begin(), race.end());
  sections.push_back(dictionary_section());
  print_sections(sections);
  write_report(options.out.empty() ? folder / "report" : std::filesystem::path(options.out),
               "report.html", head, sections);
}

void report_changes(const ReportOptions& options) {
  const Results a = read_results(options.folders[0]), b = read_results(options.folders[1]);
  PageHead head = head_of("maxwrench: what changed");
  describe(a, " a", head);
  describe(b, " b", head);
  std::vector<ReportSection> sections = change_sections(a, b);
  print_sections(sections);
  if (options.out.empty()) return;
  sections.push_back(dictionary_section());
  write_report(options.out, "changes.html", head, sections);
}

int make_report(const ReportOptions& options) {
  const std::size_t expected = options.compare ? 2 : 1;
  if (options.folders.size() != expected) {
    throw std::invalid_argument(
        fmt::format("report: got {} folders, expected {}", options.folders.size(),
                    options.compare ? "two to compare" : "one, or two with --compare"));
  }
  if (options.compare) {
    report_changes(options);
  } else {
    report_folder(options);
  }
  return kAnswered;
}

}  // namespace

void add_report(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App& command = *app.add_subcommand("report",
                                          "writes tables, performance profiles and significance "
                                          "tests of the results of run and compare");
  command.add_option("folders", options->folders, "folder with values.csv.gz; two with --compare")
      ->required();
  command.add_flag(
      "--compare", options->compare,
      "report the changes between two folders: values, times beyond noise, missing rows");
  command
      .add_option("--out", options->out,
                  "folder for report.html and its tables as CSV (default: report in the folder; "
                  "with --compare, none)")
      ->check(reject_empty);
  command.callback([options, &exit_status] { exit_status = make_report(*options); });
}

}  // namespace maxwrench
