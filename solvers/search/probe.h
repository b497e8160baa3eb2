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

/// What one part of a search found.
struct Part {
  Candidate best;
  Trace trace;
  std::vector<Candidate> starts = {};
  std::vector<Call> calls = {};
};

/// The eyes of one part of a search: its own clone of the objective, its share of the budget, and
/// the best point so far.
class Probe {
 public:
  /// With `condensed`, also keeps the best point of each of its cells: an eighth of the bounds wide
  /// in every coordinate.
  Probe(const Objective& objective, long budget, SearchRun& run, const Box* box = nullptr);
  ~Probe();
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  /// More evaluations.
  void grant(long evaluations) { budget_ += evaluations; }

  /// What was found since the last time; leaves no budget.
  Part take();

  /// Evaluations that are left: none once the run has ended.
  long left() const { return run_.ended() ? 0 : granted(); }

  /// The value at theta_r, -infinity where there is none; costs one evaluation, with a gradient
  /// too, one of which must have been left. Once the run has ended: no value, and no cost.
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient = nullptr);

  /// Counts an evaluation of something else than the objective's value; one must have been left.
  void spend();

  /// The metric at the point of the last evaluation, which costs nothing.
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

/// Of parts that ran side by side: the best point (the first of equals), the common trace, peaks
/// and calls, appended to `found`.
void join(const std::vector<Part>& parts, Part& found);

/// Uniformly random within the bounds.
Eigen::VectorXd random_point(const Box& box, Random& random);

/// How far two points of a selection are apart, at least, as a share of the bounds.
inline constexpr double kApart = 0.05;

/// The best candidates with a value, best first, at most `count`, each `separation` (as
/// `Box::distance`) or more from all better ones; of equal ones the first counts.
std::vector<Candidate> select_apart(const Box& box, std::vector<Candidate> candidates,
                                    double separation, long count);

/// Adds what `evaluate_all` found at points to what a search has found. Those to which it did not
/// come have no value from then on.
void add(std::vector<double>& values, const std::function<Eigen::VectorXd(long)>& point,
         Part& found);

SearchResult make_result(const Part& found, const SearchRun& run);
/// With the peaks that `options` ask for.
SearchResult make_result(Part found, const Box& box, const SearchOptions& options,
                         const SearchRun& run);

}  // namespace maxwrench
