#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/race/race_statistics.h"
#include "maxwrench/search.h"
#include "maxwrench/solve.h"

namespace maxwrench {

struct Method;

/// One run of a search on one thread, with the time of that thread's processor: what other programs
/// and other attempts use does not count. Evaluations and seconds are those of the same order, in
/// which the thread evaluated.
struct Attempt {
  Case choice;
  double value = -kInfinity;
  Eigen::VectorXd found;  ///< its point
  /// Of a trajectory, that between its instants (`Trajectory::value_between_knots`); NaN: none.
  double value_between_knots = std::numeric_limits<double>::quiet_NaN();
  RaceRun run;         ///< what was spent in the whole run as the search counts it
  double counted = 0;  ///< evaluations that the clock saw: as many
};

/// All searches of a task in time maximise the same, the value at the instants
/// (`TrajectoryValue::kAtInstants`). The answer is checked from the problem's data outside the
/// clock; one that fails is none.
Attempt attempt(const Problem& problem, const Method& method,
                const std::function<bool()>& interrupted = {});

/// All attempts of one search through one lower-level solver.
struct Contender {
  std::string search, solver;
  long budget = 0;                ///< evaluations of each attempt
  std::vector<Attempt> attempts;  ///< seeds 1, 2, ...; of a problem that was interrupted, those
                                  ///< that had begun

  std::vector<RaceRun> runs() const;
  /// The median over the attempts of how far their best value so far stays below `best`, as a share
  /// of it; infinity until half of them have a value, and if `best` is zero or none.
  double shortfall_after(double evaluations, double best) const;
  /// `expected_running_time` of its runs.
  double expected(double target, Cost cost) const;
};

/// All searches on one problem.
struct Comparison {
  std::string problem, unit;
  std::vector<Contender> contenders;  ///< in the order of the tables of searches
  /// The plain way through general solvers of linear programs, GLPK and Clp as far as they are
  /// built in: annealing+cmaes, of a task in time the paper's multistart. None if the measure takes
  /// no solver.
  std::vector<Contender> peers;
  std::string default_search;  ///< that of `solve`
  bool in_time = false;        ///< a task in time
  long budget = 0;             ///< the largest of the contenders
  bool interrupted = false;    ///< attempts are missing
  /// No posture has more: a bound that is nearer to the best value than the lowest target, if one
  /// was proven.
  std::optional<double> proven = std::nullopt;

  /// Of `peers` the one from which every speed is a multiple: that with the least expected time to
  /// `target`, the first of equals; null: none.
  const Contender* reference() const;
  /// Of all attempts; -infinity if none has a value.
  Candidate best_found() const;
  bool has_value() const { return best_found().value > -kInfinity; }
  /// What targets lie below: what is proven, or the best value of all attempts.
  double best() const;
  /// The target at a share below it.
  double target(double share) const { return target_below(best(), share); }
  /// What counts as reached where one target stands for all: a thousandth below.
  double target() const { return target(1e-3); }
};

struct RaceOptions {
  int seeds = 20;
  /// Attempts side by side. Those with Ipopt wait for each other; that is no time of theirs.
  int threads = 1;
  /// Of searches whose evaluations are dear (`SearchEntry::cost`) the budget is divided by that.
  bool shares_budget = true;
  std::function<void()> done;  ///< called after each attempt, from any thread; may be empty
  /// Once it says true, no attempt begins and those that run end early. May be empty.
  std::function<bool()> interrupted = {};
};

/// Makes what all searches on a problem share (`IkStartSystem`), outside of any clock: who asks
/// first would pay for all.
void prepare(const Problem& problem, int threads);

/// Runs every search that serves the problem with seeds 1 to `seeds`; `base` holds measure, wrench,
/// solver, budget and the default search. The values do not depend on the threads.
Comparison compare(const Problem& problem, const Case& base, const RaceOptions& options);
/// How many attempts that makes.
long attempt_count(const Problem& problem, const Case& base, int seeds);

}  // namespace maxwrench
