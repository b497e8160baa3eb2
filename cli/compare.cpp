#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "benchmarks/comparison.h"
#include "benchmarks/machine.h"
#include "benchmarks/plan_row.h"
#include "benchmarks/table.h"
#include "benchmarks/write_file.h"
#include "cli/cli.h"
#include "cli/ctrl_c.h"
#include "cli/motion_options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "drawing/convergence.h"
#include "maxwrench/load.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

struct CompareOptions : CommonOptions {
  std::vector<std::string> problems = {"uvms/valve", "uvms/lift"};
  int seeds = 10;
  bool names_budget = false;
  MotionOptions motion;
  std::string out = "results";
};

std::string number_or_dash(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

/// How far a value stays below the best, as a share of it; NaN if there is none.
double shortfall(const Comparison& comparison, double value) {
  return (comparison.best() - value) / std::abs(comparison.best());
}

/// The median over the attempts of what `of` says.
double median_of(const Contender& contender, const std::function<double(const Attempt&)>& of) {
  std::vector<double> values;
  for (const Attempt& each : contender.attempts) values.push_back(of(each));
  return median(values);
}

std::string contender_line(const Comparison& comparison, const Contender& contender) {
  const double target = comparison.target();
  const auto seconds = [&](const Attempt& each) { return each.seconds_to(target); };
  const auto evaluations = [&](const Attempt& each) { return each.evaluations_to(target); };
  int reached = 0;
  for (const Attempt& each : contender.attempts) reached += each.value >= target ? 1 : 0;
  const auto median_number = [&](double Attempt::*number) {
    return median_of(contender, [number](const Attempt& each) { return each.*number; });
  };
  const double time = median_of(contender, seconds);
  std::string text = fmt::format(
      "{:<15} {:<8} {:>2} of {:<2} {:>11} {:>8} {:>9} {:>9} {:>9}", contender.search, contender.lp,
      reached, contender.attempts.size(),
      number_or_dash(median_of(contender, evaluations), "{:.0f}"),
      number_or_dash(1e3 * time, "{:.0f}"),
      number_or_dash(1e3 * contender.expected_seconds(target), "{:.0f}"),
      number_or_dash(1e3 * median_number(&Attempt::seconds), "{:.0f}"),
      number_or_dash(100 * shortfall(comparison, median_number(&Attempt::value)), "{:.4f}"));
  if (comparison.in_time) {
    text += fmt::format(" {:>10}", number_or_dash(median_number(&Attempt::continuous), "{:.4f}"));
  }
  if (comparison.reference.attempts.empty()) return text + "\n";
  const double plain = comparison.reference.expected_seconds(target);
  const double share = contender.expected_seconds(target) / plain;
  return fmt::format("{} {:>9}\n", text,
                     std::isfinite(plain) ? number_or_dash(share, "{:.4f}") : "-");
}

std::string text(const Comparison& comparison) {
  const Contender& reference = comparison.reference;
  const bool referred = !reference.attempts.empty();
  const std::string best = number_or_dash(comparison.best(), "{:.5f}");
  const std::string plain = fmt::format("{}, {}", reference.search, reference.lp);
  std::string text = fmt::format(
      "{}{}: best known {} {}, {} evaluations each\n"
      "                         -- to 0.1 % below it, median --                all   median{}{}\n"
      "search          lp       reached evaluations       ms  expected        ms   below %{}{}\n",
      comparison.problem, comparison.interrupted ? ", interrupted" : "", best, comparison.unit,
      comparison.budget, comparison.in_time ? "     median" : "",
      referred ? "   expected to that" : "", comparison.in_time ? " continuous" : "",
      referred ? "   of " + plain : "");
  for (const Contender& contender : comparison.contenders) {
    if (!contender.attempts.empty()) text += contender_line(comparison, contender);
  }
  if (referred) text += contender_line(comparison, comparison.reference);
  return text;
}

/// The values and, apart from them, the times of all attempts.
void keep(const Comparison& comparison, const std::filesystem::path& folder) {
  const auto columns = [](std::initializer_list<std::string> more) {
    std::vector<std::string> names = case_columns();
    names.insert(names.end(), more);
    return names;
  };
  const std::size_t keys = case_columns().size();
  Table values(
      folder / "search_comparison.csv",
      columns({"beta", "continuous", "unit", "below", "evaluations_to_thousandth", "evaluations"}),
      keys);
  Table times(folder / "search_times.csv",
              columns({"seconds_to_thousandth", "seconds", "threads", "machine", "version"}), keys);
  const auto put = [](Table& table, const Attempt& each, std::initializer_list<std::string> more) {
    std::vector<std::string> cells = case_values(each.choice);
    cells.insert(cells.end(), more);
    table.put(cells);
  };
  const double target = comparison.target();
  std::vector<Contender> all = comparison.contenders;
  all.push_back(comparison.reference);
  for (const Contender& contender : all) {
    for (const Attempt& each : contender.attempts) {
      put(values, each,
          {number_or_dash(each.value, "{:.17g}"), number_or_dash(each.continuous, "{:.17g}"),
           comparison.unit, number_or_dash(shortfall(comparison, each.value), "{:.3e}"),
           number_or_dash(each.evaluations_to(target), "{:.0f}"),
           fmt::format("{}", each.evaluations)});
      put(times, each,
          {number_or_dash(each.seconds_to(target), "{:.4g}"),
           number_or_dash(each.seconds, "{:.4g}"), "1", processor_name(), version()});
    }
  }
}

/// The median of each search as a curve; `comparison` outlives it.
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

/// Keeps what is finished; of an interrupted problem nothing, because each line depends on the best
/// of all.
std::vector<Comparison> attempt_all(const CompareOptions& options,
                                    const std::filesystem::path& folder) {
  std::vector<Problem> problems;
  std::vector<Case> cases;
  for (const std::string& name : options.problems) {
    Problem& problem = problems.emplace_back(load_problem(name));
    options.motion.change(problem);
    Case& c = cases.emplace_back(options.read_case());
    if (problem.motion && !options.names_budget) c.budget = kPlanBudget;
    complete(problem, c);  // refuses before anything is computed
  }
  write_file(folder / "machine.txt", describe_machine());
  long total = 0, done = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    total += attempt_count(problems[i], cases[i], options.seeds);
  }
  Progress progress("compare", total);
  CtrlC ctrl_c;
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < problems.size() && !ctrl_c.interruption.asked; ++i) {
    comparisons.push_back(compare(
        problems[i], cases[i], options.seeds, [&] { progress.show(++done); },
        &ctrl_c.interruption));
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

int compare_all(const CompareOptions& options) {
  const std::filesystem::path folder(options.out);
  const std::vector<Comparison> comparisons = attempt_all(options, folder);
  fmt::print("Every search with {} seeds on one thread; time of the processor.\n", options.seeds);
  for (const Comparison& comparison : comparisons) fmt::print("\n{}", text(comparison));
  if (!finished(options, comparisons)) {
    remark("interrupted or without a value: the figure is not drawn");
    return kOtherStatus;
  }
  for (const bool in_time : {false, true}) {
    std::vector<ConvergencePanel> panels;
    for (const Comparison& comparison : comparisons) {
      if (comparison.in_time == in_time) panels.push_back(panel(comparison));
    }
    if (panels.empty()) continue;
    write_file(folder / (in_time ? "plan_comparison.svg" : "search_comparison.svg"),
               draw_convergence(panels));
  }
  return kAnswered;
}

}  // namespace

void add_compare(CLI::App& app, int& exit_status) {
  auto options = std::make_shared<CompareOptions>();
  options->choice.budget = 100000;
  CLI::App& command = *app.add_subcommand("compare", "every search with many seeds, side by side");
  command.add_option("problems", options->problems, "shipped names or task files")
      ->capture_default_str();
  options->add_choice(command);
  options->add_budget(command, "evaluations of each search (default of tasks in time: 5000)");
  options->motion.add(command);
  command.add_option("--seeds", options->seeds, "seeds 1 to this")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command.add_option("--out", options->out, "folder of the results")
      ->capture_default_str()
      ->check(refuse_empty);
  command.callback([options, &command, &exit_status] {
    options->names_budget = command.count("--budget") > 0;
    exit_status = compare_all(*options);
  });
}

}  // namespace maxwrench
