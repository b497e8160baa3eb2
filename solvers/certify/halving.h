#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "solvers/certify/certify.h"

// What searches over boxes share.

namespace maxwrench {

using CertifiedBoxes = std::vector<std::unique_ptr<CertifiedBox>>;

/// Makes boxes by halves and bounds them on several threads, each with a bound of its own.
class Halving {
 public:
  /// `records`: boxes keep what was cut off them.
  Halving(const Objective& objective, const Bound& bound, int threads, bool records);

  /// All of theta_r and of what follows, widened by the tolerance of limits, given that no value
  /// exceeds `high`.
  std::unique_ptr<CertifiedBox> root(double low, double high);

  /// The halves of boxes, each cut along its `cut_axis`, the lower one first. All have the same
  /// aim, and their numbers in the same order, whatever the threads. Once `ended` says so, from any
  /// thread, those that are left have what is known of their parents.
  CertifiedBoxes halves(const CertifiedBoxes& parents, double low,
                        const std::function<bool()>& ended);

 private:
  void bound_one(CertifiedBox& box, double low);

  const Objective& objective_;
  const Bound& bound_;
  int threads_;
  bool records_;
  long last_id_ = 0;  ///< the root's
  std::mutex mutex_;
  std::vector<std::unique_ptr<Bound>> free_;
};

/// Where a box is cut: the coordinate that its bound names, else the widest; -1 if no such one is
/// wider than `narrowest`.
int axis_to_cut(const CertifiedBox& box, double narrowest);

/// Boxes narrower than this [rad or m] are not cut.
inline constexpr double kNarrowestBox = 1e-6;
/// Boxes that are cut beside each other: they see the same aim, at any thread count.
inline constexpr std::size_t kRound = 256;

}  // namespace maxwrench
