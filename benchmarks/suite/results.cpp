#include "benchmarks/suite/results.h"

#include <map>

#include "benchmarks/race/race_file.h"
#include "benchmarks/tables/case_file.h"
#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/write_file.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

/// Microseconds of an evaluation for each case of a table of times. Counts the rows of each
/// version.
std::map<std::vector<std::string>, double> read_times(const std::filesystem::path& file,
                                                      std::map<std::string, long>& versions) {
  std::map<std::vector<std::string>, double> us;
  if (!std::filesystem::exists(file)) return us;
  const CsvFile csv = read_csv(file, with_case_columns({"evaluations"}), {"cpu_s", "version"});
  if (!csv.has("cpu_s")) return us;  // from an earlier version
  for (const auto& [key, i] : rows_of_cases(csv)) {
    if (csv.has("version")) ++versions[csv.text(i, "version")];
    const auto evaluations = csv.number(i, "evaluations");
    const auto seconds = csv.number(i, "cpu_s");
    if (!evaluations || !seconds || *evaluations == 0) continue;
    if (*evaluations < 0) csv.throw_bad_cell(i, "evaluations", "a number of 0 or more");
    if (*seconds <= 0) csv.throw_bad_cell(i, "cpu_s", "a number above 0");
    us[key] = 1e6 * *seconds / *evaluations;
  }
  return us;
}

ResultRow row_of(const CsvFile& csv, std::size_t i) {
  ResultRow row;
  row.choice = case_of(csv, i);
  row.status = csv.text(i, "status");
  row.unit = csv.text(i, "unit");
  row.reason = csv.text(i, "reason");
  row.beta = csv.number(i, "beta");
  row.beta_linf = csv.number(i, "beta_linf");
  row.evaluations = csv.number(i, "evaluations").value_or(0);
  return row;
}

void read_rows(const std::filesystem::path& folder, Results& results) {
  const CsvFile values =
      read_csv(table_file(folder / "values.csv"),
               with_case_columns({"status", "beta", "unit", "beta_linf", "evaluations", "reason"}));
  const auto us = read_times(table_file(folder / "times.csv"), results.versions);
  rows_of_cases(values);  // each once
  for (std::size_t i = 0; i < values.rows.size(); ++i) {
    ResultRow& row = results.rows.emplace_back(row_of(values, i));
    const auto time = us.find(case_values(row.choice));
    if (time != us.end()) row.us = time->second;
  }
}

}  // namespace

bool ResultRow::solved() const {
  return beta && (status == to_string(Status::kOptimal) ||
                  status == to_string(Status::kBestFound) || status == to_string(Status::kReached));
}

std::optional<double> ResultRow::ms() const {
  return us ? std::optional(1e-3 * *us * evaluations) : std::nullopt;
}

Results read_results(const std::filesystem::path& folder) {
  Results results;
  results.folder = folder;
  results.races = read_races(folder);
  if (results.races.empty() || std::filesystem::exists(table_file(folder / "values.csv"))) {
    read_rows(folder, results);
  }
  results.machine = text_of(folder / "machine.txt");
  results.suite = text_of(folder / "suite.toml");
  return results;
}

}  // namespace maxwrench
