#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmarks/case.h"
#include "benchmarks/interruption.h"
#include "maxwrench/search.h"

namespace maxwrench {

struct PlanMethod;

/// One run of a search on one thread, perhaps cut short, with the time of the processor (what other
/// programs use does not count).
struct Attempt {
  Case choice;
  double value = -kInfinity;
  /// Of a plan, that between its instants (`Plan::continuous`); NaN: none.
  double continuous = std::numeric_limits<double>::quiet_NaN();
  long evaluations = 0;
  double seconds = 0;                ///< of the whole run
  std::vector<Improvement> history;  ///< by evaluations
  std::vector<double> improved_at;   ///< seconds of each rise of the best value ...
  std::vector<double> improved_to;   ///< ... and the value it rose to

  /// Evaluations until the best value reached `target`, infinity if it never did.
  double evaluations_to(double target) const;
  double seconds_to(double target) const;
  /// The best value after so many evaluations, -infinity before the first.
  double value_after(double count) const;
};

Attempt attempt(const Problem& problem, const Method& method, Interruption* interruption = nullptr);
Attempt attempt(const Problem& problem, const PlanMethod& method,
                Interruption* interruption = nullptr);

/// All attempts of one search through one lower-level solver.
struct Contender {
  std::string search, lp;
  std::vector<Attempt> attempts;  ///< seeds 1, 2, ...

  /// The median over the attempts of how far their best value so far stays below `best`, as a share
  /// of it; infinity until half of them have a value, and if `best` is zero or none.
  double shortfall_after(double evaluations, double best) const;
  /// The expected running time to `target` of a search that is started again with another seed
  /// until it reaches it: the seconds to it, and all those of the attempts that miss it, over the
  /// number of those that reach it. Infinity if none does.
  double expected_seconds(double target) const;
};

/// All searches on one problem.
struct Comparison {
  std::string problem, unit;
  std::vector<Contender> contenders;  ///< in the order of the tables of searches
  /// The plain way, of which every speed is a multiple: annealing+cmaes through GLPK, of a task in
  /// time the paper's multistart through Clp, both general solvers of linear programs. No attempts
  /// if this build has none or the measure takes none.
  Contender reference;
  bool in_time = false;      ///< a task in time
  long budget = 0;           ///< evaluations of each attempt
  bool interrupted = false;  ///< attempts are missing, and the last one was cut short

  bool has_value() const { return best() > -kInfinity; }
  /// The best value of all attempts, -infinity if none has one.
  double best() const;
  /// What counts as reached: a thousandth below the best; infinity, which nothing reaches, if there
  /// is no value.
  double target() const;
};

/// Runs every search that serves the problem with `seeds` seeds; `base` holds measure, wrench, lp
/// and budget. `done` is called after each attempt. After an interruption no attempt begins.
Comparison compare(const Problem& problem, const Case& base, int seeds,
                   const std::function<void()>& done, Interruption* interruption = nullptr);
/// How many attempts that makes.
long attempt_count(const Problem& problem, const Case& base, int seeds);

/// The middle value, the mean of the two middle ones of an even number; infinity if there is none.
double median(std::vector<double> values);

}  // namespace maxwrench
