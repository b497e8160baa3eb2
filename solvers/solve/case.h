#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/search.h"

namespace maxwrench {

struct MeasureEntry;
struct PlanSolverEntry;
struct Problem;

/// The name of the lower-level solver of a closed-form measure.
inline constexpr const char* kNoSolver = "none";

/// More evaluations than anyone waits for: a grid keeps all their values.
inline constexpr int kMostBudget = 100'000'000;

/// A choice of names: everything that decides a result.
struct Case {
  std::string problem = "";
  std::string measure = "linf_polytope";
  Wrench wrench = Wrench::kPure;
  /// Empty: the first solver that serves problem and wrench, `kNoSolver` for a closed form.
  std::string lp = "";
  std::string search = default_search();  ///< empty: none, the posture is given
  std::uint64_t seed = 1;
  long budget = 20000;  ///< evaluations of a search
  /// Of a task in time, how knots become motion; empty: as the task says, or a static one.
  std::string scheme = "";
  /// Of the virtual tank, which tries the default posture or plan; empty: no experiment.
  std::string integrator = "";
};

/// "pure" or "any"; throws std::invalid_argument otherwise.
Wrench parse_wrench(const std::string& name);

/// The table entries that a case names, looked up once, on a problem that outlives it.
struct Method {
  Case choice;  ///< complete: nothing is left to defaults
  const MeasureEntry* measure = nullptr;
  std::optional<NamedSearch> search;  ///< none: the posture is given
  /// The search is one of plans and gets those of one knot, solved by this one; null: it gets
  /// postures.
  const PlanSolverEntry* plan_solver = nullptr;
  const char* unit = "";  ///< of beta
  MeasureMaker make_measure;
  /// linf_polytope with the same wrenches by the reference solver, see `Row`.
  MeasureMaker make_yardstick;
};

/// Whether searches of plans serve a static task, which is a plan of one knot: by linf_polytope,
/// without a second contact.
bool serves_as_plan(const Problem& problem, const std::string& measure);

/// Whether searches between facets serve: linf_polytope of a static task, few facets.
bool serves_between_facets(const Problem& problem, const std::string& measure);

/// The names of the lower-level solvers that serve a measure and a wrench, `kNoSolver` of a closed
/// form; none if they mean nothing together. The first one is the default.
std::vector<std::string> served_solvers(const Problem& problem, const std::string& measure,
                                        Wrench wrench);

/// The methods alone that serve a measure, those of a task in time first.
std::vector<std::string> served_searches(const Problem& problem, const std::string& measure);

/// Throws std::invalid_argument on a name that does not exist and on a choice without meaning, such
/// as `facets` for several wrench columns or for actuators with too many facets, or a solver for a
/// closed form.
Method resolve(const Problem& problem, const Case& c);
Method resolve(const Problem&& problem, const Case& c) = delete;

/// Replaces what a task in time says. Throws std::invalid_argument, which names `key`, unless it
/// has a scheme of this name.
void set_scheme(const char* key, const std::string& scheme, Problem& problem);

/// The search that is best in general for a measure of a static task: between facets where that
/// serves, going on by `cmaes` from where it has been (its ends may collide, and it is blind to
/// pairs of which only a test is known), else that of any objective.
std::string best_search(const Problem& problem, const std::string& measure);

/// The columns that select a case, `problem measure wrench lp search seed budget scheme
/// integrator`, as text.
const std::vector<std::string>& case_columns();
std::vector<std::string> case_values(const Case& c);

}  // namespace maxwrench
