#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

namespace maxwrench {

class Objective;
struct SearchEntry;

/// A point that was evaluated. `value` is -infinity where the objective has none.
struct Candidate {
  Eigen::VectorXd theta_r;
  double value = -kInfinity;
};

struct SearchOptions {
  std::uint64_t seed = 1;
  long budget = 20000;    ///< evaluations of the objective, never exceeded
  int threads = 1;        ///< changes the time, never the result
  Eigen::VectorXd start;  ///< a posture that searches with a start evaluate first; empty: the
                          ///< middle of the bounds
  /// What an earlier search has found, best first, each with a value: a search that goes on begins
  /// there, and only then where it would begin by itself.
  std::vector<Candidate> starts;
  long starts_wanted =
      0;  ///< how many points the result shall hold, at most, for a search that goes on
  // From any thread; each may be empty.
  std::function<void(long evaluations)> progress = {};  ///< called now and then
  /// Asked before each evaluation. Once it says true, the search makes no more and returns the best
  /// so far.
  std::function<bool()> interrupted = {};
  /// Called after each evaluation that the budget counts, by the thread that made it: -infinity if
  /// the objective had no value, or something else than the objective was evaluated.
  std::function<void(double value)> evaluated = {};
};

/// After so many evaluations the best value so far rose to `value`.
struct Improvement {
  long evaluations = 0;
  double value = -kInfinity;
};

/// One run of a method, such as one local search of "slsqp" that ended with "xtol_reached".
struct Call {
  std::string method;  ///< the search's name
  std::string status;  ///< the word of the library; "budget" where its evaluations ran out
  long evaluations = 0;
};

/// The best point that a search saw: kBestFound if any evaluated point has a value, else
/// kNoneFound.
struct SearchResult : Verdict {
  SearchResult() { conclude(Status::kNoneFound, "nothing that was evaluated has a value"); }
  Eigen::VectorXd theta_r;
  double value = -kInfinity;
  long evaluations = 0;
  /// Every improvement, the last one is `value`. Parts of a search that run side by side count as
  /// if they took turns, one evaluation each, so the history is the same at any thread count.
  std::vector<Improvement> history;
  /// Points for a search that goes on, best first and apart from each other.
  std::vector<Candidate> starts;
  std::vector<Call> calls;  ///< of a method that runs more than once, or in a library; in order
  /// Why the search ended with evaluations left; empty if it does not say.
  std::string stopped;
  bool interrupted = false;  ///< it ended as `SearchOptions::interrupted` said so
};

/// What `SearchResult::stopped` says where the evaluations were used.
inline constexpr const char* kBudgetSpent = "the evaluations ran out";

/// Maximises an objective over its bounds.
class Search {
 public:
  virtual ~Search() = default;
  virtual SearchResult maximize(Objective& objective, const SearchOptions& options) = 0;
};

/// What the name of a search says: an entry's, or several joined by '+', such as "crs2+cmaes":
/// stages, each of which goes on where the earlier ones have been. "restart:" before it runs it
/// from random starts again and again, until another optimum is unlikely.
struct NamedSearch {
  std::string name;
  bool restarts = false;
  std::vector<const SearchEntry*> stages;
  bool local = false;  ///< all stages are
  std::unique_ptr<Search> make() const;
};

}  // namespace maxwrench
