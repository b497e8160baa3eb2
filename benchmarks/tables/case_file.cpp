#include "benchmarks/tables/case_file.h"

#include <fmt/format.h>

#include "solvers/solve/row.h"

namespace maxwrench {

std::vector<std::string> with_case_columns(const std::vector<std::string>& more) {
  std::vector<std::string> columns = case_columns();
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

Case case_of(const CsvFile& csv, std::size_t row) {
  Case c;
  c.problem = csv.text(row, "problem");
  c.measure = csv.text(row, "measure");
  const std::string& wrench = csv.text(row, "wrench");
  if (wrench != "pure" && wrench != "any") csv.throw_bad_cell(row, "wrench", "pure or any");
  c.wrench = parse_wrench(wrench);
  c.solver = csv.text(row, "solver");
  c.search = csv.text(row, "search");
  c.seed = csv.whole<std::uint64_t>(row, "seed");
  c.budget = csv.whole<long>(row, "budget");
  c.scheme = csv.text(row, "scheme");
  c.integrator = csv.text(row, "integrator");
  if (!c.integrator.empty() && !c.search.empty()) {
    csv.throw_bad_cell(row, "search", "none beside an integrator");
  }
  return c;
}

std::map<std::vector<std::string>, std::size_t> rows_of_cases(const CsvFile& csv) {
  std::map<std::vector<std::string>, std::size_t> places;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto [place, is_new] = places.emplace(case_values(case_of(csv, i)), i);
    if (is_new) continue;
    csv.throw_bad_cell(
        i, "problem",
        fmt::format("each case once: line {} has it already", line_of(place->second)));
  }
  return places;
}

}  // namespace maxwrench
