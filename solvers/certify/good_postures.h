#pragma once

#include <functional>
#include <vector>

#include "maxwrench/bound.h"
#include "maxwrench/objective.h"
#include "maxwrench/search.h"

namespace maxwrench {

/// The finest resolution [rad or m].
inline constexpr double kLeastResolution = 1e-6;

/// What is at least this is within a share of a best value: best - within |best|.
double good_from(double best, double within);

/// A box of theta_r in which no value exceeds `high`, and that may hold good postures.
struct GoodBox {
  Eigen::VectorXd lower, upper;
  double high = 0;
  int cluster = 0;  ///< the index of its cluster
};

/// Boxes that hang together: each touches another one, by a face, an edge or a corner.
struct Cluster {
  long boxes = 0;
  /// Around its boxes. Of a coordinate that turns all around, the shortest arc, whose upper end may
  /// be up to a turn beyond its limit.
  Eigen::VectorXd lower, upper;
  double share = 0;  ///< of the volume of all theta_r
  double high = 0;   ///< no value in it exceeds this
  Candidate best;    ///< that was found in it; -infinity: no posture with a value was
};

struct GoodOptions {
  double within = 0.01;         ///< share of |best|, above 0, at most 1
  double resolution = 0.05;     ///< rad or m, at least 1e-6
  std::vector<char> turns = {}; /**< of each coordinate, whether both its limits are one place;
                                     empty: none */
  double seconds = kInfinity;
  long boxes = 5'000'000;  ///< that are bounded, at most
  int threads = 1;         ///< changes the time, never the result
  std::function<bool()> interrupted;
  /// Called now and then with how many boxes wait, and how many are kept.
  std::function<void(std::size_t waiting, std::size_t kept)> progress;
};

/// kProven: no side of a box is longer than the resolution. kBracket: some are, and the reason says
/// what ran out. In both cases no theta_r within the limits and outside of the boxes has a value of
/// `least` or more, and so none that is within the share of the best.
struct GoodPostures : Verdict {
  double least = 0;  ///< good_from the best known value
  double sure = 0;   ///< good_from the bound: what is this good is good for sure
  std::vector<GoodBox> boxes;
  std::vector<Cluster> clusters;  ///< the best value that was found first; then by `high`
  long bounded = 0;               ///< boxes that were bounded
  double seconds = 0;

  /// Whether a posture that is good for sure was found in it. Else it may hold one.
  bool holds(const Cluster& cluster) const { return cluster.best.value >= sure; }
};

/// All good postures: boxes are halved until their sides are at most the resolution, and left out
/// where the bound says that no value in them reaches `least`. `best` is a posture with its value,
/// and no value exceeds `high`. In each cluster the centres of the boxes that promise most are
/// evaluated, and a short CMA-ES begins at the best of them. Throws std::invalid_argument for
/// options out of range.
GoodPostures find_good_postures(Objective& objective, const Bound& bound, const Candidate& best,
                                double high, const GoodOptions& options);

}  // namespace maxwrench
