#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "benchmarks/report/benchmark_sets.h"
#include "benchmarks/report/row_statistics.h"
#include "cli/report/sections.h"
#include "drawing/scatter.h"
#include "maxwrench/load.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

double or_none(const std::optional<double>& value) { return value.value_or(NAN); }

/// A text, because a seed may have more digits than a double.
ReportCell seed_cell(std::uint64_t seed) {
  const bool fits = seed <= std::uint64_t{1} << 53;
  return fits ? ReportCell(static_cast<double>(seed)) : ReportCell(std::to_string(seed));
}

ReportSection task_section(const std::vector<ResultRow>& rows) {
  ReportTable table{"tasks",
                    "Tasks",
                    "Every problem with each measure and wrench: how many rows have a value, and "
                    "the largest value with the solver and search that found it.",
                    {"problem", "measure", "wrench", "scheme", "rows", "solved", "best", "unit",
                     "solver", "search", "seed"},
                    {}};
  for (const TaskSummary& task : summarise_tasks(rows)) {
    const Case& c = task.choice;
    table.rows.push_back({c.problem, c.measure, to_string(c.wrench), c.scheme,
                          static_cast<double>(task.rows), static_cast<double>(task.solved),
                          or_none(task.best), task.unit, c.solver, c.search, seed_cell(c.seed)});
  }
  return {table, {}};
}

ReportSection solver_section(const std::vector<ResultRow>& rows) {
  ReportTable table{
      "solvers",
      "Lower-level solvers",
      "Performance profiles (Dolan and Moré) of the time of an evaluation on the same problem, "
      "measure, wrench, search and seed, where all applicable solvers were tried. Rows without a "
      "value, and rows that a solver does not support, count as never solved. Times are multiples "
      "of those of the reference, the best at twice the cheapest: a median with its 95 % bootstrap "
      "interval, and Wilcoxon's signed rank test with Holm's correction.",
      {},
      {}};
  return benchmark_set_section(std::move(table), solver_benchmark_sets(rows), "solver", "us");
}

ReportSection search_section(const std::vector<ResultRow>& rows) {
  ReportTable table{
      "searches",
      "Searches in the run",
      "Over all rows, whatever their budget: how many have a value, how many come within 0.1 % of "
      "the best row of their task, and how far the median is below it.",
      {"search", "rows", "solved", "near", "median_below", "us"},
      {}};
  for (const SearchSummary& each : summarise_searches(rows)) {
    table.rows.push_back({each.search, static_cast<double>(each.rows),
                          static_cast<double>(each.solved), static_cast<double>(each.near),
                          each.below, each.us});
  }
  return {table, {}};
}

/// Coordinates, instants, actuators and columns of a problem; missing if the problem cannot be
/// loaded.
std::vector<ReportCell> sizes_of(const CostSummary& cost) {
  try {
    const Problem problem = load_problem(cost.problem);
    const int k = knots_of(problem);
    return {static_cast<double>(problem.redundancy()) * k, static_cast<double>(k),
            static_cast<double>(problem.robot.actuation.u_min.size()),
            static_cast<double>(make_wrench_program(problem, cost.wrench).columns())};
  } catch (const std::exception&) {
    return {NAN, NAN, NAN, NAN};
  }
}

/// A set of points for each solver: one of the sizes and the time from each line of the table of
/// costs. Empty unless sizes differ. `in_time`: for tasks in time, otherwise for static ones.
std::vector<std::string> draw_costs(const ReportTable& table, const std::string& size,
                                    bool in_time) {
  const auto place = [&](const std::string& column) {
    return std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
  };
  const auto x = place(size), us = place("us"), lp = place("solver"), scheme = place("scheme");
  std::map<std::string, std::vector<Eigen::Vector2d>> sets;
  std::set<double> sizes;
  for (const auto& line : table.rows) {
    if (std::get<std::string>(line[scheme]).empty() == in_time) continue;
    const Eigen::Vector2d point(std::get<double>(line[x]), std::get<double>(line[us]));
    if (!point.allFinite() || point.minCoeff() <= 0) continue;
    sets[std::get<std::string>(line[lp])].push_back(point);
    sizes.insert(point.x());
  }
  if (sizes.size() < 2) return {};
  ScatterPanel panel{
      size + (in_time ? ", tasks in time" : ", static tasks"), "us per evaluation", {}};
  for (auto& [name, points] : sets) panel.sets.push_back({name, std::move(points)});
  return {draw_scatter(panel)};
}

