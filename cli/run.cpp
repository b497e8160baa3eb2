#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "benchmarks/plan_row.h"
#include "cli/cli.h"
#include "cli/row_writer.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

struct RunOptions : CommonOptions {
  std::vector<std::string> words;
  std::string out = "results";
};

/// What the words of the command line choose.
struct Choice {
  std::vector<std::string> problems;
  std::map<std::string, std::string> filter;
};

bool is_problem(const std::string& word) {
  const std::vector<std::string> shipped = shipped_problems();
  std::error_code ignored;
  return std::find(shipped.begin(), shipped.end(), word) != shipped.end() ||
         std::filesystem::is_regular_file(word, ignored);
}

Choice read_words(const std::vector<std::string>& words) {
  Choice choice;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (is_problem(word)) {
      choice.problems.push_back(word);
    } else if (equals == std::string::npos) {
      throw std::invalid_argument(fmt::format(
          "run: got '{}', expected column=value, a shipped problem or a task file", word));
    } else if (!choice.filter.emplace(word.substr(0, equals), word.substr(equals + 1)).second) {
      throw std::invalid_argument(fmt::format("run: got '{}', expected each column once", word));
    }
  }
  const auto named = choice.filter.find("problem");
  if (named != choice.filter.end() && is_problem(named->second)) {
    choice.problems.push_back(named->second);
  }
  return choice;
}

std::uint64_t read_seed(const std::map<std::string, std::string>& filter) {
  const auto found = filter.find("seed");
  if (found == filter.end()) return Case().seed;
  const std::string why = refuse_seed(found->second);
  if (!why.empty()) throw std::invalid_argument("seed: " + why);
  return std::stoull(found->second);
}

long read_budget(const std::map<std::string, std::string>& filter, bool in_time) {
  const auto found = filter.find("budget");
  if (found == filter.end()) return in_time ? kPlanBudget : Case().budget;
  std::size_t used = 0;
  long value = 0;
  try {
    value = std::stol(found->second, &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != found->second.size() || value < 1 || value > kMostBudget) {
    throw std::invalid_argument(fmt::format("budget: got '{}', expected a whole number of 1 to {}",
                                            found->second, kMostBudget));
  }
  return value;
}

/// The chosen cases of the problems.
std::vector<Case> choose(const std::map<std::string, Problem>& problems,
                         const std::map<std::string, std::string>& filter) {
  const std::uint64_t seed = read_seed(filter);
  std::vector<Case> cases;
  for (const auto& named : problems) {
    const long budget = read_budget(filter, named.second.motion.has_value());
    const std::vector<Case> more = product(named.second, seed, budget);
    cases.insert(cases.end(), more.begin(), more.end());
  }
  return select(std::move(cases), filter);
}

/// Those named, or all shipped static ones.
std::map<std::string, Problem> load_chosen(const std::vector<std::string>& named) {
  std::map<std::string, Problem> problems;
  for (const std::string& name : named.empty() ? shipped_problems() : named) {
    Problem problem = load_problem(name);
    if (named.empty() && problem.motion) continue;
    problems.try_emplace(name, std::move(problem));
  }
  return problems;
}

/// On a copy, whose scheme is that of the case.
void solve_case(RowWriter& writer, Problem problem, const Case& c) {
  if (!problem.motion) {
    writer.solve(problem, resolve(problem, c));
    return;
  }
  set_scheme("scheme", c.scheme, problem);
  writer.solve(problem, resolve_plan(problem, c));
}

int run(const RunOptions& options) {
  const Choice choice = read_words(options.words);
  const std::map<std::string, Problem> problems = load_chosen(choice.problems);
  const std::vector<Case> cases = choose(problems, choice.filter);
  const std::filesystem::path folder(options.out);
  RowWriter writer("run", folder, options.thread_count(), static_cast<long>(cases.size()));
  for (const Case& c : cases) {
    solve_case(writer, problems.at(c.problem), c);
  }
  const bool all_solved = writer.finish();
  fmt::print("{} rows in {}\n", cases.size(), (folder / "values.csv").string());
  return all_solved ? kAnswered : kOtherStatus;
}

}  // namespace

void add_run(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<RunOptions>();
  CLI::App& command = *app.add_subcommand(
      "run", "every meaningful combination of measure, wrench, scheme, solver, search");
  command.add_option(
      "words", options->words,
      "problems, shipped or task files (default: all static ones shipped), and column=value: "
      "only these rows (seed and budget are set, not filtered)");
  command.add_option("--out", options->out, "folder of values.csv, times.csv and machine.txt")
      ->capture_default_str()
      ->check(refuse_empty);
  options->add_threads(command);
  command.callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace maxwrench
