#pragma once

#include <atomic>
#include <functional>
#include <utility>
#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/search.h"

/// @file
/// Tools for writers of searches: the unit cube, counted evaluations and parallel batches.

namespace maxwrench {

/// The bounds of an objective, mapped to a unit cube.
///
/// The cube has d dimensions, one for each coordinate of theta_r that can move (lower < upper).
/// Points x of the cube have d numbers in [0, 1].
class Box {
 public:
  /// Takes the bounds of `objective`.
  ///
  /// @throws std::invalid_argument if a bound is not finite or lower > upper.
  explicit Box(const Objective& objective);
  /// Returns d, the number of coordinates that can move.
  int free() const { return static_cast<int>(free_.size()); }
  /// Returns the theta_r of a point x (d) of the cube.
  Eigen::VectorXd theta_r(const Eigen::VectorXd& x) const;
  /// Returns the point x (d) of the cube that belongs to `theta_r`.
  Eigen::VectorXd unit(const Eigen::VectorXd& theta_r) const;
  /// Returns the gradient along x (d) of a function whose gradient along theta_r is `gradient`.
  Eigen::VectorXd slope(const Eigen::VectorXd& gradient) const;
  /// Returns the theta_r at which a search starts.
  ///
  /// It is `start` moved into the bounds, or the middle of the bounds if `start` is empty. `start`
  /// must have passed `check`.
  Eigen::VectorXd start(const Eigen::VectorXd& start) const;
  /// Returns the distance of two values of theta_r.
  ///
  /// It is the largest difference of a coordinate, as a fraction of the range of that coordinate.
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;

 private:
  Eigen::VectorXd lower_, upper_;
  std::vector<int> free_;
};

/// The callbacks of one run of a search, shared by all of its threads.
///
/// It counts evaluations, reports their number and their values, and decides when the run ends.
class SearchRun {
 public:
  /// Keeps a reference to the options, which must outlive the run.
  explicit SearchRun(const SearchOptions& options) : options_(options) {}
  /// Deleted: the options must outlive the run, and a temporary does not.
  explicit SearchRun(const SearchOptions&&) = delete;

  /// Returns whether the search must make no further evaluation.
  ///
  /// Calls `SearchOptions::interrupted` until that has returned true once.
  bool ended() {
    if (!ended_ && options_.interrupted && options_.interrupted()) ended_ = true;
    return ended_;
  }
  /// Returns whether the run was interrupted, without calling `SearchOptions::interrupted`.
  bool interrupted() const { return ended_; }

  /// Evaluates the objective at one point and reports the value to `SearchOptions::evaluated`.
  ///
  /// It does not check whether the run has ended, and does not count the evaluation.
  ///
  /// @param objective  the function
  /// @param theta_r    the point
  /// @param gradient   if not null, receives the gradient
  /// @return f(theta_r), or -infinity instead of NaN
  double evaluate(Objective& objective, const Eigen::VectorXd& theta_r,
                  Eigen::VectorXd* gradient = nullptr);
  /// Reports one evaluation to `SearchOptions::evaluated`.
  ///
  /// Pass the value of the objective, or nothing if it has none.
  void show(double value = -kInfinity) const {
    if (options_.evaluated) options_.evaluated(value);
  }
  /// Adds to the number of evaluations and reports the total to `SearchOptions::progress`.
  void add(long evaluations) {
    const long total = count_ += evaluations;
    if (options_.progress) options_.progress(total);
  }

 private:
  const SearchOptions& options_;
  std::atomic<long> count_{0};
  std::atomic<bool> ended_{false};
};

/// The largest number of threads that a caller may request.
inline constexpr int kMostThreads = 1024;
/// Checks a number of threads.
///
/// @throws std::invalid_argument, with one line, unless it is 1 to `kMostThreads`.
void require_threads(int threads);

/// Calls body(0) ... body(count - 1) in any order, in parallel.
///
/// It uses at most `threads` threads. It uses fewer if TBB allows the process fewer, for example by
/// tbb::global_control or by the task arena around the call.
void parallel_for(int threads, long count, const std::function<void(long)>& body);

/// Evaluates an objective at many points in parallel.
///
/// The points are divided into chunks whose size depends on `count` only. A fresh clone of the
/// objective evaluates each chunk in order. So the values do not depend on the number of threads.
///
/// @param objective  the function; only clones of it are evaluated
/// @param count      the number of points
/// @param point      returns the theta_r of point i
/// @param threads    the largest number of threads
/// @param run        counts and reports the evaluations, and can end them
/// @param guides     true: `objective` is not the function that the search maximises, so no value
///                   is reported
/// @return `count` values; NaN for the points that remained when the run ended
std::vector<double> evaluate_all(const Objective& objective, long count,
                                 const std::function<Eigen::VectorXd(long)>& point, int threads,
                                 SearchRun& run, bool guides = false);

/// Returns the value of the objective at one point, or -infinity instead of NaN.
///
/// If `gradient` is not null, it receives the gradient.
double evaluate_one(Objective& objective, const Eigen::VectorXd& theta_r,
                    Eigen::VectorXd* gradient = nullptr);

/// Checks the options of a search against its objective.
///
/// The budget must be at least 1, and the number of threads 1 to `kMostThreads`. `starts_wanted`
/// must not be negative. `start` and all `starts` must be finite and have the size of the
/// objective, and each of `starts` must have a value.
///
/// @throws std::invalid_argument, with one line, otherwise.
void check(const SearchOptions& options, const Objective& objective);

}  // namespace maxwrench
