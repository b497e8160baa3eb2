#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "maxwrench/status.h"
#include "maxwrench/types.h"

namespace maxwrench {

class Objective;

struct SearchOptions {
  std::uint64_t seed = 1;
  long budget = 20000;    ///< evaluations of the objective, never exceeded
  int threads = 1;        ///< changes the time, never the result
  Eigen::VectorXd start;  ///< a posture that searches with a start evaluate first; empty: the
                          ///< middle of the bounds
  std::function<void(long evaluations)>
      progress;  ///< called now and then, from any thread; may be empty
};

/// After so many evaluations the best value so far rose to `value`.
struct Improvement {
  long evaluations = 0;
  double value = -kInfinity;
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
};

/// Maximises an objective over its bounds.
class Search {
 public:
  virtual ~Search() = default;
  virtual SearchResult maximize(Objective& objective, const SearchOptions& options) = 0;
};

}  // namespace maxwrench
