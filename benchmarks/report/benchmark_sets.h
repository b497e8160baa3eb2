#pragma once

#include <string>
#include <vector>

#include "benchmarks/race/performance_profile.h"
#include "benchmarks/race/race_summary.h"
#include "benchmarks/suite/results.h"

namespace maxwrench {

/// Lower-level solvers, by the microseconds of an evaluation: one benchmark set for static tasks
/// with each wrench, and one for tasks in time. Instances differ in problem, measure, wrench,
/// search, seed or scheme. An instance counts if it was tried with all solvers, at least two, that
/// have rows of its problem, measure and wrench. Of several budgets the largest counts, because a
/// budget is divided by a solver's cost. A row without a value counts as failed, and so does a
/// solver without such rows, which does not support the instance.
std::vector<BenchmarkSet> solver_benchmark_sets(const std::vector<ResultRow>& rows);

/// Integrators, by the milliseconds of an experiment in the virtual tank: one benchmark set, or
/// none unless there are experiments by two integrators. Instances differ in problem, measure,
/// wrench, solver or scheme and were tried with all integrators. An experiment without a reading
/// counts as failed.
std::vector<BenchmarkSet> integrator_benchmark_sets(const std::vector<ResultRow>& rows);

/// A group of races.
struct RaceGroup {
  std::string title;
  std::vector<Comparison> races;
};
/// All static tasks, then those of each family (the folder of the task) if there are several, then
/// all tasks in time.
std::vector<RaceGroup> race_groups(const std::vector<Comparison>& races);

/// Searches, by the milliseconds to 0.1 % below the best known value; instances are problems and
/// seeds. The default search is the reference if it is the same in all races. The group must have
/// at least one race.
BenchmarkSet search_benchmark_set(const RaceGroup& group);

}  // namespace maxwrench
