#include "benchmarks/results.h"

#include <map>

#include "benchmarks/case_file.h"
#include "benchmarks/csv.h"
#include "benchmarks/race_file.h"
#include "benchmarks/searched.h"
#include "benchmarks/write_file.h"

namespace maxwrench {
namespace {

/// Microseconds of an evaluation by the cases of a table of times.
std::map<std::vector<std::string>, double> read_times(const std::filesystem::path& file) {
  std::map<std::vector<std::string>, double> us;
  if (!std::filesystem::exists(file)) return us;
  const CsvFile csv = read_csv(file, with_case_columns({"evaluations", "wall_s"}), {"cpu_s"});
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto evaluations = csv.number(i, "evaluations");
    const auto wall = csv.number(i, "wall_s");
    const auto cpu = csv.has("cpu_s") ? csv.number(i, "cpu_s") : std::nullopt;
    if (!evaluations || !wall || *evaluations <= 0) continue;
    us[case_values(case_of(csv, i))] = 1e6 * cpu.value_or(*wall) / *evaluations;
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
  row.evaluations = csv.number(i, "evaluations").value_or(0);
  return row;
}

}  // namespace

bool ResultRow::solved() const {
  return beta && (status == to_string(Status::kOptimal) || status == to_string(Status::kBestFound));
}

Results read_results(const std::filesystem::path& folder) {
  Results results;
  results.folder = folder;
  const CsvFile values =
      read_csv(folder / "values.csv",
               with_case_columns({"status", "beta", "unit", "evaluations", "reason"}));
  const auto us = read_times(folder / "times.csv");
  rows_of_cases(values);  // each once
  for (std::size_t i = 0; i < values.rows.size(); ++i) {
    ResultRow& row = results.rows.emplace_back(row_of(values, i));
    const auto time = us.find(case_values(row.choice));
    if (time != us.end()) row.us = time->second;
  }
  results.races = read_races(folder);
  results.machine = text_of(folder / "machine.txt");
  results.plan = text_of(folder / "plan.toml");
  return results;
}

}  // namespace maxwrench
