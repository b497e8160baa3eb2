#include "benchmarks/race_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "benchmarks/case_file.h"

namespace maxwrench {
namespace {

using Rows = std::vector<std::size_t>;

std::vector<std::string> race_file_columns(std::vector<std::string> more, const char* what) {
  for (const char* target : kTargetNames) more.push_back(fmt::format("{}_to_{}", what, target));
  more.emplace_back(what);
  return with_case_columns(more);
}

/// The attempt of a row of values and that of times.
Attempt attempt_of(const CsvFile& values, std::size_t row, const CsvFile& times,
                   std::size_t time_row, double best) {
  Attempt attempt;
  attempt.choice = case_of(values, row);
  attempt.value = values.number(row, "beta").value_or(-kInfinity);
  attempt.continuous = values.number(row, "continuous").value_or(attempt.continuous);
  attempt.run.spent = {values.number(row, "evaluations").value_or(0),
                       times.number(time_row, "seconds").value_or(0)};
  for (std::size_t i = 0; i < kTargetShares.size(); ++i) {
    const auto evaluations = values.number(row, fmt::format("evaluations_to_{}", kTargetNames[i]));
    const auto seconds = times.number(time_row, fmt::format("seconds_to_{}", kTargetNames[i]));
    if (!evaluations || !seconds) continue;
    attempt.run.rises.push_back({{*evaluations, *seconds}, target_below(best, kTargetShares[i])});
  }
  return attempt;
}

/// The solver that most rows have.
std::string usual_solver(const CsvFile& values, const Rows& rows) {
  std::map<std::string, int> counts;
  for (const std::size_t row : rows) ++counts[values.text(row, "lp")];
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// The searches of a table of one solver: the default is the one that has stages, in time the first
/// of the searches of plans.
std::string default_of(const Comparison& comparison) {
  for (const Contender& contender : comparison.contenders) {
    if (contender.search.find('+') != std::string::npos) return contender.search;
  }
  return comparison.in_time ? "slp" : "";
}

Comparison comparison_of(const CsvFile& values, const Rows& rows, const CsvFile& times,
                         const std::map<std::vector<std::string>, std::size_t>& time_rows) {
  const std::size_t first = rows.front();
  Comparison comparison{values.text(first, "problem"),
                        values.text(first, "unit"),
                        {},
                        {},
                        "",
                        !values.text(first, "scheme").empty(),
                        0};
  const double best = values.number(first, "best_known").value_or(-kInfinity);
  if (values.text(first, "proven") == "yes") comparison.proven = best;
  const std::string usual = usual_solver(values, rows);
  for (const std::size_t row : rows) {
    const Case c = case_of(values, row);
    const auto time = time_rows.find(case_values(c));
    if (time == time_rows.end()) {
      values.refuse(row, "search", "a row of the same case in search_times.csv");
    }
    auto& group = c.lp == usual ? comparison.contenders : comparison.peers;
    auto contender = std::find_if(group.begin(), group.end(), [&](const Contender& each) {
      return each.search == c.search && each.lp == c.lp;
    });
    if (contender == group.end()) {
      contender = group.insert(group.end(), Contender{c.search, c.lp, c.budget, {}});
    }
    contender->attempts.push_back(attempt_of(values, row, times, time->second, best));
    comparison.budget = std::max(comparison.budget, c.budget);
  }
  comparison.default_search = default_of(comparison);
  return comparison;
}

}  // namespace

std::vector<Comparison> read_races(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "search_comparison.csv";
  if (!std::filesystem::exists(file)) return {};
  const CsvFile values = read_csv(
      file,
      race_file_columns({"beta", "continuous", "unit", "best_known", "proven"}, "evaluations"));
  const CsvFile times = read_csv(folder / "search_times.csv", race_file_columns({}, "seconds"));
  rows_of_cases(values);  // each once
  const auto time_rows = rows_of_cases(times);
  using Race = std::tuple<std::string, std::string, std::string, std::string>;
  std::map<Race, Rows> races;
  for (std::size_t i = 0; i < values.rows.size(); ++i) {
    races[{values.text(i, "problem"), values.text(i, "measure"), values.text(i, "wrench"),
           values.text(i, "scheme")}]
        .push_back(i);
  }
  std::vector<Comparison> comparisons;
  for (const auto& [race, rows] : races) {
    comparisons.push_back(comparison_of(values, rows, times, time_rows));
  }
  return comparisons;
}

}  // namespace maxwrench
