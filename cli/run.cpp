#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <map>
#include <memory>

#include "cli/cli.h"
#include "cli/row_writer.h"
#include "problems/loader.h"

namespace maxwrench {
namespace {

struct RunOptions : CommonOptions {
  std::vector<std::string> filter;
  std::string out = "results";
};

std::map<std::string, std::string> read_filter(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> filter;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument(fmt::format("run: got '{}', expected column=value", text));
    }
    filter[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return filter;
}

long read_whole(const std::map<std::string, std::string>& filter, const std::string& column,
                long fallback, long most) {
  const auto found = filter.find(column);
  if (found == filter.end()) return fallback;
  std::size_t used = 0;
  long value = 0;
  try {
    value = std::stol(found->second, &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != found->second.size() || value < 1 || value > most) {
    throw std::invalid_argument(fmt::format("{}: got '{}', expected a whole number of 1 to {}",
                                            column, found->second, most));
  }
  return value;
}

/// The chosen cases of every shipped problem.
std::vector<Case> choose(const std::map<std::string, std::string>& filter) {
  const Case defaults;
  const long seed = read_whole(filter, "seed", static_cast<long>(defaults.seed),
                               std::numeric_limits<long>::max());
  const long budget = read_whole(filter, "budget", defaults.budget, kMostBudget);
  std::vector<Case> cases;
  for (const std::string& name : shipped_problems()) {
    const std::vector<Case> more = product(name, static_cast<std::uint64_t>(seed), budget,
                                           load_problem(name).contact_columns());
    cases.insert(cases.end(), more.begin(), more.end());
  }
  return select(std::move(cases), filter);
}

int run(const RunOptions& options) {
  const std::vector<Case> cases = choose(read_filter(options.filter));
  const std::filesystem::path folder(options.out);
  RowWriter writer("run", folder, options.thread_count(), static_cast<long>(cases.size()));
  for (const Case& c : cases) writer.solve(load_problem(c.problem), c);
  const bool all_solved = writer.finish();
  fmt::print("{} rows in {}\n", cases.size(), (folder / "values.csv").string());
  return all_solved ? kAnswered : kOtherStatus;
}

}  // namespace

void add_run(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<RunOptions>();
  CLI::App& command =
      *app.add_subcommand("run", "every meaningful combination of measure, wrench, solver, search");
  command.add_option("filter", options->filter,
                     "column=value: only these rows (seed and budget are set, not filtered)");
  command.add_option("--out", options->out, "folder of values.csv, times.csv and machine.txt")
      ->capture_default_str();
  options->add_threads(command);
  command.callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace maxwrench
