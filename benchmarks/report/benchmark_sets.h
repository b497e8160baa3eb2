#pragma once

#include <string>
#include <vector>

#include "benchmarks/race/performance_profile.h"
#include "benchmarks/race/race_summary.h"
#include "benchmarks/suite/results.h"

namespace maxwrench {

/// Lower-level solvers by the microseconds of an evaluation: one benchmark set for static tasks
/// with each wrench, and one for tasks in time. Its instances are all that differ in problem,
/// measure, wrench, search, seed or scheme and were tried with all solvers, two at least, that have
/// rows of their problem, measure and wrench (of several budgets the largest, for a budget is
/// divided by what a solver costs). What has no value has failed; a solver without such rows does
/// not serve, which counts as failed.
std::vector<BenchmarkSet> solver_benchmark_sets(const std::vector<ResultRow>& rows);

/// Integrators by the milliseconds of an experiment in the virtual tank: one benchmark set, none
/// without experiments by two. Its instances are those that differ in problem, measure, wrench,
/// solver or scheme and were tried with all; an experiment without a reading has failed.
std::vector<BenchmarkSet> integrator_benchmark_sets(const std::vector<ResultRow>& rows);

/// Races that belong together.
struct RaceGroup {
  std::string title;
  std::vector<Comparison> races;
};
/// All static tasks, then those of each family (the folder of the task) if there are several, then
/// all tasks in time.
std::vector<RaceGroup> race_groups(const std::vector<Comparison>& races);

/// Searches by the milliseconds to 0.1 % below the best known value; instances are problems and
/// seeds. The default search is the reference if all have the same. The group has a race.
BenchmarkSet search_benchmark_set(const RaceGroup& group);

}  // namespace maxwrench
