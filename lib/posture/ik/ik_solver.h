#pragma once

#include <memory>
#include <vector>

#include "lib/posture/ik/path_tracker.h"

namespace maxwrench {

class IkStartSystem;

/// Finds all postures that reach the pose, at one theta_r after another. Not thread-safe: use one
/// solver for each thread. Solutions are tracked from the last theta_r or from the nearest node of
/// the start system. Real solutions follow the straight line in real numbers. If solutions meet on
/// the line, all solutions take a complex detour. Each solution is exact up to rounding, so the
/// list depends on theta_r alone, except for the last digits. Nearby calls after the first allocate
/// nothing.
class IkSolver {
 public:
  explicit IkSolver(std::shared_ptr<const IkStartSystem> start_system);

  /// Solves at the joints of theta_r and returns the number of postures.
  int solve(const Eigen::VectorXd& theta_r);
  int count() const { return static_cast<int>(node_.real.size()); }
  /// y of posture i, angles within +-pi. Postures are in increasing order of the first y in which
  /// they differ.
  const Six<double>& y(int i) const { return node_.real[static_cast<std::size_t>(i)]; }
  /// Whether all solutions were found. If not, postures near a singular one may be missing.
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
      last_;  ///< at the last theta_r; in preparation; the last full set
};

}  // namespace maxwrench
