#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "benchmarks/race/comparison.h"
#include "benchmarks/race/race_summary.h"
#include "benchmarks/suite/machine.h"
#include "benchmarks/suite/product.h"
#include "benchmarks/tables/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/suite/race_figures.h"
#include "cli/suite/race_table.h"
#include "cli/task/motion_options.h"
#include "drawing/convergence.h"
#include "drawing/ecdf.h"
#include "maxwrench/load.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

struct CompareOptions : CommonOptions {
  std::vector<std::string> problems;  ///< if empty, all shipped static ones
  int seeds = 20;
  bool names_budget = false;
  MotionOptions motion;
  std::string out = "results";
};

/// Problems with at most this many coordinates, and those with dependent joints, get a fifth of the
/// budget unless it is named. With dependent joints, an evaluation takes about as long as twenty
/// others.
constexpr int kFewCoordinates = 2;
constexpr long kLesserShare = 5;
/// The most searches that are named in the figures.
constexpr std::size_t kNamed = 8;

/// All shipped static tasks, including those with a second contact.
std::vector<std::string> static_problems() {
  std::vector<std::string> names;
  for (const std::string& name : shipped_problems()) {
    if (!load_problem(name).motion) names.push_back(name);
  }
  return names;
}

/// The median of each search as a curve; `comparison` must outlive it.
ConvergencePanel panel(const Comparison& comparison) {
  ConvergencePanel panel{comparison.problem, static_cast<double>(comparison.budget), {}};
  const double best = comparison.best();
  for (const Contender& contender : comparison.contenders) {
    panel.curves.push_back({contender.search, [&contender, best](double evaluations) {
                              return contender.shortfall_after(evaluations, best);
                            }});
  }
  return panel;
}

long usual_budget(const Problem& problem, long budget) {
  if (problem.motion) return kTrajectoryBudget;
  const bool whole = problem.redundancy() > kFewCoordinates && problem.dependent.empty();
  return whole ? budget : budget / kLesserShare;
}

/// Returns only finished problems; nothing of an interrupted one, because each line depends on the
/// best of all.
std::vector<Comparison> attempt_all(const CompareOptions& options,
                                    const std::filesystem::path& folder) {
  std::vector<Problem> problems;
  std::vector<Case> cases;
  for (const std::string& name : options.problems) {
    if (std::count(options.problems.begin(), options.problems.end(), name) > 1) {
      throw std::invalid_argument(
          fmt::format("problems: got '{}' twice, expected each once", name));
    }
    Problem& problem = problems.emplace_back(load_problem(name));
    options.motion.change(problem);
    Case& c = cases.emplace_back(options.read_options());
    if (!options.names_budget) c.budget = usual_budget(problem, c.budget);
    resolve(problem, c);  // rejects errors before any computation
  }
  write_file(folder / "machine.txt", describe_machine());
  long total = 0;
  std::atomic<long> done = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    total += attempt_count(problems[i], cases[i], options.seeds);
  }
  Progress progress("compare", total);
  CtrlC ctrl_c;
  const std::function<bool()> asked = ctrl_c.asked();
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < problems.size() && !asked(); ++i) {
    const RaceOptions race{options.seeds, options.thread_count(), !options.names_budget,
                           [&] { progress.show(++done); }, asked};
    comparisons.push_back(compare(problems[i], cases[i], race));
    if (!comparisons.back().interrupted) keep(comparisons.back(), folder);
  }
  progress.finish();
  return comparisons;
}

/// Whether every problem has all its attempts and a value.
bool finished(const CompareOptions& options, const std::vector<Comparison>& comparisons) {
  return comparisons.size() == options.problems.size() &&
         std::all_of(comparisons.begin(), comparisons.end(), [](const Comparison& comparison) {
           return comparison.has_value() && !comparison.interrupted;
         });
}

