#pragma once

#include <memory>
#include <vector>

#include "lib/posture/ik/path_tracker.h"

namespace maxwrench {

class BranchAtlas;

/// Of one thread: all postures that reach the pose at one theta_r after the other. Solutions are
/// carried from the last theta_r, or from the nearest place of the atlas: real ones along the
/// straight line, in real numbers; if solutions meet on it, all of them along a complex way around.
/// Each is exact to rounding, so the list depends on theta_r alone, but for the last digits.
/// Allocates nothing after the first call near by.
class Branches {
 public:
  explicit Branches(std::shared_ptr<const BranchAtlas> atlas);

  /// Solves at the joints of theta_r; the number of postures.
  int solve(const Eigen::VectorXd& theta_r);
  int count() const { return static_cast<int>(node_.real.size()); }
  /// y of a posture, angles within +-pi; in increasing order of the first y that differ.
  const Six<double>& y(int i) const { return node_.real[static_cast<std::size_t>(i)]; }
  /// Whether all solutions are accounted for; else postures near a singular one may be missing.
  bool complete() const { return node_.complete; }
  const BranchAtlas& atlas() const { return *atlas_; }

 private:
  const AtlasNode& nearest(const Eigen::VectorXd& theta_r);
  bool go_straight(const AtlasNode& from);
  bool go_around(const AtlasNode& from, double side);
  void sort();

  std::shared_ptr<const BranchAtlas> atlas_;
  Carrier carrier_;
  AtlasNode node_, next_, last_;  ///< of the last theta_r; the one in the making; the last complete
};

}  // namespace maxwrench
