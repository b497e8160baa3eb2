#include "cli/suite/race_table.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "benchmarks/race/race_file.h"
#include "benchmarks/suite/machine.h"
#include "benchmarks/tables/table.h"
#include "maxwrench/version.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

/// The shortfall of a value from the best, as a share of it; NaN if there is no value.
double shortfall(const Comparison& comparison, double value) {
  return (comparison.best() - value) / std::abs(comparison.best());
}

/// The median of a number over the attempts.
double median_of(const Contender& contender, double Attempt::*number) {
  std::vector<double> values;
  for (const Attempt& each : contender.attempts) values.push_back(each.*number);
  return median(std::move(values));
}

/// A number with three digits.
std::string brief(double value) {
  if (!std::isfinite(value)) return "-";
  if (value >= 99.95) return fmt::format("{:.0f}", value);
  return value >= 9.995 ? fmt::format("{:.1f}", value) : fmt::format("{:.2f}", value);
}

std::string expected_cells(const Comparison& comparison, const Contender& contender) {
  std::string cells;
  for (const double share : kTargetShares) {
    cells += fmt::format(
        " {:>7}", brief(1e3 * contender.expected(comparison.target(share), &Spent::seconds)));
  }
  cells += " ";
  for (const double share : kTargetShares) {
    const double evaluations = contender.expected(comparison.target(share), &Spent::evaluations);
    cells += fmt::format(" {:>7}", number_or_dash(evaluations, "{:.0f}"));
  }
  return cells;
}

std::string contender_line(const Comparison& comparison, const Contender& contender) {
  const double target = comparison.target();
  const std::vector<RaceRun> runs = contender.runs();
  std::vector<double> seconds;
  for (const RaceRun& run : runs) seconds.push_back(1e3 * first_hit(run, target).seconds);
  const Quartiles ms = quartiles(std::move(seconds));
  const bool marked = contender.search == comparison.default_search;
  std::string text = fmt::format(
      "{:<20}{:<14} {:>6} {:>3} of {:<3}{}  {:>7} {:>7} {:>7} {:>8}",
      contender.search + (marked ? "*" : ""), contender.solver, contender.budget,
      reached(runs, target), runs.size(), expected_cells(comparison, contender), brief(ms.low),
      brief(ms.median), brief(ms.high),
      number_or_dash(100 * shortfall(comparison, median_of(contender, &Attempt::value)), "{:.4f}"));
  if (comparison.in_time) {
    const double continuous = median_of(contender, &Attempt::value_between_knots);
    text += fmt::format(" {:>10}", number_or_dash(continuous, "{:.4f}"));
  }
  const Contender* reference = comparison.reference();
  if (reference == nullptr) return text + "\n";
  const double plain = reference->expected(target, &Spent::seconds);
  const double share = contender.expected(target, &Spent::seconds) / plain;
  return fmt::format("{} {:>8}\n", text,
                     std::isfinite(plain) ? number_or_dash(share, "{:.4f}") : "-");
}

/// The best search, and the result of the default.
std::string verdict(const Comparison& comparison, const std::vector<const Contender*>& ranked) {
  const auto seconds = [&](const Contender& contender) {
    return contender.expected(comparison.target(), &Spent::seconds);
  };
  if (ranked.empty() || !std::isfinite(seconds(*ranked.front()))) return "";
  const Contender& winner = *ranked.front();
  if (winner.search == comparison.default_search) return "won by the default\n";
  std::string text = "won by " + winner.search;
  if (is_plain(winner.search)) text += ", a plain method";
  for (const Contender* contender : ranked) {
    if (contender->search != comparison.default_search) continue;
    const double factor = seconds(*contender) / seconds(winner);
    text += std::isfinite(factor)
                ? fmt::format("; the default takes {} times as long", brief(factor))
                : "; the default never reaches 0.1 %";
  }
  return text + "\n";
}

void put(Table& table, const Attempt& each, const std::vector<std::string>& more) {
  std::vector<std::string> cells = case_values(each.choice);
  cells.insert(cells.end(), more.begin(), more.end());
  table.put(cells);
}

/// A cell of a table: empty for a number that is not finite, so that programs can read the column
/// as numbers.
std::string number_cell(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "";
}

/// One cell for each target: the cost at which it was reached.
std::vector<std::string> hit_cells(const Comparison& comparison, const Attempt& each, Cost cost,
                                   const char* format) {
  std::vector<std::string> cells;
  for (const double share : kTargetShares) {
    cells.push_back(number_cell(first_hit(each.run, comparison.target(share)).*cost, format));
  }
  return cells;
}

/// The columns of a table: the case, `before`, one column for each target, `after`.
std::vector<std::string> race_columns(const std::vector<std::string>& before, const char* what,
                                      const std::vector<std::string>& after) {
  std::vector<std::string> names = case_columns();
  names.insert(names.end(), before.begin(), before.end());
  for (const char* target : kTargetNames) names.push_back(fmt::format("{}_to_{}", what, target));
  names.insert(names.end(), after.begin(), after.end());
  return names;
}