/// `kind` is "search" or "trajectory".
void draw(std::span<const Comparison> comparisons, const std::filesystem::path& folder,
          const std::string& kind) {
  const std::vector<std::string> named = leaders(standings(comparisons), kNamed);
  std::vector<ConvergencePanel> panels;
  std::vector<EcdfPanel> each;
  for (const Comparison& comparison : comparisons) {
    panels.push_back(panel(comparison));
    for (EcdfPanel& one : ecdf_panels({&comparison, 1}, comparison.problem)) {
      each.push_back(std::move(one));
    }
  }
  write_file(folder / (kind + "_comparison.svg"), draw_convergence(panels, named));
  write_file(folder / (kind + "_ecdf_problems.svg"), draw_ecdf(each, named, 2));
  write_file(folder / (kind + "_ecdf.svg"),
             draw_ecdf(ecdf_panels(comparisons, "all problems"), named, 1));
}

/// The searches that are named in the figures and the baseline `sample`; then all searches with
/// their times for each problem.
std::string summary(std::span<const Comparison> comparisons) {
  const std::vector<Standing> all = standings(comparisons);
  std::vector<std::string> named = leaders(all, kNamed);
  named.push_back("sample");
  std::vector<Standing> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), [&](const Standing& each) {
    return std::find(named.begin(), named.end(), each.search) != named.end();
  });
  return fmt::format(
      "\nAll problems together, best first, the default in bold. Typical and worst: the expected "
      "time to 0.1 % as a multiple\n"
      "of that of the best search of a problem, median and largest over the problems; 10 % ... "
      "0.01 %: the share [%] of all\n"
      "problems and seeds that reached it (a problem that a search does not support counts as "
      "missed).\n\n{}\n"
      "All searches, with the expected ms to 0.1 % of each problem:\n\n{}",
      summary_table(some), summary_table(all, comparisons));
}

/// All tables, and the summary if nothing is missing.
std::string race_text(std::span<const Comparison> comparisons, int seeds, bool whole) {
  std::string text = fmt::format(
      "Every search with {} seeds, each on one thread; processor time, best first, * the "
      "default.\n",
      seeds);
  for (const Comparison& comparison : comparisons) text += "\n" + race_table(comparison);
  return whole && comparisons.size() > 1 ? text + summary(comparisons) : text;
}

int compare_all(const CompareOptions& options) {
  const std::filesystem::path folder(options.out);
  const std::vector<Comparison> comparisons = attempt_all(options, folder);
  const bool whole = finished(options, comparisons);
  for (const bool in_time : {false, true}) {
    std::vector<Comparison> some;
    std::copy_if(comparisons.begin(), comparisons.end(), std::back_inserter(some),
                 [&](const Comparison& comparison) { return comparison.in_time == in_time; });
    if (some.empty()) continue;
    const std::string text = race_text(some, options.seeds, whole);
    fmt::print("{}", text);
    if (!whole) continue;
    const char* kind = in_time ? "trajectory" : "search";
    write_file(folder / fmt::format("{}_comparison.txt", kind), text);
    draw(some, folder, kind);
  }
  if (!whole)
    remark("interrupted or without a value: no figure is drawn, no summary printed, no table kept");
  return whole ? kAnswered : kOtherStatus;
}

}  // namespace

void add_compare(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<CompareOptions>();
  options->choice.budget = 100000;
  CLI::App& command = *app.add_subcommand("compare", "compares all searches with many seeds");
  command.add_option("problems", options->problems,
                     "shipped tasks or task files (default: all shipped static tasks)");
  options->add_choice(command);
  options->add_budget(
      command,
      "evaluation budget of each search (default: a fifth with up to two coordinates or with "
      "dependent joints, 5000 for tasks in time; Ipopt gets a fifth of these)");
  options->add_threads(command);
  options->motion.add(command);
  command.add_option("--seeds", options->seeds, "number of seeds (1 to N)")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command.add_option("--out", options->out, "folder for the results")
      ->capture_default_str()
      ->check(reject_empty);
  command.callback([options, &command, &exit_status] {
    options->names_budget = command.count("--budget") > 0;
    if (options->problems.empty()) options->problems = static_problems();
    exit_status = compare_all(*options);
  });
}

}  // namespace maxwrench
