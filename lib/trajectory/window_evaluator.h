#pragma once

#include <memory>
#include <vector>

#include "lib/robot/kinematics.h"
#include "lib/trajectory/motion_evaluator.h"
#include "lib/trajectory/motion_scenarios.h"
#include "lib/trajectory/scheme.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// The maps of one instant of a path at which theta_r rests: theta_r = Q, theta_r_dot =
/// theta_r_ddot = 0. The end effector moves as the path does.
SchemeMaps make_resting_instant(const MotionTask& task, double t = 0);

/// The maps of the uniform cubic B-spline with control points P_0 .. P_(K - 1), a duration dt
/// apart, from knot `first` to knot `last` of the path, 0 <= first < last < K. It ends at rest at
/// knot `last`: P_(last + 1) = P_(last - 1).
///
/// If `first` is 0, it starts at rest likewise, all control points P_0 .. P_last are columns, and
/// the instants begin with t = 0. Otherwise the state of the motion at knot `first` is given: its
/// control points P_(first - 1) .. P_(first + 1) are the first three columns, those `before` the
/// table; the instants begin after that knot, at which nothing can be changed.
SchemeMaps make_spline_window(const MotionTask& task, int first, int last);

/// Evaluates a stretch of a motion along a path, whatever happens before and after it: the least
/// value of its instants, with the effort rates and the lag of the task between them.
///
/// Use one object per thread.
class WindowEvaluator {
 public:
  /// The problem must outlive this object. Its task is a path.
  WindowEvaluator(const Problem& problem, Wrench wrench, const TrajectorySolverMaker& make,
                  bool check_collision, SchemeMaps maps);
  WindowEvaluator(const Problem&&, Wrench, const TrajectorySolverMaker&, bool, SchemeMaps) = delete;

  const Problem& problem() const { return problem_; }
  const SchemeMaps& maps() const { return motion_.maps(); }

  /// Moves the only instant, of `make_resting_instant`, to a time of the path.
  void set_time(double t);
  /// The value at a table of all columns (K×r). If no efforts balance the motion, it is that of the
  /// elastic program, as of `TrajectoryEvaluator::evaluate_elastic`; -infinity if there is none, or
  /// a dependent joint exceeds a limit. Limits of theta_r and its rates are left to the caller.
  double evaluate(const Eigen::MatrixXd& Q);
  /// After `evaluate`: whether a knot in the stretch, or its only instant, collides.
  bool collides();
  /// After an `evaluate` with a value: its gradient by Q (K×r), at a kink one of several.
  void gradient(Eigen::MatrixXd& gradient);
  /// After `gradient`: A_r at an instant (n×r), of v = J_e x_dot + A_r theta_r_dot.
  const Eigen::MatrixXd& A_r(int instant) const {
    return slopes_[static_cast<std::size_t>(instant)].v_rate;
  }
  /// After an `evaluate` with a value: v at an instant (n).
  const Eigen::VectorXd& v(int instant) const {
    return instants_[static_cast<std::size_t>(instant)].v;
  }
  /// After an `evaluate` with a value: whether effort rates, lags or slack determine it.
  bool coupled() const;
  /// After an `evaluate` with a value: the elastic program, linearised in steps y of the columns
  /// after those `before`, stacked row by row. The caller sets the bounds and rows of y.
  TrajectoryProgram& linearize();
  /// After `linearize`: the limits of dependent joints, to first order.
  const DependentRows& dependent_rows() const { return dependent_rows_; }
  /// The pairs of bodies within this distance [m] at the knots in the stretch; `NearPair::knot` is
  /// the instant.
  const std::vector<NearPair>& near_pairs(const Eigen::MatrixXd& Q, double within);

 private:
  bool is_knot(int instant) const;
  void read_scenario(int scenario);

  const Problem& problem_;
  const MotionTask task_;
  const std::vector<MotionScenario> scenarios_;
  const bool check_collision_;
  MotionEvaluator motion_;
  SchemeMaps turned_from_start_;  ///< the maps; wrenches that turn do so from the path's start
  TrajectoryProgram program_, bordered_;
  std::unique_ptr<TrajectorySolver> solver_;
  TrajectorySolution solution_;
  Kinematics<double> links_;
  std::vector<Instant> instants_;
  std::vector<MotionSlopes> slopes_;
  std::vector<NearPair> near_;
  DependentRows dependent_rows_;
  Eigen::MatrixXd lambda_, part_, G_;
};

}  // namespace maxwrench
