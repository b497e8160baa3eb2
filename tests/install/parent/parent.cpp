// Whatever libraries the tables were built with, each solver and search in them works.
#include <cstdio>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"

using namespace maxwrench;

int main() {
  const Problem problem = load_problem("planar/force");
  SearchOptions options;
  options.budget = 300;
  for (const WrenchSolverEntry& solver : wrench_solvers()) {
    const auto objective = make_capability_objective(
        problem, Wrench::kPure, [&] { return make_linf_polytope(problem.robot, solver.make()); });
    for (const SearchEntry& search : searches()) {
      const SearchResult best = search.make()->maximize(*objective, options);
      std::printf("%s %s %s\n", solver.name, search.name, to_string(best.status));
    }
  }
  for (const Absent& absent : not_built_in()) std::printf("no %s\n", absent.name);
}
