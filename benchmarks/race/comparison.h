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

/// One run of a search on one thread, with the processor time of that thread, which excludes other
/// programs and other attempts. Evaluations and seconds both follow the order in which the thread
/// evaluated.
struct Attempt {
  Case choice;
  double value = -kInfinity;
  Eigen::VectorXd found;  ///< the point found
  /// For a trajectory, the value between its instants (`Trajectory::value_between_knots`); NaN if
  /// there is none.
  double value_between_knots = std::numeric_limits<double>::quiet_NaN();
  RaceRun run;         ///< the cost of the whole run, as the search counts it
  double counted = 0;  ///< number of evaluations that were timed
};

/// All searches of a task in time maximise the same value, that at the instants
/// (`TrajectoryValue::kAtInstants`). The answer is checked from the problem's data, outside the
/// measured time. An answer that fails the check counts as none.
Attempt attempt(const Problem& problem, const Method& method,
                const std::function<bool()>& interrupted = {});

/// All attempts of one search with one lower-level solver.
struct Contender {
  std::string search, solver;
  long budget = 0;                ///< evaluations of each attempt
  std::vector<Attempt> attempts;  ///< seeds 1, 2, ...; if interrupted, those that had begun

  std::vector<RaceRun> runs() const;
  /// The median over the attempts of the shortfall of their best value so far from `best`, as a
  /// share of it. Infinity until half of them have a value, and if `best` is zero or there is none.
  double shortfall_after(double evaluations, double best) const;
  /// `expected_running_time` of its runs.
  double expected(double target, Cost cost) const;
};

/// All searches on one problem.
struct Comparison {
  std::string problem, unit;
  std::vector<Contender> contenders;  ///< in the order of the table of searches
  /// The standard approach with general LP solvers, GLPK and Clp if they are built in:
  /// annealing+cmaes, or the paper's multistart for a task in time. Empty if the measure needs no
  /// solver.
  std::vector<Contender> peers;
  std::string default_search;  ///< the default of `solve`
  bool in_time = false;        ///< a task in time
  long budget = 0;             ///< the largest of the contenders
  bool interrupted = false;    ///< attempts are missing
  /// A proven bound on all postures that is nearer to the best value than the lowest target, if
  /// there is one.
  std::optional<double> proven = std::nullopt;

  /// The peer that all speeds refer to: the one with the least expected time to `target`, the first
  /// of equals; null if there is none.
  const Contender* reference() const;
  /// The best of all attempts; -infinity if none has a value.
  Candidate best_found() const;
  bool has_value() const { return best_found().value > -kInfinity; }
  /// The value that targets refer to: the proven bound, or the best value of all attempts.
  double best() const;
  /// The target that is a share below `best`.
  double target(double share) const { return target_below(best(), share); }
  /// The target used where there is only one: a thousandth below `best`.
  double target() const { return target(1e-3); }
};

struct RaceOptions {
  int seeds = 20;
  /// The number of parallel attempts. Attempts with Ipopt wait for each other; this waiting is not
  /// counted.
  int threads = 1;
  /// Divides the budget of a search with expensive evaluations by its `SearchEntry::cost`.
  bool shares_budget = true;
  std::function<void()> done;  ///< called after each attempt, from any thread; may be empty
  /// Once it returns true, no attempt begins and running ones end early. May be empty.
  std::function<bool()> interrupted = {};
};

/// Computes the data that all searches on a problem share (`IkStartSystem`), outside the measured
/// time. Otherwise the first search would include it.
void prepare(const Problem& problem, int threads);

/// Runs every search that supports the problem with seeds 1 to `seeds`. `base` holds measure,
/// wrench, solver, budget and the default search. The values do not depend on the threads.
Comparison compare(const Problem& problem, const Case& base, const RaceOptions& options);
/// The number of attempts of `compare`.
long attempt_count(const Problem& problem, const Case& base, int seeds);

}  // namespace maxwrench
