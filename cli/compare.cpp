#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "benchmarks/comparison.h"
#include "benchmarks/machine.h"
#include "benchmarks/table.h"
#include "cli/cli.h"
#include "cli/convergence.h"
#include "cli/progress.h"
#include "problems/loader.h"

namespace maxwrench {
namespace {

struct CompareOptions : CommonOptions {
  std::vector<std::string> problems = {"uvms/valve", "uvms/lift"};
  int seeds = 10;
  std::string out = "results";
};

std::string number_or_dash(double value, const char* format) {
  return value == kInfinity ? "-" : fmt::format(fmt::runtime(format), value);
}

/// The median over the attempts of what `of` says.
double median_of(const Contender& contender, const std::function<double(const Attempt&)>& of) {
  std::vector<double> values;
  for (const Attempt& each : contender.attempts) values.push_back(of(each));
  return median(values);
}

std::string line(const Comparison& comparison, const Contender& contender) {
  const double target = comparison.target();
  const auto seconds = [&](const Attempt& each) { return each.seconds_to(target); };
  const auto evaluations = [&](const Attempt& each) { return each.evaluations_to(target); };
  int reached = 0;
  for (const Attempt& each : contender.attempts) reached += each.value >= target ? 1 : 0;
  const double final = median_of(contender, [](const Attempt& each) { return each.value; });
  const double below = 100 * (comparison.best() - final) / std::abs(comparison.best());
  const double time = median_of(contender, seconds);
  const double reference = median_of(comparison.reference, seconds);
  return fmt::format(
      "{:<11} {:<8} {:>2} of {:<2} {:>11} {:>8} {:>9} {:>9.4f} {:>9}\n", contender.search,
      contender.lp, reached, contender.attempts.size(),
      number_or_dash(median_of(contender, evaluations), "{:.0f}"),
      number_or_dash(1e3 * time, "{:.0f}"),
      number_or_dash(1e3 * median_of(contender, [](const Attempt& each) { return each.seconds; }),
                     "{:.0f}"),
      below,
      time == kInfinity || reference == kInfinity ? "-"
                                                  : number_or_dash(time / reference, "{:.4f}"));
}

std::string text(const Comparison& comparison) {
  std::string text = fmt::format(
      "{}: best known {:.5f} {}\n"
      "                     -- to 0.1 % below it, median --      all   median    time to that of\n"
      "search      lp       reached evaluations       ms        ms   below %   annealing, glpk\n",
      comparison.problem, comparison.best(), comparison.unit);
  for (const Contender& contender : comparison.contenders) text += line(comparison, contender);
  if (!comparison.reference.attempts.empty()) text += line(comparison, comparison.reference);
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
  Table values(folder / "search_comparison.csv",
               columns({"beta", "unit", "below", "evaluations_to_thousandth", "evaluations"}),
               keys);
  Table times(folder / "search_times.csv", columns({"seconds_to_thousandth", "seconds"}), keys);
  const auto put = [](Table& table, const Attempt& each, std::initializer_list<std::string> more) {
    std::vector<std::string> cells = case_values(each.choice);
    cells.insert(cells.end(), more);
    table.put(cells);
  };
  const double best = comparison.best(), target = comparison.target();
  std::vector<Contender> all = comparison.contenders;
  all.push_back(comparison.reference);
  for (const Contender& contender : all) {
    for (const Attempt& each : contender.attempts) {
      put(values, each,
          {number_or_dash(each.value, "{:.17g}"), comparison.unit,
           number_or_dash((best - each.value) / std::abs(best), "{:.3e}"),
           number_or_dash(each.evaluations_to(target), "{:.0f}"),
           fmt::format("{}", each.evaluations)});
      put(times, each,
          {number_or_dash(each.seconds_to(target), "{:.4g}"),
           number_or_dash(each.seconds, "{:.4g}")});
    }
  }
}

int compare_all(const CompareOptions& options) {
  const std::filesystem::path folder(options.out);
  std::vector<Problem> problems;
  std::vector<Case> cases;
  for (const std::string& name : options.problems) {
    problems.push_back(load_problem(name));
    cases.push_back(options.read_case(problems.back()));
  }
  write_file(folder / "machine.txt", describe_machine());
  Progress progress("compare",
                    attempt_count(options.seeds) * static_cast<long>(options.problems.size()));
  long done = 0;
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    comparisons.push_back(
        compare(problems[i], cases[i], options.seeds, [&] { progress.show(++done); }));
    keep(comparisons.back(), folder);
  }
  progress.finish();
  fmt::print(
      "Every search with {} seeds, {} evaluations each, on one thread; time of the processor.\n",
      options.seeds, options.choice.budget);
  for (const Comparison& comparison : comparisons) fmt::print("\n{}", text(comparison));
  write_file(folder / "search_comparison.svg", draw_convergence(comparisons));
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
  options->add_budget(command, "evaluations of each search");
  command.add_option("--seeds", options->seeds, "seeds 1 to this")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command.add_option("--out", options->out, "folder of the results")->capture_default_str();
  command.callback([options, &exit_status] { exit_status = compare_all(*options); });
}

}  // namespace maxwrench
