#include <fmt/format.h>

#include <cmath>

#include "benchmarks/report/differences.h"
#include "benchmarks/tables/dictionary.h"
#include "cli/report/sections.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

ReportSection value_section(const Differences& changes) {
  ReportTable table;
  table.name = "changed_values";
  table.title = fmt::format("Values that differ; {} are the same, {} within rounding", changes.same,
                            changes.rounded);
  table.note = fmt::format(
      "Rows that differ in status or by more than {:g} of 1 + |beta|; experiments that differ by "
      "more than {:g}, or in whether they held (they did if they have no reason). Smaller "
      "differences are within rounding.",
      kSameValue, kSameReading);
  table.columns = case_columns();
  table.columns.insert(table.columns.end(), {"status_a", "status_b", "beta_a", "beta_b", "unit",
                                             "reason_a", "reason_b"});
  for (const RowPair& pair : changes.changed) {
    auto& line = table.rows.emplace_back(case_cells(pair.a->choice));
    line.insert(line.end(),
                {pair.a->status, pair.b->status, pair.a->beta.value_or(NAN),
                 pair.b->beta.value_or(NAN), pair.a->unit, pair.a->reason, pair.b->reason});
  }
  return {table, {}};
}

ReportSection time_section(const Differences& changes) {
  ReportTable table{
      "changed_times",
      "Times: ratio of b to a",
      fmt::format(
          "Medians of the ratios of the same rows with 95 % bootstrap intervals, and Wilcoxon's "
          "signed rank test with Holm's correction. A change is an interval wholly {:g} % or more "
          "from 1, with p below 0.05: two runs of the same build on a busy machine differ by less.",
          100 * kDrift),
      {"what", "name", "rows", "times", "times_low", "times_high", "p", "change"},
      {}};
  for (const TimeRatio& each : changes.times) {
    const std::string change = !each.is_significant() ? "" : each.times > 1 ? "slower" : "faster";
    table.rows.push_back({each.column, each.name, static_cast<double>(each.rows), each.times,
                          each.times_low, each.times_high, each.p, change});
  }
  return {table, {}};
}

ReportSection missing_section(const Differences& changes) {
  ReportTable table{"missing_rows", "Rows in only one folder", "", {"folder"}, {}};
  const std::vector<std::string>& columns = case_columns();
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  for (const auto& [folder, rows] :
       {std::pair{"a", &changes.only_a}, std::pair{"b", &changes.only_b}}) {
    for (const ResultRow* row : *rows) {
      auto& line = table.rows.emplace_back(std::vector<ReportCell>{folder});
      const std::vector<ReportCell> cells = case_cells(row->choice);
      line.insert(line.end(), cells.begin(), cells.end());
    }
  }
  return {table, {}};
}

}  // namespace

std::vector<ReportSection> change_sections(const Results& a, const Results& b) {
  const Differences changes = find_differences(a, b);
  return {value_section(changes), time_section(changes), missing_section(changes)};
}

ReportSection dictionary_section() {
  ReportTable table{"dictionary",
                    "Columns",
                    "The meaning of each column of every table, including values.csv, times.csv, "
                    "search_comparison.csv and search_times.csv.",
                    {"column", "unit", "meaning"},
                    {}};
  for (const ColumnMeaning& entry : dictionary()) {
    table.rows.push_back({entry.column, entry.unit, entry.meaning});
  }
  return {table, {}, false};
}

}  // namespace maxwrench
