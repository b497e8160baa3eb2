#pragma once

#include <functional>
#include <vector>

#include "maxwrench/bound.h"
#include "maxwrench/objective.h"
#include "maxwrench/search.h"

namespace maxwrench {

/// A box of theta_r that branch and bound was through with, and why: `proof` says that no value in
/// it exceeds max(low, proof.high), given that none exceeds `high`, which the box that it was cut
/// from proves.
struct CertifiedBox {
  Eigen::VectorXd lower, upper;
  double low = 0, high = 0;
  /// What was cut off before the rest was bounded, if somebody asks for boxes.
  std::vector<BoxCut> cuts;
  BoxProof proof;
  int depth = 0;
  long id = 0, parent = -1;  ///< in the order in which boxes were made, the lower half first
  /// Along which it was cut at its middle: it is not proven, but its two halves come. -1: it is a
  /// leaf.
  int cut_axis = -1;
};

struct CertifyOptions {
  double gap = 1e-3;  ///< of |incumbent|, at least kLeastGap
  double seconds = kInfinity;
  long boxes = 20'000'000;
  int threads = 1;  ///< changes the time, never the proof
  std::function<bool()> interrupted;
  /// Called now and then with the bound and the incumbent.
  std::function<void(double bound, double incumbent)> progress;
  /// Gets every box, in the same order at any thread count; at last those that were neither proven
  /// nor cut when the search ended, as what they have is enough, or all there is.
  std::function<void(const CertifiedBox&)> sink;
};

/// Less than this is within what values are off by.
inline constexpr double kLeastGap = 1e-8;

/// kProven: no theta_r within the limits has a value above `bound`, which exceeds that at `best` by
/// at most gap |value|. kBracket: `bound` is as true, but not so near; the reason says what ran
/// out.
struct CertifyResult : Verdict {
  Candidate best;  ///< -infinity: none is known
  double bound = kInfinity;
  long boxes = 0;      ///< that were bounded
  long colliding = 0;  ///< of them, pruned as they collide
  double seconds = 0;
};

/// Branch and bound over the box of the objective: the box with the largest bound comes next, cut
/// in two along the coordinate that its bound names, else its widest. `incumbent`, a point with its
/// value, sets what is to be proven; a better value at the centre of a box, and what a short local
/// search from there finds, replaces it. Boxes narrower than 1e-6 are not cut. Throws
/// std::invalid_argument, with one line, for options out of range.
CertifyResult certify(Objective& objective, const Bound& bound, const Candidate& incumbent,
                      const CertifyOptions& options);

}  // namespace maxwrench
