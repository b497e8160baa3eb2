#pragma once

#include <functional>
#include <vector>

#include "maxwrench/bound.h"
#include "maxwrench/objective.h"
#include "maxwrench/search.h"

namespace maxwrench {

/// A box of theta_r that branch and bound has finished. `proof` shows that no value in it exceeds
/// max(low, proof.high), given that none exceeds `high`. The parent box proves `high`.
struct CertifiedBox {
  Eigen::VectorXd lower, upper;
  double low = 0, high = 0;
  /// The slices cut off one after another, and at last the box if its equations exclude it;
  /// recorded only if there is a sink.
  std::vector<BoxCut> cuts;
  BoxProof proof;
  int depth = 0;
  long id = 0, parent = -1;  ///< in the order in which the boxes were made, the lower half first
  /// The axis along which the box was cut at its middle: it is not proven, and its two halves
  /// follow. -1: the box is a leaf.
  int cut_axis = -1;
};

struct CertifyOptions {
  double gap = 1e-3;  ///< share of |incumbent|, at least kLeastGap
  double seconds = kInfinity;
  long boxes = 20'000'000;
  int threads = 1;  ///< changes the time, never the proof
  std::function<bool()> interrupted;
  /// Called from time to time with the bound and the incumbent.
  std::function<void(double bound, double incumbent)> progress;
  /// Receives every box, in the same order at any thread count. The boxes that are neither proven
  /// nor cut when the search ends come last: their bounds suffice, or a limit ended the search.
  std::function<void(const CertifiedBox&)> sink;
};

/// Smaller gaps are within the error of the values.
inline constexpr double kLeastGap = 1e-8;

/// kProven: no theta_r within the limits has a value above `bound`, which exceeds the value at
/// `best` by at most gap |value|. kBracket: `bound` is valid, but the gap is larger; the reason
/// says which limit ended the search.
struct CertifyResult : Verdict {
  Candidate best;  ///< -infinity: none is known
  double bound = kInfinity;
  long boxes = 0;      ///< number of bounded boxes
  long colliding = 0;  ///< number of these that were pruned because they collide
  double seconds = 0;
};

/// Throws std::invalid_argument, with one line, for options out of range.
void require_valid(const CertifyOptions& options);

/// Branch and bound over the box of the objective. The box with the largest bound is cut next, into
/// two halves along the coordinate that its bound names, or else its widest one. `incumbent`, a
/// point with its value, sets the target of the proof. A better value at the centre of a box, or
/// from a short local search from there, replaces it. Boxes narrower than 1e-6 are not cut. Throws
/// std::invalid_argument, with one line, for options out of range.
CertifyResult certify(Objective& objective, const Bound& bound, const Candidate& incumbent,
                      const CertifyOptions& options);

}  // namespace maxwrench
