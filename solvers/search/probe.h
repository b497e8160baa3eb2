#pragma once

#include <cstdint>
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
  std::vector<Candidate> peaks = {};
  std::vector<Call> calls = {};
};

/// The eyes of one part of a search: its own clone of the objective, its share of the budget, and
/// the best point so far.
class Probe {
 public:
  /// With `box`, also keeps the best point of each of its cells: an eighth of the bounds wide in
  /// every coordinate.
  Probe(const Objective& objective, long budget, EvaluationCounter& progress,
        const Box* box = nullptr);
  ~Probe();
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  /// More evaluations.
  void grant(long evaluations) { budget_ += evaluations; }

  /// What was found since the last time; leaves no budget.
  Part take();

  /// Evaluations that are left.
  long left() const { return budget_ - found_.trace.evaluations(); }

  /// Whether the rest of the evaluations is worth nothing.
  bool ended() const { return objective_->ended(); }

  /// The value at theta_r, -infinity where there is none; costs one evaluation, with a gradient
  /// too. There must be one left.
  double evaluate(const Eigen::VectorXd& theta_r, Eigen::VectorXd* gradient = nullptr);

  /// The objective's smooth program, or null. What it is asked is counted by `spend`.
  FacetProgram* facets() { return objective_->facets(); }
  /// Counts an evaluation of something else than the objective's value; there must be one left.
  void spend();

  /// The metric at the point of the last evaluation, which costs nothing.
  void metric(Eigen::MatrixXd& M) { objective_->metric(last_, M); }
  const Part& found() const { return found_; }

 private:
  void report();
  std::uint64_t cell(const Eigen::VectorXd& theta_r) const;

  const Box* box_;
  std::map<std::uint64_t, Candidate> cells_;
  std::unique_ptr<Objective> objective_;
  long budget_;
  EvaluationCounter& progress_;
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

SearchResult make_result(const Part& found);
/// With the peaks that `options` ask for.
SearchResult make_result(Part found, const Box& box, const SearchOptions& options);

}  // namespace maxwrench
