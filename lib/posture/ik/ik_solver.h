#pragma once

#include <memory>
#include <vector>

#include "lib/posture/ik/path_tracker.h"

namespace maxwrench {

class IkStartSystem;

/// Of one thread: all postures that reach the pose at one theta_r after the other. Solutions are
/// carried from the last theta_r, or from the nearest place of the start system: real ones along
/// the straight line, in real numbers; if solutions meet on it, all of them along a complex way
/// around. Each is exact to rounding, so the list depends on theta_r alone, but for the last
/// digits. Allocates nothing after the first call near by.
class IkSolver {
 public:
  explicit IkSolver(std::shared_ptr<const IkStartSystem> start_system);

  /// Solves at the joints of theta_r; the number of postures.
  int solve(const Eigen::VectorXd& theta_r);
  int count() const { return static_cast<int>(node_.real.size()); }
  /// y of a posture, angles within +-pi; in increasing order of the first y that differ.
  const Six<double>& y(int i) const { return node_.real[static_cast<std::size_t>(i)]; }
  /// Whether all solutions are accounted for; else postures near a singular one may be missing.
  bool complete() const { return node_.complete; }
  const IkStartSystem& start_system() const { return *start_system_; }

 private:
  const IkSolutionSet& nearest(const Eigen::VectorXd& theta_r);
  bool track_straight(const IkSolutionSet& from);
  bool track_detour(const IkSolutionSet& from, double side);
  void sort();

  std::shared_ptr<const IkStartSystem> start_system_;
  PathTracker tracker_;
  IkSolutionSet node_, next_,
      last_;  ///< of the last theta_r; the one in the making; the last complete
};

}  // namespace maxwrench
