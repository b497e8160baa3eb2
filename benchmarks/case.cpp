#include "benchmarks/case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/strategies.h"

namespace maxwrench {
namespace {

bool serves(const WrenchSolverEntry& solver, Wrench wrench, int contact_columns) {
  return (wrench == Wrench::kPure && contact_columns == 0) || !solver.one_column_only;
}

/// The lower-level solvers that serve a measure and a wrench, with their costs.
std::vector<std::pair<std::string, int>> solvers_for(const MeasureEntry& measure, Wrench wrench,
                                                     int contact_columns) {
  if (wrench == Wrench::kAny && !measure.serves_any) return {};
  if (!measure.needs_solver) return {{kNoSolver, 1}};
  std::vector<std::pair<std::string, int>> names;
  for (const WrenchSolverEntry& solver : wrench_solvers()) {
    if (serves(solver, wrench, contact_columns)) names.emplace_back(solver.name, solver.cost);
  }
  return names;
}

/// Whether a force of the contact ends at a limit other than zero.
bool limited(const Contact& contact) {
  const auto counts = [](double limit) { return limit != 0 && std::isfinite(limit); };
  return std::any_of(contact.w_min.begin(), contact.w_min.end(), counts) ||
         std::any_of(contact.w_max.begin(), contact.w_max.end(), counts);
}

}  // namespace

Wrench parse_wrench(const std::string& name) {
  if (name == "pure") return Wrench::kPure;
  if (name == "any") return Wrench::kAny;
  throw std::invalid_argument(fmt::format("wrench: got '{}', expected pure or any", name));
}

Case complete(Case c, int contact_columns) {
  const MeasureEntry& measure = find_measure(c.measure);
  find_search(c.search);
  if (c.budget < 1) {
    throw std::invalid_argument(fmt::format("budget: got {}, expected at least 1", c.budget));
  }
  if (c.wrench == Wrench::kAny && !measure.serves_any) {
    throw std::invalid_argument(fmt::format(
        "wrench: got 'any', which means nothing to measure {}, expected pure", c.measure));
  }
  const auto allowed = solvers_for(measure, c.wrench, contact_columns);
  if (c.lp.empty()) c.lp = allowed.front().first;
  if (c.lp != kNoSolver) find_wrench_solver(c.lp);
  const bool meaningful = std::any_of(allowed.begin(), allowed.end(),
                                      [&](const auto& solver) { return solver.first == c.lp; });
  if (!meaningful) {
    std::vector<std::string> names;
    for (const auto& solver : allowed) names.push_back(solver.first);
    throw std::invalid_argument(fmt::format(
        "lp: got '{}', which does not serve measure {} with wrench {}{}, expected one of {}", c.lp,
        c.measure, to_string(c.wrench), contact_columns > 0 ? " and a second contact" : "",
        fmt::join(names, " ")));
  }
  return c;
}

Case fit(const Problem& problem, Case c) {
  if (c.lp == "facets" && !problem.robot.actuation.has_facets) c.lp = "box";
  return c;
}

MeasureMaker measure_maker(const Problem& problem, const Case& c) {
  const MeasureEntry& measure = find_measure(c.measure);
  const WrenchSolverEntry* solver = measure.needs_solver ? &find_wrench_solver(c.lp) : nullptr;
  const bool closed_form = !measure.needs_solver && measure.serves_any;
  if (closed_form && problem.contact && limited(*problem.contact)) {
    throw std::invalid_argument("measure: got " + c.measure +
                                ", expected one with a solver: a closed form serves no limits of "
                                "contact.basis but zero and infinity");
  }
  return [&problem, &measure, solver] {
    return measure.make(problem, solver ? solver->make() : nullptr);
  };
}

const char* unit(const Problem& problem, const Case& c) {
  const char* own = find_measure(c.measure).unit;
  return own ? own : problem.unit();
}

const std::vector<std::string>& case_columns() {
  static const std::vector<std::string> kColumns = {"problem", "measure", "wrench", "lp",
                                                    "search",  "seed",    "budget"};
  return kColumns;
}

std::vector<std::string> case_values(const Case& c) {
  return {c.problem,
          c.measure,
          to_string(c.wrench),
          c.lp,
          c.search,
          fmt::format("{}", c.seed),
          fmt::format("{}", c.budget)};
}

std::vector<Case> product(const std::string& problem, std::uint64_t seed, long budget,
                          int contact_columns) {
  std::vector<Case> cases;
  for (const MeasureEntry& measure : measures()) {
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      const auto solvers = solvers_for(measure, wrench, contact_columns);
      for (const auto& [lp, cost] : solvers) {
        const bool first = lp == solvers.front().first;
        for (const SearchEntry& search : searches().first(first ? searches().size() : 2)) {
          cases.push_back(
              {problem, measure.name, wrench, lp, search.name, seed, std::max(1L, budget / cost)});
        }
      }
    }
  }
  return cases;
}

std::vector<Case> select(std::vector<Case> cases,
                         const std::map<std::string, std::string>& filter) {
  const std::vector<std::string>& columns = case_columns();
  for (const auto& entry : filter) {
    const std::string& column = entry.first;
    const std::string& value = entry.second;
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end()) {
      throw std::invalid_argument(
          fmt::format("column: got '{}', expected one of {}", column, fmt::join(columns, " ")));
    }
    if (column == "seed" || column == "budget") continue;
    const auto index = found - columns.begin();
    std::erase_if(cases, [&](const Case& c) { return case_values(c)[index] != value; });
    if (cases.empty()) {
      throw std::invalid_argument(
          fmt::format("{}: got '{}', expected a value that the product has together with the other "
                      "choices",
                      column, value));
    }
  }
  return cases;
}

}  // namespace maxwrench
