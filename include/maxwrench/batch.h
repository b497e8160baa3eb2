#pragma once

#include <atomic>
#include <functional>
#include <utility>
#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/search.h"

namespace maxwrench {

/// The bounds of an objective, seen as a unit cube x in [0, 1]^d of the coordinates that can move
/// (lower < upper). Throws std::invalid_argument if a bound is not finite or lower > upper.
class Box {
 public:
  explicit Box(const Objective& objective);
  int free() const { return static_cast<int>(free_.size()); }
  Eigen::VectorXd theta_r(const Eigen::VectorXd& x) const;
  Eigen::VectorXd unit(const Eigen::VectorXd& theta_r) const;
  /// The gradient along x of a function whose gradient along theta_r is given.
  Eigen::VectorXd slope(const Eigen::VectorXd& gradient) const;
  /// `start`, which `check` has passed, moved into the bounds, or their middle if it is empty.
  Eigen::VectorXd start(const Eigen::VectorXd& start) const;
  /// How far two points are apart: the largest coordinate, as a share of the bounds.
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;

 private:
  Eigen::VectorXd lower_, upper_;
  std::vector<int> free_;
};

/// The callbacks of one run of a search, for all of its threads: counts evaluations and reports
/// them, shows their values, and says when the run is to end.
class SearchRun {
 public:
  /// Keeps a reference to the options.
  explicit SearchRun(const SearchOptions& options) : options_(options) {}
  explicit SearchRun(const SearchOptions&&) = delete;

  /// Whether no evaluation may be made any more. Asks, until the answer is yes.
  bool ended() {
    if (!ended_ && options_.interrupted && options_.interrupted()) ended_ = true;
    return ended_;
  }
  /// Whether it was told so.
  bool interrupted() const { return ended_; }

  /// f(theta_r), -infinity instead of NaN, which is shown. Does not ask.
  double evaluate(Objective& objective, const Eigen::VectorXd& theta_r,
                  Eigen::VectorXd* gradient = nullptr);
  /// Shows an evaluation: a value of the objective, or none.
  void show(double value = -kInfinity) const {
    if (options_.evaluated) options_.evaluated(value);
  }
  /// Counts evaluations and reports them.
  void add(long evaluations) {
    const long total = count_ += evaluations;
    if (options_.progress) options_.progress(total);
  }

 private:
  const SearchOptions& options_;
  std::atomic<long> count_{0};
  std::atomic<bool> ended_{false};
};

inline constexpr int kMostThreads = 1024;
/// Throws std::invalid_argument, with one line, unless there are 1 to `kMostThreads`.
void require_threads(int threads);

/// Calls body(0) ... body(count - 1) on up to `threads` threads, in any order; on fewer if the
/// process has fewer, as whoever set TBB's global_control or made the arena around the call wants.
void parallel_for(int threads, long count, const std::function<void(long)>& body);

/// The values of `count` points, NaN of those that came after the end of the run. They are cut into
/// chunks whose size depends on `count` only, and a fresh clone evaluates each chunk in order, so
/// the values do not depend on the threads. `guides`: they are not those of the objective that the
/// search maximises, and none is shown.
std::vector<double> evaluate_all(const Objective& objective, long count,
                                 const std::function<Eigen::VectorXd(long)>& point, int threads,
                                 SearchRun& run, bool guides = false);

/// The value of one point, -infinity instead of NaN.
double evaluate_one(Objective& objective, const Eigen::VectorXd& theta_r,
                    Eigen::VectorXd* gradient = nullptr);

/// Throws std::invalid_argument, with one line, unless budget and threads are at least 1, threads
/// at most `kMostThreads`, `starts_wanted` is not negative, and start and starts are finite points
/// of the objective's size, starts with a value.
void check(const SearchOptions& options, const Objective& objective);

}  // namespace maxwrench
