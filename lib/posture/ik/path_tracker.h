#pragma once

#include <vector>

#include "lib/posture/ik/continuation.h"
#include "lib/posture/ik/ik_solution_set.h"

namespace maxwrench {

/// Tracks solutions along paths to a real theta_r. Not thread-safe: use one tracker for each
/// thread.
class PathTracker {
 public:
  /// The chain must outlive this object.
  PathTracker(const ToolChain& chain, const Pose<double>& pose);
  PathTracker(const ToolChain&&, const Pose<double>&) = delete;

  HomotopyPath<Complex>& path() { return path_; }
  void begin();
  /// Tracks a solution along the path and keeps its end.
  void carry(const Six<Complex>& y);
  /// Sorts the ends into real solutions, exact up to rounding, and pairs. They are all if all paths
  /// have different ends, none of them unpaired. Solutions that are almost infinite all the way and
  /// get lost there are not real.
  void finish(IkSolutionSet& node);
  /// The same along the straight line from `from`. At the start `node` holds the solutions at
  /// `from`. False unless every real solution stays real and the pairs stay apart.
  bool track_straight(const Eigen::VectorXd& from, IkSolutionSet& node);

 private:
  const ToolChain& chain_;
  Continuation<double> real_;
  Continuation<Complex> complex_;
  HomotopyPath<double> line_;
  HomotopyPath<Complex> path_;
  std::vector<Six<Complex>> ends_, seen_;
  int carried_ = 0, lost_ = 0;  ///< paths since `begin`, and those lost almost at infinity
};

void assign(const Eigen::VectorXd& from, VectorX<Complex>& to);
Six<Complex> complex_of(const Six<double>& y);
Pose<Complex> complex_of(const Pose<double>& pose);

/// [rad or m] Solutions closer than this are the same.
inline constexpr double kSameSolution = 1e-6;

/// The distance of two solutions [rad or m], the largest over all y. Whole turns do not count.
template <class T>
double apart(const ToolChain& chain, const Six<T>& a, const Six<T>& b);

/// Whether the list contains a solution that is the same as y.
template <class T>
bool contains(const ToolChain& chain, const std::vector<Six<T>>& list, const Six<T>& y,
              double same = kSameSolution);

/// Moves angles into [-pi, pi] by whole turns.
template <class T>
void wrap(const ToolChain& chain, Six<T>& y);

}  // namespace maxwrench
