#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

/// @file
/// The interface of searches, their options and their results.

namespace maxwrench {

class Objective;
struct SearchEntry;

/// A point that was evaluated.
struct Candidate {
  Eigen::VectorXd theta_r;    ///< the point
  double value = -kInfinity;  ///< its value; -infinity if the objective has none there
};

/// The options of a search.
///
/// The callbacks may be called from any thread. Each may be empty.
struct SearchOptions {
  std::uint64_t seed = 1;  ///< of the random numbers
  long budget = 20000;     ///< largest number of evaluations of the objective, never exceeded
  int threads = 1;         ///< number of threads; it changes the time, never the result
  Eigen::VectorXd start;   ///< a posture that searches with a start evaluate first; empty: the
                           ///< middle of the bounds
  /// The results of an earlier search, best first, each with a value. A search that continues
  /// begins at these points, and only then at its own starts.
  std::vector<Candidate> starts;
  /// Largest number of points in `SearchResult::starts`, for a search that continues.
  long starts_wanted = 0;
  std::function<void(long evaluations)> progress = {};  ///< called from time to time
  /// Called before each evaluation. Once it returns true, the search makes no more evaluations and
  /// returns the best point so far.
  std::function<bool()> interrupted = {};
  /// Called after each evaluation that the budget counts, by the thread that made it. The value is
  /// -infinity if the objective has none, or if another function was evaluated.
  std::function<void(double value)> evaluated = {};
};

/// An improvement: the best value so far rose to `value`.
struct Improvement {
  long evaluations = 0;       ///< number of evaluations until then
  double value = -kInfinity;  ///< the new best value
};

/// One run of a method, such as a local search of "slsqp" that ended with "xtol_reached".
struct Call {
  std::string method;    ///< the name of the search
  std::string status;    ///< as the library reports it; "budget" if the evaluations ran out
  long evaluations = 0;  ///< number of evaluations of this run
};

/// The result of a search: the best point that it evaluated.
///
/// The status is kBestFound if any evaluated point has a value, otherwise kNoneFound.
struct SearchResult : Verdict {
  /// Makes a result without any point.
  SearchResult() { conclude(Status::kNoneFound, "nothing that was evaluated has a value"); }
  Eigen::VectorXd theta_r;    ///< the best point
  double value = -kInfinity;  ///< its value
  long evaluations = 0;       ///< number of evaluations
  /// Every improvement; the last one has `value`. Parallel parts of a search count as if they took
  /// turns, one evaluation each. So the history does not depend on the number of threads.
  std::vector<Improvement> history;
  /// Points for a search that continues, best first and apart from each other.
  std::vector<Candidate> starts;
  std::vector<Call> calls;  ///< in order, for methods that run more than once or in a library
  /// Why the search ended before the budget was used. Empty if it gives no reason.
  std::string stopped;
  bool interrupted = false;  ///< whether `SearchOptions::interrupted` ended it
};

/// The value of `SearchResult::stopped` if the budget was used.
inline constexpr const char* kBudgetSpent = "the evaluations ran out";

/// Maximises an objective over its bounds.
class Search {
 public:
  virtual ~Search() = default;
  /// Runs the search.
  ///
  /// @param objective  the function to maximise
  /// @param options    budget, seed, starts and callbacks
  /// @return the best point; the same at any number of threads
  virtual SearchResult maximize(Objective& objective, const SearchOptions& options) = 0;
};

/// A search by its name.
///
/// The name is that of a `SearchEntry`, built in or added, or several of them joined by '+', such
/// as "crs2+cmaes". These are stages: each one continues from the points of the earlier ones. The
/// prefix "restart:" runs the search from random starts repeatedly, until another optimum is
/// unlikely.
struct NamedSearch {
  std::string name;                        ///< the name
  bool restarts = false;                   ///< whether it has the prefix "restart:"
  std::vector<const SearchEntry*> stages;  ///< the stages, in order
  bool local = false;                      ///< whether all stages are local
  std::unique_ptr<Search> make() const;    ///< Makes the search.
};

}  // namespace maxwrench
