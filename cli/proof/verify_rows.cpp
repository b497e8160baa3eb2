#include "cli/proof/verify_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/suite/row_check.h"
#include "benchmarks/tables/case_file.h"
#include "benchmarks/tables/draw.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "maxwrench/batch.h"
#include "maxwrench/load.h"
#include "solvers/solve/format.h"
#include "solvers/solve/row.h"
#include "verify/packed.h"

namespace maxwrench {
namespace {

std::vector<RowCheck> check_all(const CsvFile& csv, const std::vector<std::size_t>& rows,
                                int threads) {
  std::map<std::string, Problem> problems;
  std::map<std::string, std::string> unknown;  // with their errors
  for (const std::size_t row : rows) {
    const std::string& name = csv.text(row, "problem");
    if (problems.contains(name) || unknown.contains(name)) continue;
    try {
      problems.emplace(name, load_problem(name));
    } catch (const std::invalid_argument& error) {
      unknown.emplace(name, error.what());
    }
  }
  std::vector<RowCheck> checks(rows.size());
  parallel_for(threads, static_cast<long>(rows.size()), [&](long i) {
    const std::size_t row = rows[static_cast<std::size_t>(i)];
    const std::string& name = csv.text(row, "problem");
    const auto wrong = unknown.find(name);
    checks[static_cast<std::size_t>(i)] =
        wrong != unknown.end() ? RowCheck{wrong->second, !csv.text(row, "beta").empty()}
                               : check_row(problems.at(name), csv, row);
  });
  return checks;
}

}  // namespace

bool is_values_file(const std::string& file) {
  const std::string start = case_columns().front() + "," + case_columns()[1];
  std::string line(start.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(line.data(), static_cast<std::streamsize>(line.size()));
  return is_gzip(line) || line == start;
}

int verify_rows(const std::string& file, std::size_t sample, std::uint64_t seed, int threads,
                bool json) {
  const CsvFile csv = read_csv(file, value_columns());
  rows_of_cases(csv);  // each once
  const std::size_t all = csv.rows.size();
  if (all == 0) throw std::invalid_argument(file + ": got no row, expected one or more");
  const std::vector<std::size_t> rows = draw_rows(all, sample, seed);
  const std::vector<RowCheck> checks = check_all(csv, rows, threads);
  double deviation = 0;
  std::vector<std::string> rejected;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    deviation = std::max(deviation, checks[i].deviation);
    if (checks[i].rejection.empty()) continue;
    rejected.push_back(fmt::format("{}: {}", fmt::join(case_values(case_of(csv, rows[i])), ","),
                                   checks[i].rejection));
  }
  const auto values = std::count_if(checks.begin(), checks.end(),
                                    [](const RowCheck& each) { return each.has_value; });
  if (json) {
    print_json({{"file", file},
                {"status", rejected.empty() ? "verified" : "rejected"},
                {"rows", all},
                {"checked", rows.size()},
                {"values", values},
                {"deviation", deviation},
                {"not_checked", kOwnWord},
                {"rejected", rejected}});
  } else {
    fmt::print("{}\n", file);
    if (!rejected.empty()) fmt::print("rejected: {} of the checked rows\n", rejected.size());
    fmt::print("{}: {} of {} rows, {} of them with a value, {} with a reason instead\n",
               rejected.empty() ? "verified" : "checked", rows.size(), all, values,
               static_cast<long>(rows.size()) - values);
    fmt::print("largest deviation {:.2g} of 1 + |beta|\nnot checked: {}\n", deviation, kOwnWord);
    for (const std::string& each : rejected) fmt::print("rejected: {}\n", each);
  }
  return rejected.empty() ? kAnswered : kOtherStatus;
}

}  // namespace maxwrench
