#pragma once

#include <memory>

#include "lib/trajectory/window_evaluator.h"
#include "solvers/search/linear_steps.h"
#include "solvers/search/path_plan.h"

namespace maxwrench {

/// The plan of one horizon: the control points of `make_spline_window` from the present knot on,
/// and their improvement by sequential linear programming. The steps are those of `SlpRun`,
///
///     max t   subject to   the balance of the horizon's instants linearised at the last plan,
///                          |y| <= radius, limits and differences of the control points, to first
///                          order the limits of dependent joints and the distances of bodies,
///
/// in the control points that are not given, and are accepted by the share of the predicted rise.
class MpcWindow {
 public:
  /// Knots `first` to `last` of the task.
  MpcWindow(const InstantSource& source, const Problem& problem, int first, int last,
            InstantCount& count);

  /// Control points that the state gives, before the table of the others.
  int given() const { return window_->maps().before; }
  /// All control points (K×r) from the first given one, or from P_0, to P_last.
  const Eigen::MatrixXd& points() const { return P_; }
  double value() const { return value_; }  ///< least value of the horizon's instants
  /// Whether evaluations ran out.
  bool stopped() const { return stopped_; }

  /// Makes the control points the plan. They satisfy the limits.
  void set(const Eigen::MatrixXd& P);
  /// The same if their value is larger.
  void offer(const Eigen::MatrixXd& P);
  /// Improves the plan by at most this many steps.
  void optimise(int steps);

 private:
  bool pay();
  double evaluate(const Eigen::MatrixXd& P);
  void keep_limits(Eigen::MatrixXd& P) const;
  void move_apart(Eigen::MatrixXd& P);
  void set_bounds(TrajectoryProgram& program, double radius);
  void set_rows(TrajectoryProgram& program, double radius);

  const Problem& problem_;
  InstantCount& count_;
  std::unique_ptr<WindowEvaluator> window_;
  Eigen::VectorXd step_;  ///< of neighbouring control points, at most (r)
  Eigen::MatrixXd P_;
  double value_ = -kInfinity;
  bool stopped_ = false;
  StepRows rows_;
  StepSolver solver_;
};

}  // namespace maxwrench
