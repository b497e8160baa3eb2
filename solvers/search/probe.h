#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "lib/math/random.h"
#include "maxwrench/batch.h"
#include "solvers/search/trace.h"

namespace maxwrench {

/// The results of one part of a search.
struct Part {
  Candidate best;
  Trace trace;
  std::vector<Candidate> starts = {};
  std::vector<Call> calls = {};
};

/// Evaluates the objective for one part of a search. It has its own clone of the objective, its
/// share of the budget, and the best point so far.
class Probe {
 public:
  /// With `box`, also stores the best point of each cell, an eighth of the bounds wide in every
  /// coordinate.
  Probe(const Objective& objective, long budget, SearchRun& run, const Box* box = nullptr);
  ~Probe();
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  /// Adds evaluations to the budget.
  void grant(long evaluations) { budget_ += evaluations; }

  /// Returns what was found since the last call, and sets the budget to zero.
  Part take();

  /// Evaluations that are left; zero once the run has ended.
  long left() const { return run_.ended() ? 0 : granted(); }

  /// The value at theta_r, -infinity where there is none. Costs one evaluation, with or without
  /// gradient; one must be left. Once the run has ended, returns no value and costs nothing.
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient = nullptr);

  /// Counts an evaluation that is not a value of the objective; one must be left.
  void spend();

  /// The metric at the point of the last evaluation; costs nothing.
  void metric(Eigen::MatrixXd& M) { objective_->metric(last_, M); }
  const Part& found() const { return found_; }

 private:
  long granted() const { return budget_ - found_.trace.evaluations(); }
  void report();
  std::uint64_t cell(const Eigen::VectorXd& theta_r) const;

  const Box* box_;
  std::map<std::uint64_t, Candidate> cells_;
  std::unique_ptr<Objective> objective_;
  long budget_;
  SearchRun& run_;
  long reported_ = 0;
  Part found_;
  Eigen::VectorXd last_;
};

/// Appends to `found` the results of parts that ran in parallel: the best point (the first of
/// equals), the common trace, peaks and calls.
void join(const std::vector<Part>& parts, Part& found);

/// A uniformly random point within the bounds.
Eigen::VectorXd random_point(const Box& box, Random& random);

/// The least distance of two selected points, as a share of the bounds.
inline constexpr double kApart = 0.05;

/// The best candidates with a value, best first, at most `count`. Each is at least `separation` (as
/// `Box::distance`) from all better ones; of equal ones, the first is better.
std::vector<Candidate> select_apart(const Box& box, std::vector<Candidate> candidates,
                                    double separation, long count);

/// Adds the results of `evaluate_all` at points to `found`. Sets the value of points that were not
/// evaluated to -infinity.
void add(std::vector<double>& values, const std::function<Eigen::VectorXd(long)>& point,
         Part& found);

SearchResult make_result(const Part& found, const SearchRun& run);
/// Includes the peaks that `options` request.
SearchResult make_result(Part found, const Box& box, const SearchOptions& options,
                         const SearchRun& run);

}  // namespace maxwrench
