#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/robot/kinematics.h"
#include "lib/trajectory/motion_evaluator.h"
#include "lib/trajectory/motion_scenarios.h"
#include "lib/trajectory/program.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// The task in time of a problem, without a second contact. A static task holds its pose at one
/// knot.
/// Throws std::invalid_argument as the constructor of `TrajectoryEvaluator`.
MotionTask task_of(const Problem& problem);

/// What a `TrajectoryEvaluator` keeps from call to call.
struct TrajectoryEvaluator::Workspace {
  Workspace(const Problem& p, Wrench w, const TrajectorySolverMaker& make, bool check);

  /// Limits w_0 of each scenario to its static capability at theta_0.
  void bound_start(const TrajectorySolverMaker& make);
  void require_table(const Eigen::MatrixXd& knots) const;
  /// Why the knots or their motion are not feasible; empty if they are.
  std::string violation() const;
  /// Empty, or the first knot or instant that collides.
  std::string collision();
  /// The motion on the clamped spline through the knots, of which there must be at least two.
  MotionEvaluator& on_spline();
  /// The block of a knot of an impulse.
  int block_of(const SchemeMaps& maps, int knot) const;
  /// Solves for the task's t_h, or for every t_h, and keeps the best.
  void solve_best(TrajectoryProgram& p, TrajectorySolver& with, TrajectorySolution& best, int& t_h);
  /// Uses the hard program's answer if there is one, because that program is cheaper to solve. Its
  /// answer is also that of the elastic program unless a multiplier exceeds the weight of the
  /// slack; then slack costs less than a smaller wrench. If t_h is free, the best t_h may need
  /// slack, so the elastic program is solved first.
  void solve_elastic();
  bool solve_hard();
  /// Sets efforts, wrenches and c of the instants to those of a scenario.
  void read(const TrajectoryProgram& p, const TrajectorySolution& solution, int scenario);
  /// Sets them to those of the scenario that decides, which it notes.
  void read_deciding(const TrajectoryProgram& p, const TrajectorySolution& solution);
  /// The gradient of sum_i lambda_i'f_i over the blocks of all scenarios.
  void pull_back(const TrajectoryProgram& p, const TrajectorySolution& solution,
                 Eigen::MatrixXd& gradient);

  const Problem& problem;
  const MotionTask task;
  const std::vector<MotionScenario> scenarios;
  const bool check_collision;
  MotionEvaluator motion;
  TrajectoryProgram program, elastic, bordered;
  std::unique_ptr<TrajectorySolver> solver, elastic_solver;
  Kinematics<double> links;
  std::vector<NearPair> near;
  KnotRows rows;
  DependentRows following;
  std::vector<MotionSlopes> slopes;
  TrajectorySolution elastic_solution, other;
  const TrajectorySolution* about = nullptr;  ///< what `linearize` linearises about
  Eigen::MatrixXd Q, lambda, all_gradient, G;
  std::optional<MotionEvaluator> fine;
  Trajectory trajectory;
};

}  // namespace maxwrench
