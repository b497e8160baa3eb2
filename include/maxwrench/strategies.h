#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "maxwrench/integrator.h"
#include "maxwrench/lp_solver.h"
#include "maxwrench/measure.h"
#include "maxwrench/objective.h"
#include "maxwrench/search.h"
#include "maxwrench/trajectory_program.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {

struct Problem;

/// beta of a measure on a problem, which outlives it; `needs_solver` is false for a closed form,
/// whose `make` ignores the solver.
struct MeasureEntry {
  const char* name;
  const char* summary;
  bool needs_solver;
  bool serves_any;   ///< false: rejects Wrench::kAny, which would mean nothing
  const char* unit;  ///< of its value; null: that of the wrench along c
  std::unique_ptr<Measure> (*make)(const Problem&, std::unique_ptr<WrenchSolver>);
};

/// A solver of general linear programs.
struct LpEntry {
  const char* name;
  const char* summary;
  /// About how much dearer one solve is than that of our own solvers; the benchmark's budgets are
  /// divided by it.
  int cost;
  std::unique_ptr<LpSolver> (*make)();
};

/// A lower-level solver, the `--solver` of the command line: one that knows the structure, or a
/// general one on the assembled program.
struct WrenchSolverEntry {
  const char* name;
  const char* summary;
  bool one_column_only;  ///< true: rejects Wrench::kAny and second contacts
  bool needs_facets;     ///< true: rejects actuators with too many facets to enumerate
  int cost;              ///< as LpEntry
  std::function<std::unique_ptr<WrenchSolver>()> make;
};

/// A solver of the programs of trajectories: one that knows the structure, or a general one on the
/// assembled program.
struct TrajectorySolverEntry {
  const char* name;
  const char* summary;
  std::function<std::unique_ptr<TrajectorySolver>()> make;
};

/// One method alone.
struct SearchEntry {
  const char* name;
  const char* summary;
  bool local;  ///< true: local searches from one posture, and finds no better maximum elsewhere
  std::unique_ptr<Search> (*make)();
  /// Whether it begins where an earlier search has been (`SearchOptions::starts`), so that it can
  /// be a later stage.
  bool accepts_starts = false;
  /// Of the budget, as a stage that others follow; 0: one part for each stage that is left.
  double budget_fraction = 0;
  /// About how much dearer an evaluation is with it than with others; the race's budgets are
  /// divided by it.
  int cost = 1;
  /// Of tasks in time: `solve` lets it maximise `TrajectoryValue::kThroughout`, which it asks for
  /// seldom.
  bool throughout = false;
};

struct IntegratorEntry {
  const char* name;
  const char* summary;
  bool stiff;  ///< true: its steps are not bounded by what decays fast
  std::unique_ptr<Integrator> (*make)();
};

/// The tables: every strategy that exists, once. The wrench solvers begin with those that know the
/// structure, the LP solvers follow; so do the trajectory solvers.
std::span<const MeasureEntry> measures();
std::span<const LpEntry> lp_solvers();
std::span<const WrenchSolverEntry> wrench_solvers();
std::span<const TrajectorySolverEntry> trajectory_solvers();
std::span<const SearchEntry> searches();
/// Searches of trajectories alone: of tasks in time, and of static ones by linf_polytope, which are
/// trajectories of one knot. Those of postures serve stacked knots too.
std::span<const SearchEntry> trajectory_searches();
/// Searches of static tasks by linf_polytope, of robots whose actuators have few facets.
std::span<const SearchEntry> facet_searches();
std::span<const IntegratorEntry> integrators();
/// The names of those that serve the virtual tank, whose load cell is stiff.
std::vector<std::string> stiff_integrators();

/// A strategy that this build leaves out. `family` is that of its table: lp, search or integrator.
struct Absent {
  const char* family;
  const char* name;
  const char* library;  ///< that it needs
};
std::span<const Absent> not_built_in();

/// Whether the strategy with this name needs a library that only one thread may use at once, so
/// that cases with it wait for each other.
bool one_at_a_time(std::string_view name);

/// The entry with this name; throws std::invalid_argument that names the alternatives, and the
/// library that is missing if this build leaves the entry out.
const MeasureEntry& find_measure(std::string_view name);
const LpEntry& find_lp_solver(std::string_view name);
const WrenchSolverEntry& find_wrench_solver(std::string_view name);
const TrajectorySolverEntry& find_trajectory_solver(std::string_view name);
/// A method of any table, or stages joined by '+'. Also throws if a later stage cannot go on.
inline constexpr std::string_view kRestarted = "restart:";
NamedSearch find_search(std::string_view name);
const IntegratorEntry& find_integrator(std::string_view name);

}  // namespace maxwrench
