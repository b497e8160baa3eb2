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

/// The largest evaluation budget: a grid stores all values.
inline constexpr int kMostBudget = 100'000'000;

/// The table entries that a case names, looked up once, for a problem that must outlive them.
struct Method {
  Case choice;  ///< complete, with all defaults filled in
  const MeasureEntry* measure = nullptr;
  std::optional<NamedSearch> search;  ///< none: the posture or trajectory is given
  /// For a task in time: the solver. For a static task: if not null, the search is one of
  /// trajectories and gets trajectories of one knot, solved by this solver; if null, the search
  /// gets postures.
  const TrajectorySolverEntry* trajectory_solver = nullptr;
  TrajectoryValue trajectory_value =
      TrajectoryValue::kAtInstants;  ///< what the search of a task in time maximises
  const char* unit = "";             ///< of the value
  /// For a static task.
  MeasureMaker make_measure;
  /// linf_polytope with the same wrenches and the reference solver, see `Answer::beta_linf`.
  MeasureMaker make_beta_linf;
};

/// How the postures of a static task are evaluated, without any search.
struct LowerLevel {
  const MeasureEntry* measure = nullptr;
  const char* solver = "";  ///< the name of the solver, `kNoSolver` for a closed form
  const char* unit = "";    ///< of the value
  MeasureMaker make_measure;
};

/// Resolves measure, wrench and solver of a case of a static task, which must outlive the result.
/// Throws std::invalid_argument as `resolve`.
LowerLevel resolve_lower_level(const Problem& problem, const Case& c);
LowerLevel resolve_lower_level(const Problem&& problem, const Case& c) = delete;

/// Whether trajectory searches support a static task, as a trajectory of one knot: only with
/// linf_polytope and without a second contact.
bool supported_as_trajectory(const Problem& problem, const std::string& measure);

/// Whether searches between facets support the problem: linf_polytope of a static task, with few
/// facets.
bool supported_between_facets(const Problem& problem, const std::string& measure, Wrench wrench);

/// The names of the lower-level solvers that support a measure and a wrench, `kNoSolver` for a
/// closed form. Empty if the measure does not support the wrench. The first one is the default.
std::vector<std::string> supported_solvers(const Problem& problem, const std::string& measure,
                                           Wrench wrench);

/// The single methods that support a measure, those of a task in time first.
std::vector<std::string> supported_searches(const Problem& problem, const std::string& measure,
                                            Wrench wrench);

/// Has no search if the case names none. Throws std::invalid_argument on a name that does not exist
/// and on an invalid choice, such as `facets` for several wrench columns or for actuators with too
/// many facets, a solver for a closed form, or a scheme that the task does not have.
Method resolve(const Problem& problem, const Case& c);
Method resolve(const Problem&& problem, const Case& c) = delete;

/// The number of threads of `Options::threads`, where 0 stands for one per core. Throws
/// std::invalid_argument if it is out of range.
int thread_count(int threads);

/// Whether the residual of a result with efforts is small enough to count as solved.
bool satisfies_program(const Capability& capability);

/// How an evaluation with a measure ended: with a result of the measure that satisfies its program,
/// or why not. For an invalid posture the reason is that of `describe_violation`.
Verdict verdict_of(const Problem& problem, const Posture& posture, const Capability& capability);

/// Throws std::invalid_argument for tasks and joints (J) that `evaluate_posture` does not support.
void require_joints(const Problem& task, const Eigen::VectorXd& q);

/// Replaces the scheme of a task in time. Throws std::invalid_argument, which names `key`, unless
/// the problem is a task in time that has a scheme of this name.
void set_scheme(const char* key, const std::string& scheme, Problem& problem);

/// What the search of a method maximises.
std::unique_ptr<Objective> make_objective(const Problem& problem, const Method& method,
                                          std::shared_ptr<Tally> tally = nullptr);
std::unique_ptr<Objective> make_objective(const Problem&&, const Method&,
                                          std::shared_ptr<Tally> = nullptr) = delete;

/// Runs the search of a method from the default of the task. Seed, budget and start of the options
/// are replaced by the method's.
SearchResult run_search(const Problem& problem, const Method& method, Objective& objective,
                        SearchOptions options);

}  // namespace maxwrench
