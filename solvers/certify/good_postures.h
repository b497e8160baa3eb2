#pragma once

#include <functional>
#include <vector>

#include "maxwrench/bound.h"
#include "maxwrench/objective.h"
#include "maxwrench/search.h"

namespace maxwrench {

/// The finest resolution [rad or m].
inline constexpr double kLeastResolution = 1e-6;

/// The least good value: best - within |best|; infinite if the best value is.
double good_from(double best, double within);

/// A box in which no value exceeds `high`, and which may hold good postures. Its coordinates are
/// those of the bound: theta_r, then the dependent coordinates if there are any.
struct GoodBox {
  Eigen::VectorXd lower, upper;
  double high = 0;
  int cluster = 0;  ///< the index of its cluster
};

/// A connected set of boxes: each has a point in common with another one.
struct Cluster {
  long boxes = 0;
  /// The limits of its boxes. For a coordinate that turns all around, the shortest arc, whose upper
  /// end may be up to one turn beyond its limit.
  Eigen::VectorXd lower, upper;
  double share = 0;   ///< of the volume of all theta_r; at most this if the list ended early
  double high = 0;    ///< no value in it exceeds this
  Candidate best;     ///< the best posture found in it; -infinity: none with a value was found
  Eigen::VectorXd x;  ///< all coordinates of that posture
};

/// A posture as a point x of boxes, which begins with theta_r, and its value.
struct PosturePoint {
  Eigen::VectorXd x;
  double value = -kInfinity;
};
/// Replaces `postures` by all postures at theta_r that have a value.
using PosturesAt =
    std::function<void(const Eigen::VectorXd& theta_r, std::vector<PosturePoint>& postures)>;

struct GoodOptions {
  double within = 0.01;         ///< share of |best|, above 0, at most 1
  double resolution = 0.05;     ///< rad or m, at least 1e-6
  std::vector<char> turns = {}; /**< whether both limits of a coordinate of the boxes are the same
                                     place; empty: none */
  /// Makes a function for the use of one thread. Empty: x is theta_r, and has the objective's
  /// value.
  std::function<PosturesAt()> make_postures = {};
  double seconds = kInfinity;
  long boxes = 5'000'000;  ///< the most boxes to bound
  int threads = 1;         ///< changes the time, never the result
  std::function<bool()> interrupted;
  /// Called from time to time with the number of waiting boxes and of kept boxes.
  std::function<void(std::size_t waiting, std::size_t kept)> progress;
};

/// kProven: no side of a box is longer than the resolution. kBracket: some sides are, and the
/// reason says which limit ended the search. In both cases, no theta_r within the limits and
/// outside the boxes has a value of `least` or more, so none within the share of the best. Where
/// coordinates are dependent, the limits of an angle are at most a turn apart, and an angle beyond
/// them is the same as one within them.
struct GoodPostures : Verdict {
  double least = 0;              ///< good_from the best known value
  double sure = 0;               ///< good_from the bound: values from here on are certainly good
  Eigen::VectorXd lower, upper;  ///< the limits of all boxes
  std::vector<GoodBox> boxes;
  std::vector<Cluster> clusters;  ///< the largest best value comes first, then the largest `high`
  long bounded = 0;               ///< number of bounded boxes
  double seconds = 0;

  /// Whether a certainly good posture was found in the cluster. Otherwise the cluster may still
  /// hold one.
  bool holds(const Cluster& cluster) const { return cluster.best.value >= sure; }
};

/// Finds all good postures. Boxes are halved until their sides are at most the resolution, and
/// discarded where the bound proves that no value in them reaches `least`. `best` is a posture with
/// its value, and no value exceeds `high`. In each cluster, the postures at the centres of the
/// boxes with the largest bounds are evaluated, and a short CMA-ES starts from the best one. Along
/// theta_r all boxes are cells of one grid; along dependent coordinates they are as narrow as the
/// bound can make them. Throws std::invalid_argument for options out of range.
GoodPostures find_good_postures(Objective& objective, const Bound& bound, const Candidate& best,
                                double high, const GoodOptions& options);

}  // namespace maxwrench
