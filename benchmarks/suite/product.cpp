#include "benchmarks/suite/product.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <tuple>

#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "solvers/solve/tank.h"

namespace maxwrench {
namespace {

using Names = ProductColumns::Names;

bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The names of a column that are supported; an empty name means the first supported one, the
/// default.
Names wanted(const Names& column, const Names& supported) {
  if (column == Names{kAll} || supported.empty()) return supported;
  Names names;
  for (const std::string& name : column) {
    if (name.empty() || has(supported, name))
      names.push_back(name.empty() ? supported.front() : name);
  }
  return names;
}

/// The searches of a column whose stages are all supported.
Names wanted_searches(const Names& column, const Problem& problem, const Case& c) {
  const Names alone = supported_searches(problem, c.measure, c.wrench);
  const std::string usual = default_search(problem, c.measure, c.wrench);
  Names names = alone;
  std::erase(names, usual);
  names.insert(names.begin(), usual);
  if (column == Names{kAll}) return names;
  for (const std::string& name : column) {
    if (name.empty() || has(names, name)) continue;
    const std::vector<const SearchEntry*> stages = find_search(name).stages;
    const bool supports = std::all_of(stages.begin(), stages.end(), [&](const SearchEntry* stage) {
      return has(alone, stage->name);
    });
    if (supports) names.push_back(name);
  }
  return wanted(column, names);
}

/// The schemes that a problem can have, its own first. The spline needs two knots.
Names schemes_of(const Problem& problem) {
  if (!problem.motion) return {""};
  if (problem.motion->has_factor()) return {to_string(problem.motion->scheme)};
  Names names = scheme_names(problem.motion->impulse);
  if (problem.motion->k < 2) std::erase(names, to_string(Scheme::kSpline));
  const std::string own = to_string(problem.motion->scheme);
  std::erase(names, own);
  names.insert(names.begin(), own);
  return names;
}

long budget_of(const Problem& problem, const std::string& solver,
               const std::optional<long>& budget) {
  if (problem.motion) return budget.value_or(kTrajectoryBudget);
  const int cost = solver == kNoSolver ? 1 : find_wrench_solver(solver).cost;
  return std::max(1L, budget.value_or(kUsualBudget) / cost);
}

Names all_measures() {
  Names names;
  for (const MeasureEntry& measure : measures()) names.emplace_back(measure.name);
  return names;
}

/// Adds the cases of a measure, wrench, solver and scheme: with every search and seed, or with
/// every experiment.
void add_cases(const Problem& problem, const ProductColumns& columns, Case c,
               std::vector<Case>& cases) {
  if (!columns.integrator.empty()) {
    c.search.clear();
    c.budget = kUsualBudget;  // like in the row, although no search uses it
    for (const std::string& integrator :
         wanted(columns.integrator, supported_integrators(problem, c.measure))) {
      c.integrator = integrator;
      cases.push_back(c);
    }
    return;
  }
  c.budget = budget_of(problem, c.solver, columns.budget);
  for (const std::string& search : wanted_searches(columns.search, problem, c)) {
    c.search = search;
    for (const std::uint64_t seed : columns.seed) {
      c.seed = seed;
      cases.push_back(c);
    }
  }
}

}  // namespace

std::vector<Case> product(const Problem& problem, const ProductColumns& columns) {
  std::vector<Case> cases;
  for (const std::string& measure : wanted(columns.measure, all_measures())) {
    for (const std::string& wrench : wanted(columns.wrench, {"pure", "any"})) {
      Case c{problem.name, measure, parse_wrench(wrench)};
      for (const std::string& solver :
           wanted(columns.solver, supported_solvers(problem, measure, c.wrench))) {
        c.solver = solver;
        for (const std::string& scheme : wanted(columns.scheme, schemes_of(problem))) {
          c.scheme = scheme;
          add_cases(problem, columns, c, cases);
        }
      }
    }
  }
  return cases;
}

std::vector<Case> product(const Problem& problem, std::uint64_t seed, long budget) {
  const Names all = {kAll};
  const Names few = problem.motion ? Names{""} : Names{general_search(), "grid+cmaes"};
  std::vector<Case> cases =
      product(problem, ProductColumns{all, all, all, few, all, {seed}, budget});
  for (const Case& c : product(problem, ProductColumns{all, all, {""}, all, all, {seed}, budget})) {
    cases.push_back(c);
  }
  sort_cases(cases);
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
    const auto index = static_cast<std::size_t>(found - columns.begin());
    const auto name_of = [&](const Case& c) {
      const std::string name = case_values(c)[index];
      return name.empty() ? "none" : name;
    };
    std::set<std::string> existing;
    for (const Case& c : cases) existing.insert(name_of(c));
    std::erase_if(cases, [&](const Case& c) { return name_of(c) != value; });
    if (cases.empty()) {
      throw std::invalid_argument(
          fmt::format("{}: got '{}', expected one that is valid with the other choices: {}", column,
                      value, fmt::join(existing, " ")));
    }
  }
  return cases;
}

void sort_cases(std::vector<Case>& cases) {
  const auto key = [](const Case& c) {
    return std::tuple(c.problem, c.measure, std::string(to_string(c.wrench)), c.solver, c.search,
                      c.seed, c.budget, c.scheme, c.integrator);
  };
  std::sort(cases.begin(), cases.end(),
            [&](const Case& a, const Case& b) { return key(a) < key(b); });
  const auto end = std::unique(cases.begin(), cases.end(),
                               [&](const Case& a, const Case& b) { return key(a) == key(b); });
  cases.erase(end, cases.end());
}

}  // namespace maxwrench
