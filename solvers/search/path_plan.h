#pragma once

#include <functional>
#include <string>

#include "lib/trajectory/instant_evaluator.h"
#include "maxwrench/trajectory.h"
#include "solvers/search/probe.h"

namespace maxwrench {

// What searches share that make a motion along a path from control points of its spline, by
// evaluations of instants. `DpMotion` has the spline.

/// The knots (K×r) of the spline with control points P (K×r) that is at rest at both ends. With one
/// control point it rests there.
Eigen::MatrixXd knots_of_spline(const Eigen::MatrixXd& P);

/// The objective as a source of instants. Throws std::invalid_argument, with the name of the
/// search, if it is another objective, or if its task is no path with two knots or more.
const InstantSource& require_path(Objective& objective, const char* search);

/// Counts evaluations of instants. As many as the task has count as one evaluation of a probe,
/// which keeps `kept` evaluations for trajectories.
class InstantCount {
 public:
  InstantCount(Probe& probe, long instants_of_task, long kept)
      : probe_(probe), per_evaluation_(instants_of_task), kept_(kept) {}
  /// Whether this many more may be made.
  bool has(long instants) const {
    return over_ + instants <= (probe_.left() - kept_) * per_evaluation_;
  }
  void spend(long instants) {
    over_ += instants;
    for (; over_ >= per_evaluation_ && probe_.left() > 0; over_ -= per_evaluation_) probe_.spend();
  }

 private:
  Probe& probe_;
  long per_evaluation_, kept_;
  long over_ = 0;  ///< instants that no evaluation has counted yet
};

/// What a search for paths works with, after it has evaluated its start.
struct PathContext {
  const InstantSource& source;
  const Problem& problem;
  std::uint64_t seed;
  Eigen::VectorXd start;  ///< the first posture of the start
  InstantCount& count;
  Probe& probe;
};

/// Posture i of those that a search draws within the limits of theta_r, by its seed.
Eigen::VectorXd drawn_posture(const PathContext& path, int i);

/// The frame of these searches: rejects what is no path, evaluates the start and, if anything can
/// be chosen and is left to spend, lets `plan` evaluate motions and say why it stopped.
SearchResult search_path(Objective& objective, const SearchOptions& options, const char* search,
                         const std::function<std::string(const PathContext&)>& plan);

}  // namespace maxwrench
