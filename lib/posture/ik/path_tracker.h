#pragma once

#include <vector>

#include "lib/posture/ik/continuation.h"
#include "lib/posture/ik/ik_solution_set.h"

namespace maxwrench {

/// What carries solutions along ways to a real theta_r; of one thread.
class PathTracker {
 public:
  /// The chain outlives this.
  PathTracker(const ToolChain& chain, const Pose<double>& pose);
  PathTracker(const ToolChain&&, const Pose<double>&) = delete;

  HomotopyPath<Complex>& path() { return path_; }
  void begin() { ends_.clear(); }
  /// Carries a solution along the way.
  void carry(const Six<Complex>& y);
  /// Sorts the ends into real solutions, exact to rounding, and pairs; whether they are `count`
  /// different ones, all accounted for.
  bool finish(int count, IkSolutionSet& node);
  /// The same without a detour: a real solution stays real, and pairs stay apart; false: they do
  /// not. At the start `node` holds the solutions of another theta_r.
  bool track_straight(const Eigen::VectorXd& from, IkSolutionSet& node);

 private:
  const ToolChain& chain_;
  Continuation<double> real_;
  Continuation<Complex> complex_;
  HomotopyPath<double> line_;
  HomotopyPath<Complex> path_;
  std::vector<Six<Complex>> ends_, seen_;
};

void assign(const Eigen::VectorXd& from, VectorX<Complex>& to);
Six<Complex> complex_of(const Six<double>& y);
Pose<Complex> complex_of(const Pose<double>& pose);

/// [rad or m] Solutions closer than this are the same.
inline constexpr double kSameSolution = 1e-6;

/// How far two solutions are from each other [rad or m], the largest of all y; whole turns do not
/// count.
template <class T>
double apart(const ToolChain& chain, const Six<T>& a, const Six<T>& b);

/// Whether one of the list is the same as y.
template <class T>
bool contains(const ToolChain& chain, const std::vector<Six<T>>& list, const Six<T>& y);

/// Brings angles between -pi and pi.
template <class T>
void wrap(const ToolChain& chain, Six<T>& y);

}  // namespace maxwrench
