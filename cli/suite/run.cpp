#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "benchmarks/suite/cost.h"
#include "benchmarks/suite/product.h"
#include "benchmarks/suite/suite_file.h"
#include "benchmarks/tables/csv.h"
#include "cli/cli.h"
#include "cli/suite/row_writer.h"
#include "cli/suite/shard_option.h"
#include "cli/suite/workers.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

struct RunOptions : CommonOptions {
  std::vector<std::string> words;
  std::string out = "results", shard = "1/1";
  bool dry = false, commands = false, again = false;
};

/// The problems and cases that the words of the command line choose.
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
          "run: got '{}', expected column=value, a shipped problem, a task file or a suite", word));
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
  const std::string why = reject_seed(found->second);
  if (!why.empty()) throw std::invalid_argument("seed: " + why);
  return std::stoull(found->second);
}

long read_budget(const std::map<std::string, std::string>& filter, bool in_time) {
  const auto found = filter.find("budget");
  if (found == filter.end()) return in_time ? kTrajectoryBudget : kUsualBudget;
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

/// The named problems, or all shipped static ones.
std::map<std::string, Problem> load_chosen(const std::vector<std::string>& named) {
  std::map<std::string, Problem> problems;
  for (const std::string& name : named.empty() ? shipped_problems() : named) {
    Problem problem = load_problem(name);
    if (named.empty() && problem.motion) continue;
    problems.try_emplace(name, std::move(problem));
  }
  return problems;
}

Workload choose(const Choice& choice) {
  const std::uint64_t seed = read_seed(choice.filter);
  Workload work{load_chosen(choice.problems), {}, {}};
  for (const auto& named : work.problems) {
    const long budget = read_budget(choice.filter, named.second.motion.has_value());
    const std::vector<Case> more = product(named.second, seed, budget);
    work.cases.insert(work.cases.end(), more.begin(), more.end());
  }
  work.cases = select(std::move(work.cases), choice.filter);
  sort_cases(work.cases);
  return work;
}

/// A suite, which must be the only word, or what the words choose.
Workload read_work(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(word, ignored) || is_task(word)) continue;
    if (words.size() == 1) return read_suite_file(word);
    throw std::invalid_argument(fmt::format(
        "run: got {} arguments beside '{}', expected a suite alone", words.size() - 1, word));
  }
  return choose(read_words(words));
}

/// The cases of "I/N".
std::vector<Case> take_shard(const std::string& text, const Workload& work) {
  const auto [index, count] = parse_shard(text);
  if (count == 1) return work.cases;
  std::vector<double> costs;
  for (const Case& c : work.cases) {
    costs.push_back(usual_seconds(work.problems.at(c.problem), c));
  }
  return shard(work.cases, costs, index - 1, count);
}

std::string quoted_word(const std::string& word) {
  const bool plain = word.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                         "_-+./=") == std::string::npos;
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The command that computes the same row.
std::string command_of(const Case& c) {
  const bool experiment = !c.integrator.empty();
  return fmt::format(
      "maxwrench {} {} --measure {} --wrench {}{}{}{}", experiment ? "simulate" : "solve",
      quoted_word(c.problem), c.measure, to_string(c.wrench),
      c.solver == kNoSolver ? "" : " --solver " + c.solver,
      experiment ? " --integrator " + c.integrator
                 : fmt::format(" --search {} --seed {} --budget {}", c.search, c.seed, c.budget),
      c.scheme.empty() ? "" : " --scheme " + c.scheme);
}

int print_forecast(const RunOptions& options, const Workload& work, const std::vector<Case>& all,
                   const std::vector<Case>& todo) {
  const Forecast forecast(times_table(options.out));
  double seconds = 0, in_a_row = 0;
  for (const Case& c : todo) {
    const double each = forecast.seconds(work.problems.at(c.problem), c);
    seconds += each;
    if (waits_for_others(c)) in_a_row += each;
  }
  const int threads = options.thread_count();
  fmt::print("{} rows, {} of them to run, in about {:.0f} s on {} thread{}\n", all.size(),
             todo.size(), std::max(seconds / threads, in_a_row), threads, threads == 1 ? "" : "s");
  return kAnswered;
}

std::vector<Case> still_to_do(const Workload& work, std::vector<Case> cases,
                              const std::string& folder) {
  const RowsThere there(folder);
  if (!there.empty() && !names_sources(version())) {
    fmt::print(stderr,
               "run: {} is built from changed or unknown sources: all rows are computed again\n",
               version());
  }
  std::erase_if(cases, [&](const Case& c) { return there.has(work.problems.at(c.problem), c); });
  return cases;
}

int run(const RunOptions& options) {
  const Workload work = read_work(options.words);
  const std::vector<Case> cases = take_shard(options.shard, work);
  if (options.commands) {
    for (const Case& c : cases) fmt::print("{}\n", command_of(c));
    return kAnswered;
  }
  const std::vector<Case> todo = options.again ? cases : still_to_do(work, cases, options.out);
  if (options.dry) return print_forecast(options, work, cases, todo);
  solve_cases(work, todo, options.out, options.thread_count());
  const bool all_solved = RowsThere(options.out).all_solved(cases);
  const fs::path file = table_file(fs::path(options.out) / "values.csv");
  fmt::print("{} rows in {}", cases.size(), file.string());
  if (todo.size() < cases.size())
    fmt::print(", {} of them existed before", cases.size() - todo.size());
  fmt::print("\n");
  return all_solved ? kAnswered : kOtherStatus;
}

}  // namespace

void add_run(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<RunOptions>();
  CLI::App& command = *app.add_subcommand(
      "run", "runs every valid combination of measure, wrench, scheme, solver and search");
  command.add_option(
      "words", options->words,
      "a suite (TOML); or shipped tasks and task files (default: all shipped static tasks), and "
      "column=value to keep only these rows (seed and budget are set, not filtered)");
  command
      .add_option("--out", options->out, "folder for values.csv.gz, times.csv.gz and machine.txt")
      ->capture_default_str()
      ->check(reject_empty);
  command.add_flag("--dry", options->dry, "only count the rows and predict the time");
  command.add_flag("--commands", options->commands, "only print the command of each row");
  command.add_flag("--again", options->again, "compute existing rows again, too");
  command.add_option("--shard", options->shard, "I/N: only part I of N, always the same rows")
      ->capture_default_str();
  options->add_threads(command);
  command.callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace maxwrench
