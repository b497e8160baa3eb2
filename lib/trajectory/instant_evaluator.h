#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lib/robot/dynamics.h"
#include "lib/robot/kinematics.h"
#include "lib/trajectory/motion_scenarios.h"
#include "lib/trajectory/robot_motion.h"
#include "lib/trajectory/scheme.h"
#include "maxwrench/capability.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/wrench_solver.h"

namespace maxwrench {

/// What the robot can exert at one instant of a task in time by itself, whatever happens before and
/// after: at theta_r, theta_r_dot and theta_r_ddot of this instant
///
///     max c_w'w   subject to   B u - J'W w = tau_d(theta_r, theta_r_dot, theta_r_ddot),
///                              u_min <= u <= u_max,
///
/// without rate limits of efforts. Of a list of scenarios the least value of all. The least value
/// over all instants of a motion is then its value, if no effort rate binds: that of a path by
/// definition, that of a factor c (a payload, a table of wrenches) if the robot can also make the
/// motion without it. The instants are those of the clamped spline, whatever the scheme of the
/// task, as for `Trajectory::value_between_knots`.
///
/// Use one object per thread.
class InstantEvaluator {
 public:
  /// Makes a solver of programs with one free wrench column and few facets, or of any.
  using SolverMaker = std::function<std::unique_ptr<WrenchSolver>(bool one_column)>;

  /// The problem must outlive this object and be one that `TrajectoryEvaluator` supports.
  InstantEvaluator(const Problem& problem, Wrench wrench, const SolverMaker& make,
                   bool check_collision);
  InstantEvaluator(const Problem&&, Wrench, const SolverMaker&, bool) = delete;

  const Problem& problem() const { return problem_; }
  const MotionTask& task() const { return task_; }
  /// The spline through the knots; of a task with one knot the robot rests there.
  const SchemeMaps& maps() const { return maps_; }
  int per_interval() const { return per_interval_; }

  /// Forgets the dependent joints of the last instant. The next ones are then those that a straight
  /// line reaches from the guess, otherwise those that it reaches from the last instant.
  void restart();
  /// The value at an instant; -infinity if the posture or its motion violates a limit of dependent
  /// joints, the reach or the path, or if no efforts balance it.
  double value(int instant, const Eigen::VectorXd& theta_r, const Eigen::VectorXd& rate,
               const Eigen::VectorXd& acceleration);
  /// Whether the posture of the last `value` collides.
  bool collides();
  /// All joints at the last `value`.
  const Eigen::VectorXd& q() const { return instants_.front().q; }

 private:
  const char* move_to(const PathPoint& x, const Eigen::VectorXd& theta_r,
                      const Eigen::VectorXd& rate, const Eigen::VectorXd& acceleration);
  double least_of_scenarios();

  const Problem& problem_;
  const MotionTask task_;
  const bool check_collision_;
  const int per_interval_;
  const SchemeMaps maps_;
  const std::vector<MotionScenario> scenarios_;
  SchemeMaps one_;             ///< of the instant alone
  TrajectoryProgram program_;  ///< one block for each scenario
  std::vector<std::unique_ptr<WrenchSolver>> solvers_;
  RobotMotionTracker tracker_;
  bool fresh_ = true;  ///< the tracker starts from the guess
  Dynamics dynamics_;
  Kinematics<double> links_;
  std::vector<Instant> instants_;
  Capability capability_;
};

class WindowEvaluator;

/// An objective that can evaluate instants and stretches of a motion by themselves, for searches
/// over them.
class InstantSource {
 public:
  virtual ~InstantSource() = default;
  virtual std::unique_ptr<InstantEvaluator> make_instants(
      const InstantEvaluator::SolverMaker& make) const = 0;
  /// Of a task along a path.
  virtual std::unique_ptr<WindowEvaluator> make_window(SchemeMaps maps) const = 0;
};

}  // namespace maxwrench
