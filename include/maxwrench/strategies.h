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

/// @file
/// The tables of all measures, solvers, searches and integrators, by name, and your own entries.

namespace maxwrench {

struct Problem;

/// A capability measure in the table.
struct MeasureEntry {
  const char* name;     ///< as on the command line
  const char* summary;  ///< one line of description
  bool needs_solver;    ///< false: a closed form, for which `make` ignores the solver
  bool supports_any;    ///< false: rejects Wrench::kAny, which would have no meaning
  const char* unit;     ///< of its value; null: that of the wrench along c
  /// Makes the measure for a problem, which must outlive it.
  std::function<std::unique_ptr<Measure>(const Problem&, std::unique_ptr<WrenchSolver>)> make;
  /// Whether the value is an acceleration along c: its unit is then `Problem::acceleration_unit`.
  /// It needs the masses of a robot without gears, and a task of one contact.
  bool acceleration = false;
};

/// A solver of general linear programs in the table.
struct LpEntry {
  const char* name;     ///< as on the command line
  const char* summary;  ///< one line of description
  /// The approximate cost of one solve, as a multiple of that of our own solvers. The budgets of
  /// the benchmark are divided by it.
  int cost;
  std::unique_ptr<LpSolver> (*make)();  ///< makes the solver
};

/// A solver of wrench programs in the table, the `--solver` of the command line.
///
/// It either exploits the structure, or is a general solver applied to the assembled program.
struct WrenchSolverEntry {
  const char* name;      ///< as on the command line
  const char* summary;   ///< one line of description
  bool one_column_only;  ///< true: rejects Wrench::kAny and second contacts
  bool needs_facets;     ///< true: rejects actuators with too many facets to enumerate
  int cost;              ///< as `LpEntry::cost`
  std::function<std::unique_ptr<WrenchSolver>()> make;  ///< makes the solver
};

/// A solver of trajectory programs in the table.
///
/// It either exploits the structure, or is a general solver applied to the assembled program.
struct TrajectorySolverEntry {
  const char* name;                                         ///< as on the command line
  const char* summary;                                      ///< one line of description
  std::function<std::unique_ptr<TrajectorySolver>()> make;  ///< makes the solver
};

/// A search in the table: a single method, without stages.
struct SearchEntry {
  const char* name;     ///< as on the command line
  const char* summary;  ///< one line of description
  bool local;           ///< true: a local search from one posture, which finds no better maximum
                        ///< elsewhere
  std::function<std::unique_ptr<Search>()> make;  ///< makes the search
  /// Whether it continues from the points of an earlier search (`SearchOptions::starts`). Only then
  /// can it be a later stage.
  bool accepts_starts = false;
  /// The fraction of the remaining budget that it gets as a stage with later ones. 0: an equal
  /// share among itself and the later stages.
  double budget_fraction = 0;
  /// The approximate cost of an evaluation, as a multiple of that of other searches. The budgets of
  /// `compare` are divided by it.
  int cost = 1;
  /// For tasks in time: whether `solve` lets it maximise `TrajectoryValue::kThroughout`, because it
  /// requests this value seldom.
  bool throughout = false;
};

/// An integrator in the table.
struct IntegratorEntry {
  const char* name;                       ///< as on the command line
  const char* summary;                    ///< one line of description
  bool stiff;                             ///< true: fast decaying components do not limit its steps
  std::unique_ptr<Integrator> (*make)();  ///< makes the integrator
};

/// Returns the table of the measures that are built in.
std::span<const MeasureEntry> measures();
/// Returns the table of solvers of linear programs.
std::span<const LpEntry> lp_solvers();
/// Returns the table of solvers of wrench programs: those that exploit the structure first, then
/// the solvers of linear programs.
std::span<const WrenchSolverEntry> wrench_solvers();
/// Returns the table of solvers of trajectory programs: those that exploit the structure first,
/// then the solvers of linear programs.
std::span<const TrajectorySolverEntry> trajectory_solvers();
/// Returns the table of the searches of postures that are built in. They also support stacked
/// knots.
std::span<const SearchEntry> searches();
/// Returns the table of trajectory searches.
///
/// They support tasks in time. They also support static tasks with linf_polytope, as trajectories
/// of one knot.
std::span<const SearchEntry> trajectory_searches();
/// Returns the table of searches between facets.
///
/// They support static tasks with linf_polytope, for robots whose actuators have few facets.
std::span<const SearchEntry> facet_searches();
/// Returns the table of searches for transfers.
///
/// They reject all other tasks with std::invalid_argument. It is empty in a build without SUNDIALS.
std::span<const SearchEntry> transfer_searches();
/// Returns the table of searches for tasks along a path, the methods by which others plan such
/// motions: they choose what to do at an instant from what they see of the next ones. They reject
/// all other tasks with std::invalid_argument.
std::span<const SearchEntry> path_searches();
/// Returns the table of integrators.
std::span<const IntegratorEntry> integrators();
/// Returns the names of the integrators that the virtual tank supports. Its load cell is stiff.
std::vector<std::string> stiff_integrators();

/// A measure, solver, search or integrator that this build leaves out.
struct Absent {
  const char* family;   ///< its table: "lp", "search" or "integrator"
  const char* name;     ///< its name
  const char* library;  ///< the library that it needs
};
/// Returns what this build leaves out.
std::span<const Absent> not_built_in();

/// Adds a measure of your own.
///
/// From then on `find_measure`, `solve`, `evaluate` and all others that take the name of a measure
/// know it. `measures` does not list it. The texts are copied. Of an entry:
///
/// * `needs_solver` false: `make` gets no solver, and `Case::solver` must be empty or `kNoSolver`.
///   true: `make` gets the chosen solver of wrench programs.
/// * `supports_any` true: the measure supports `Wrench::kAny`. If it needs no solver, tasks with
///   finite limits of contact forces are then rejected, as for the closed forms.
/// * `unit` null: the value is a wrench along c, in the unit of the task.
///
/// `make` is called from any thread, once for each part of a search that runs in parallel. What it
/// throws, and what the measure throws, reaches the caller of `solve` or `evaluate`. A task in time
/// supports no measure of yours.
///
/// You may add a name again. Later calls use the new entry, and earlier ones keep theirs: no entry
/// is ever destroyed. The function may be called from any thread.
///
/// @param entry  the measure
/// @throws std::invalid_argument if the name is empty, has a character other than a letter, a digit
///         and '_', or is that of a built-in measure, or if `make` is empty. Later, if `make`
///         returns null.
void add_measure(MeasureEntry entry);

/// Adds a search of your own.
///
/// From then on `find_search`, `solve` and all others that take the name of a search know it, also
/// as a stage and with the prefix `kRestarted`. `searches` does not list it. The texts are copied.
/// Make, names and threads are as for `add_measure`.
///
/// The search need not set `SearchResult::interrupted`.
///
/// @param entry  the search
/// @throws std::invalid_argument as `add_measure`, and if `budget_fraction` is not from 0 to 1 or
///         `cost` is less than 1. Later, if the search makes no evaluation without being
///         interrupted or more than its budget, or if a point is beyond the bounds or malformed.
void add_search(SearchEntry entry);

/// Returns whether the entry with this name needs a library that only one thread may use at a time.
///
/// Cases with such an entry wait for each other.
bool one_at_a_time(std::string_view name);

/// Returns the measure with this name, built in or added.
///
/// @throws std::invalid_argument that lists the alternatives. If this build leaves the entry out,
///         it names the missing library.
const MeasureEntry& find_measure(std::string_view name);
/// Returns the solver of linear programs with this name.
///
/// @throws std::invalid_argument as `find_measure`.
const LpEntry& find_lp_solver(std::string_view name);
/// Returns the solver of wrench programs with this name.
///
/// @throws std::invalid_argument as `find_measure`.
const WrenchSolverEntry& find_wrench_solver(std::string_view name);
/// Returns the solver of trajectory programs with this name.
///
/// @throws std::invalid_argument as `find_measure`.
const TrajectorySolverEntry& find_trajectory_solver(std::string_view name);
/// The prefix of the name of a search that is restarted.
inline constexpr std::string_view kRestarted = "restart:";
/// Returns the search with this name.
///
/// @param name  a method of any table or an added one, or stages joined by '+', see `NamedSearch`
/// @throws std::invalid_argument as `find_measure`, and if a later stage cannot continue from the
///         points of the earlier ones.
NamedSearch find_search(std::string_view name);
/// Returns the integrator with this name.
///
/// @throws std::invalid_argument as `find_measure`.
const IntegratorEntry& find_integrator(std::string_view name);

}  // namespace maxwrench