void keep_attempt(const Comparison& comparison, const Attempt& each, const char* role,
                  Table& values, Table& times) {
  std::vector<std::string> cells = {number_cell(each.value, "{:.17g}"),
                                    number_cell(each.value_between_knots, "{:.17g}"),
                                    comparison.unit,
                                    number_cell(comparison.best(), "{:.17g}"),
                                    comparison.proven ? "yes" : "no",
                                    number_cell(shortfall(comparison, each.value), "{:.3e}"),
                                    role};
  for (auto& cell : hit_cells(comparison, each, &Spent::evaluations, "{:.0f}")) {
    cells.push_back(std::move(cell));
  }
  cells.push_back(fmt::format("{:.0f}", each.run.spent.evaluations));
  put(values, each, cells);
  cells = hit_cells(comparison, each, &Spent::seconds, "{:.4g}");
  for (auto& cell : {number_cell(each.run.spent.seconds, "{:.4g}"), std::string("1"),
                     processor_name(), std::string(version())}) {
    cells.push_back(cell);
  }
  put(times, each, cells);
}

void keep_attempts(const Comparison& comparison, const Contender& contender, const char* role,
                   Table& values, Table& times) {
  for (const Attempt& each : contender.attempts) {
    keep_attempt(comparison, each, role, values, times);
  }
}

/// Removes the rows of an earlier race of the same task, which refer to another best value.
void drop_race(const Comparison& comparison, Table& table) {
  const auto task_of = [](const std::vector<std::string>& cells) {
    return std::tuple(cells[0], cells[1], cells[2], cells[7]);  // problem, measure, wrench, scheme
  };
  const auto task = task_of(case_values(comparison.contenders.front().attempts.front().choice));
  table.drop([&](const std::vector<std::string>& row) { return task_of(row) == task; });
}

}  // namespace

std::string number_or_dash(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string race_table(const Comparison& comparison) {
  const Contender* reference = comparison.reference();
  std::string text = fmt::format("{}{}: {} {} {}\n", comparison.problem,
                                 comparison.interrupted ? ", interrupted" : "",
                                 comparison.proven ? "proven bound" : "best known",
                                 number_or_dash(comparison.best(), "{:.5f}"), comparison.unit);
  if (reference != nullptr) {
    const bool arrives = std::isfinite(reference->expected(comparison.target(), &Spent::seconds));
    text += arrives ? fmt::format("the plain method, the better of {} here: {} through {}\n",
                                  comparison.peers.size() == 1 ? "one peer" : "the peers",
                                  reference->search, reference->solver)
                    : fmt::format("the plain method, {}, never reaches 0.1 %\n", reference->search);
  }
  text += fmt::format(
      "{:53}---- expected ms to a target ----  - expected evaluations to target -"
      " ---- ms to 0.1 % ----   median{}{}\n"
      "{:<20}{:<14} budget to 0.1 %    10 %     1 %   0.1 %  0.01 %     10 %     1 %   0.1 %"
      "  0.01 %  quarter  median quarter  below %{}{}\n",
      "", comparison.in_time ? "     median" : "", reference ? "  of the" : "", "search", "solver",
      comparison.in_time ? "    between" : "", reference ? "   plain" : "");
  const std::vector<const Contender*> ranked = ranking(comparison);
  for (const Contender* contender : ranked) text += contender_line(comparison, *contender);
  for (const Contender& peer : comparison.peers) {
    if (!peer.attempts.empty()) text += contender_line(comparison, peer);
  }
  return comparison.interrupted ? text : text + verdict(comparison, ranked);
}

std::string summary_table(std::span<const Standing> rows, std::span<const Comparison> comparisons) {
  std::string head = "| search | typical | worst |", line = "|---|---|---|";
  for (const double share : kTargetShares) {
    head += fmt::format(" {:.6g} % |", 100 * share);
    line += "---|";
  }
  for (const Comparison& comparison : comparisons) {
    head += fmt::format(" {} |", comparison.problem);
    line += "---|";
  }
  std::string text = head + "\n" + line + "\n";
  for (const Standing& standing : rows) {
    const std::string name = fmt::format("`{}`", standing.search);
    text += fmt::format("| {} | {} | {} |", standing.is_default ? "**" + name + "**" : name,
                        brief(standing.typical), brief(standing.worst));
    for (const double share : standing.reached) text += fmt::format(" {:.0f} |", 100 * share);
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
      text += fmt::format(" {} |", brief(1e3 * standing.seconds[i]));
    }
    text += "\n";
  }
  return text;
}

void keep(const Comparison& comparison, const std::filesystem::path& folder) {
  const std::size_t keys = case_columns().size();
  Table values(
      folder / "search_comparison.csv",
      race_columns({"beta", "value_between_knots", "unit", "best_known", "proven", "below", "role"},
                   "evaluations", {"evaluations"}),
      keys);
  Table times(folder / "search_times.csv",
              race_columns({}, "seconds", {"seconds", "threads", "machine", "version"}), keys);
  drop_race(comparison, values);
  drop_race(comparison, times);
  for (const Contender& contender : comparison.contenders) {
    const bool is_default = contender.search == comparison.default_search;
    keep_attempts(comparison, contender, is_default ? kDefaultRole : kContenderRole, values, times);
  }
  for (const Contender& peer : comparison.peers) {
    keep_attempts(comparison, peer, kPeerRole, values, times);
  }
  values.write();
  times.write();
}

}  // namespace maxwrench