ReportSection cost_section(const std::vector<ResultRow>& rows) {
  ReportTable table{"costs",
                    "Cost against dimension",
                    "The cost of an evaluation of a search, with the sizes of the problem: "
                    "searched coordinates, instants, actuators, columns of the wrench.",
                    {"problem", "scheme", "wrench", "solver", "coordinates", "instants",
                     "actuators", "columns", "rows", "us", "us_low", "us_high"},
                    {}};
  std::map<std::pair<std::string, Wrench>, std::vector<ReportCell>> sizes;
  for (const CostSummary& cost : summarise_costs(rows)) {
    auto& size = sizes[{cost.problem, cost.wrench}];
    if (size.empty()) size = sizes_of(cost);
    auto& line = table.rows.emplace_back(
        std::vector<ReportCell>{cost.problem, cost.scheme, to_string(cost.wrench), cost.solver});
    line.insert(line.end(), size.begin(), size.end());
    line.insert(line.end(), {static_cast<double>(cost.rows), cost.us, cost.us_low, cost.us_high});
  }
  std::vector<std::string> figures;
  for (const auto& [size, in_time] : {std::pair{"coordinates", false},
                                      {"columns", false},
                                      {"coordinates", true},
                                      {"instants", true}}) {
    for (std::string& figure : draw_costs(table, size, in_time)) figures.push_back(figure);
  }
  return {table, figures};
}

ReportSection integrator_section(const std::vector<ResultRow>& rows) {
  ReportTable table{
      "integrators",
      "Integrators of the virtual tank",
      "Performance profiles of the processor time of an experiment, including the evaluation of "
      "its posture or trajectory, where all applicable integrators were tried at the same "
      "tolerances. Experiments without a reading count as never solved.",
      {},
      {}};
  return benchmark_set_section(std::move(table), integrator_benchmark_sets(rows), "integrator",
                               "experiment_ms");
}

ReportSection experiment_section(const std::vector<ResultRow>& rows) {
  ReportTable table{"experiments",
                    "Experiments in the virtual tank",
                    "Readings of the load cell for the default posture, which a task in time keeps "
                    "throughout, and the planned values.",
                    {"problem", "wrench", "solver", "scheme", "integrator", "planned", "reading",
                     "unit", "experiment_ms", "evaluations", "reason"},
                    {}};
  for (const ResultRow& row : rows) {
    const Case& c = row.choice;
    if (!row.is_experiment()) continue;
    table.rows.push_back({c.problem, to_string(c.wrench), c.solver, c.scheme, c.integrator,
                          or_none(row.beta_linf), or_none(row.beta), row.unit, or_none(row.ms()),
                          row.evaluations, row.reason});
  }
  return {table, {}};
}

ReportSection failure_section(const std::vector<ResultRow>& rows) {
  ReportTable table{"failures",
                    "Failures",
                    "Rows without a value by their reason, the most frequent first; the table of "
                    "all rows lists each of them.",
                    {"rows", "status", "reason", "problem", "scheme", "solver", "integrator"},
                    {}};
  for (const FailureSummary& each : summarise_failures(rows)) {
    table.rows.push_back({static_cast<double>(each.rows), each.status, each.reason, each.problem,
                          each.scheme, each.solver, each.integrator});
  }
  return {table, {}};
}

ReportSection row_section(const std::vector<ResultRow>& rows) {
  ReportTable table{"rows",
                    "All rows",
                    "Case, status, value, evaluations, time and reason of every row.",
                    {},
                    {}};
  table.columns = case_columns();
  table.columns.insert(table.columns.end(),
                       {"status", "beta", "unit", "evaluations", "us", "reason"});
  for (const ResultRow& row : rows) {
    auto& line = table.rows.emplace_back(case_cells(row.choice));
    line.insert(line.end(), {row.status, or_none(row.beta), row.unit, row.evaluations,
                             or_none(row.us), row.reason});
  }
  return {table, {}, false};
}

}  // namespace

std::vector<ReportCell> case_cells(const Case& c) {
  return {c.problem,   c.measure,         to_string(c.wrench),           c.solver,
          c.search,    seed_cell(c.seed), static_cast<double>(c.budget), c.scheme,
          c.integrator};
}

std::vector<ReportSection> run_sections(const Results& results) {
  const std::vector<ResultRow>& rows = results.rows;
  std::vector<ReportSection> sections = {task_section(rows), solver_section(rows),
                                         search_section(rows), cost_section(rows)};
  const auto tried = [](const ResultRow& row) { return row.is_experiment(); };
  if (std::any_of(rows.begin(), rows.end(), tried)) {
    sections.push_back(integrator_section(rows));
    sections.push_back(experiment_section(rows));
  }
  sections.push_back(failure_section(rows));
  sections.push_back(row_section(rows));
  return sections;
}

}  // namespace maxwrench
