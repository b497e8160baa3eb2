#pragma once

#include "lib/math/nearest_edge.h"
#include "lib/scenario/scenario_program.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {

/// The upper end of a scenario with a ball of one or two axes, by linear programs.
///
/// The wrenches in the plane of the ball that some efforts balance, with any of the free components
/// F, are a polygon. The largest disc about zero in it has the radius of its nearest edge, whose
/// normal is the wrench of the ball that decides:
///
///     P = {z : B u - J'(r E z + F w) = tau_s for some u within limits s and some w},
///     hi_s = min over |d| = 1 of max {d'z : z in P},    infeasible if P leaves out zero.
class BallAcross {
 public:
  /// Whether the ball of a task has one or two axes and stands alone, without `c` or `set`.
  static bool supports(const ScenarioList& list);

  BallAcross(const Problem& problem, Wrench wrench);
  BallAcross(const Problem&& problem, Wrench wrench) = delete;

  /// Finds the end of a scenario at a posture.
  ///
  /// @param at      the posture
  /// @param choice  the scenario; receives the wrench of the ball that decides as `c`
  /// @param most    the search ends early if the end is at least this
  /// @param solver  solves the programs
  /// @return kOptimal: `high` is the end, or at least `most`; negative if P leaves out zero.
  ///         kUnbounded: P is the whole plane. kInfeasible: P is empty; `result` has the proof.
  ///         kNumericalError
  Status find(ScenarioPosture& at, ScenarioChoice& choice, double most, WrenchSolver& solver);

  double high = kInfinity;  ///< the end
  Capability result;        ///< of the last program
  int iterations = 0;       ///< of the solver, in the last call

 private:
  Status support(const Eigen::Vector2d& d, WrenchSolver& solver, Eigen::Vector2d& point);
  Status find_on_line(WrenchSolver& solver);
  Status find_in_plane(double most, WrenchSolver& solver);

  const ScenarioList& list_;
  ScenarioProgram program_;
  NearestEdge edge_;
  Eigen::Vector2d normal_ = Eigen::Vector2d::Zero();
};

}  // namespace maxwrench
