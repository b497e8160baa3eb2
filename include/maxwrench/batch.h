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
  /// `start` moved into the bounds, or their middle if it is empty. Throws std::invalid_argument if
  /// its size is wrong.
  Eigen::VectorXd start(const Eigen::VectorXd& start) const;
  /// How far two points are apart: the largest coordinate, as a share of the bounds.
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;

 private:
  Eigen::VectorXd lower_, upper_;
  std::vector<int> free_;
};

/// Counts evaluations over all threads and reports them.
class EvaluationCounter {
 public:
  explicit EvaluationCounter(std::function<void(long)> report) : report_(std::move(report)) {}
  void add(long evaluations) {
    const long total = count_ += evaluations;
    if (report_) report_(total);
  }

 private:
  std::function<void(long)> report_;
  std::atomic<long> count_{0};
};

/// Calls body(0) ... body(count - 1) on up to `threads` threads, in any order; on fewer if the
/// process has fewer, as whoever set TBB's global_control or made the arena around the call wants.
void parallel_for(int threads, long count, const std::function<void(long)>& body);

/// The values of `count` points. They are cut into chunks whose size depends on `count` only, and a
/// fresh clone evaluates each chunk in order, so the values do not depend on the threads.
std::vector<double> evaluate_all(const Objective& objective, long count,
                                 const std::function<Eigen::VectorXd(long)>& point, int threads,
                                 EvaluationCounter& progress);

/// The value of one point, -infinity instead of NaN.
double evaluate_one(Objective& objective, const Eigen::VectorXd& theta_r,
                    Eigen::VectorXd* gradient = nullptr);

/// Throws std::invalid_argument unless budget and threads are at least 1.
void check(const SearchOptions& options);

}  // namespace maxwrench
