#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/search.h"
#include "maxwrench/solve.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

struct MeasureEntry;
struct TrajectorySolverEntry;

/// More evaluations than anyone waits for: a grid keeps all their values.
inline constexpr int kMostBudget = 100'000'000;

/// The table entries that a case names, looked up once, on a problem that outlives it.
struct Method {
  Case choice;  ///< complete: nothing is left to defaults
  const MeasureEntry* measure = nullptr;
  std::optional<NamedSearch> search;  ///< none: the posture or trajectory is given
  /// Of a task in time. Of a static one: the search is one of trajectories and gets those of one
  /// knot, solved by this one; null: it gets postures.
  const TrajectorySolverEntry* trajectory_solver = nullptr;
  TrajectoryValue trajectory_value =
      TrajectoryValue::kAtInstants;  ///< what the search of a task in time maximises
  const char* unit = "";             ///< of the value
  /// Of a static task.
  MeasureMaker make_measure;
  /// linf_polytope with the same wrenches by the reference solver, see `Answer::beta_linf`.
  MeasureMaker make_beta_linf;
};

/// Whether trajectory searches serve a static task, which is a trajectory of one knot: by
/// linf_polytope, without a second contact.
bool serves_as_trajectory(const Problem& problem, const std::string& measure);

/// Whether searches between facets serve: linf_polytope of a static task, few facets.
bool serves_between_facets(const Problem& problem, const std::string& measure);

/// The names of the lower-level solvers that serve a measure and a wrench, `kNoSolver` of a closed
/// form; none if they mean nothing together. The first one is the default.
std::vector<std::string> served_solvers(const Problem& problem, const std::string& measure,
                                        Wrench wrench);

/// The methods alone that serve a measure, those of a task in time first.
std::vector<std::string> served_searches(const Problem& problem, const std::string& measure);

/// Without a search if the case names none. Throws std::invalid_argument on a name that does not
/// exist and on a choice without meaning, such as `facets` for several wrench columns or for
/// actuators with too many facets, a solver for a closed form, or a scheme that is not the task's.
Method resolve(const Problem& problem, const Case& c);
Method resolve(const Problem&& problem, const Case& c) = delete;

/// Replaces what a task in time says. Throws std::invalid_argument, which names `key`, unless it
/// has a scheme of this name.
void set_scheme(const char* key, const std::string& scheme, Problem& problem);

/// What the search of a method maximises.
std::unique_ptr<Objective> make_objective(const Problem& problem, const Method& method,
                                          std::shared_ptr<Tally> tally = nullptr);
std::unique_ptr<Objective> make_objective(const Problem&&, const Method&,
                                          std::shared_ptr<Tally> = nullptr) = delete;

/// Runs the search of a method from the default of the task: seed, budget and start of the options
/// are the method's.
SearchResult run_search(const Problem& problem, const Method& method, Objective& objective,
                        SearchOptions options);

}  // namespace maxwrench
