#include "benchmarks/race/race_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "benchmarks/tables/case_file.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

using Rows = std::vector<std::size_t>;

std::vector<std::string> race_file_columns(std::vector<std::string> more, const char* what) {
  for (const char* target : kTargetNames) more.push_back(fmt::format("{}_to_{}", what, target));
  more.emplace_back(what);
  return with_case_columns(more);
}

/// The cost of a whole attempt.
double spent_of(const CsvFile& csv, std::size_t row, const char* column) {
  const std::optional<double> spent = csv.number(row, column);
  if (!spent || *spent < 0) csv.throw_bad_cell(row, column, "a number of 0 or more");
  return *spent;
}

/// The attempt from a row of values and a row of times.
Attempt attempt_of(const CsvFile& values, std::size_t row, const CsvFile& times,
                   std::size_t time_row, double best) {
  Attempt attempt;
  attempt.choice = case_of(values, row);
  attempt.value = values.number(row, "beta").value_or(-kInfinity);
  attempt.value_between_knots =
      values.number(row, "value_between_knots").value_or(attempt.value_between_knots);
  attempt.run.spent = {spent_of(values, row, "evaluations"), spent_of(times, time_row, "seconds")};
  for (std::size_t i = 0; i < kTargetShares.size(); ++i) {
    const auto evaluations = values.number(row, fmt::format("evaluations_to_{}", kTargetNames[i]));
    const auto seconds = times.number(time_row, fmt::format("seconds_to_{}", kTargetNames[i]));
    if (!evaluations || !seconds) continue;
    attempt.run.rises.push_back({{*evaluations, *seconds}, target_below(best, kTargetShares[i])});
  }
  return attempt;
}

/// The group that an attempt belongs to by its role.
std::vector<Contender>& group_of(const CsvFile& values, std::size_t row, Comparison& comparison) {
  const std::string& role = values.text(row, "role");
  if (role == kPeerRole) return comparison.peers;
  if (role == kDefaultRole) {
    comparison.default_search = values.text(row, "search");
  } else if (role != kContenderRole) {
    values.throw_bad_cell(row, "role",
                          fmt::format("{}, {} or {}", kDefaultRole, kContenderRole, kPeerRole));
  }
  return comparison.contenders;
}

/// Rejects a table that mixes two races.
void require_one_race(const CsvFile& values, const Rows& rows) {
  std::set<std::vector<std::string>> attempts;
  for (const std::size_t row : rows) {
    for (const char* column : {"best_known", "proven"}) {
      if (values.text(row, column) == values.text(rows.front(), column)) continue;
      values.throw_bad_cell(row, column,
                            fmt::format("{} as in line {}, of the same race",
                                        values.text(rows.front(), column), line_of(rows.front())));
    }
    if (!attempts
             .insert(
                 {values.text(row, "search"), values.text(row, "solver"), values.text(row, "seed")})
             .second) {
      values.throw_bad_cell(row, "budget", "one of each search, solver and seed in a race");
    }
  }
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
  require_one_race(values, rows);
  for (const std::size_t row : rows) {
    const Case c = case_of(values, row);
    const auto time = time_rows.find(case_values(c));
    if (time == time_rows.end()) {
      values.throw_bad_cell(row, "search", "a row of the same case in search_times.csv");
    }
    auto& group = group_of(values, row, comparison);
    auto contender = std::find_if(group.begin(), group.end(), [&](const Contender& each) {
      return each.search == c.search && each.solver == c.solver;
    });
    if (contender == group.end()) {
      contender = group.insert(group.end(), Contender{c.search, c.solver, c.budget, {}});
    }
    contender->attempts.push_back(attempt_of(values, row, times, time->second, best));
    comparison.budget = std::max(comparison.budget, c.budget);
  }
  return comparison;
}

}  // namespace

std::vector<Comparison> read_races(const std::filesystem::path& folder) {
  const std::filesystem::path file = table_file(folder / "search_comparison.csv");
  if (!std::filesystem::exists(file)) return {};
  const CsvFile values = read_csv(file, race_file_columns({"beta", "value_between_knots", "unit",
                                                           "best_known", "proven", "role"},
                                                          "evaluations"));
  const CsvFile times =
      read_csv(table_file(folder / "search_times.csv"), race_file_columns({}, "seconds"));
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
