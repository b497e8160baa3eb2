#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "solvers/certify/certify.h"

// Functions that searches over boxes share.

namespace maxwrench {

using CertifiedBoxes = std::vector<std::unique_ptr<CertifiedBox>>;

struct HalvingOptions {
  int threads = 1;
  bool records = false;  ///< boxes store the slices cut off them
  /// Boxes keep their sides along theta_r, whatever slices are cut off: they are cells of a grid.
  bool cells = false;
};

/// Halves boxes and bounds them on several threads, each with a bound of its own.
class Halving {
 public:
  Halving(const Objective& objective, const Bound& bound, const HalvingOptions& options);

  /// The box of theta_r and of the dependent coordinates, widened by the tolerance of limits, given
  /// that no value exceeds `high`.
  std::unique_ptr<CertifiedBox> root(double low, double high);

  /// The halves of boxes, each cut along its `cut_axis`, the lower half first. All halves have the
  /// same target `low`, and their numbers have the same order at any thread count. `ended` may be
  /// called from any thread. Once it returns true, the remaining halves keep the bounds of their
  /// parents.
  CertifiedBoxes halves(const CertifiedBoxes& parents, double low,
                        const std::function<bool()>& ended);

 private:
  void bound_one(CertifiedBox& box, double low);

  const Objective& objective_;
  const Bound& bound_;
  const HalvingOptions options_;
  long last_id_ = 0;  ///< the root's
  std::mutex mutex_;
  std::vector<std::unique_ptr<Bound>> free_;
};

/// The axis along which a box is cut: the coordinate that its bound names, else the widest but
/// `left_out`; -1 if none of these is wider than `narrowest`.
int axis_to_cut(const CertifiedBox& box, double narrowest, int left_out = -1);

/// Boxes narrower than this [rad or m] are not cut.
inline constexpr double kNarrowestBox = 1e-6;
/// The number of boxes cut in one round. They all have the same target, at any thread count.
inline constexpr std::size_t kRound = 256;

}  // namespace maxwrench
