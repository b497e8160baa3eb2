#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lib/objective.h"
#include "lib/problem.h"

namespace maxwrench {

/// The name of the lower-level solver of a closed-form measure.
inline constexpr const char* kNoSolver = "none";

/// A choice of names: everything that decides a result.
struct Case {
  std::string problem = "";
  std::string measure = "linf_polytope";
  Wrench wrench = Wrench::kPure;
  /// Empty: the first solver that serves the wrench, `kNoSolver` for a closed form.
  std::string lp = "";
  std::string search = "grid";
  std::uint64_t seed = 1;
  long budget = 20000;  ///< evaluations of a search
};

/// "pure" or "any"; throws std::invalid_argument otherwise.
Wrench parse_wrench(const std::string& name);

/// Sets an empty `lp` to its default. Throws std::invalid_argument on a name that does not exist
/// and on a choice without meaning, such as `facets` for several wrench columns or a solver for a
/// closed form.
Case complete(Case c);

/// The case that can be solved on this robot: `box` takes over from `facets` if its actuators have
/// too many facets to enumerate.
Case fit(const Problem& problem, Case c);

/// The unit of a case's value.
const char* unit(const Problem& problem, const Case& c);

/// Makes the measure of a completed case.
MeasureMaker measure_maker(const Problem& problem, const Case& c);

/// The columns that select a case, `problem measure wrench lp search seed budget`, as text.
const std::vector<std::string>& case_columns();
std::vector<std::string> case_values(const Case& c);

/// On a problem, in the order of the tables: every meaningful measure × wrench × lp with the first
/// two searches (what a solver is worth does not depend on the search), and with the first lp that
/// serves every search. The budget is divided by the cost of the solver.
std::vector<Case> product(const std::string& problem, std::uint64_t seed, long budget);

/// Of `cases`, those whose columns have the given values (column -> value); `seed` and `budget` are
/// no filters. Throws std::invalid_argument on an unknown column, or if no case is left.
std::vector<Case> select(std::vector<Case> cases, const std::map<std::string, std::string>& filter);

}  // namespace maxwrench
