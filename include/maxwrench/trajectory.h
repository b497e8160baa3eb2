#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/trajectory_program.h"
#include "maxwrench/types.h"

/// @file
/// Trajectories: tables of knots of theta_r, their values and gradients.

namespace maxwrench {

struct Problem;

/// Everything known at one instant of a motion.
struct Instant {
  double t = 0;               ///< time [s]
  Pose<double> end_effector,  ///< pose of the end effector in the world
      base;                   ///< pose of the base in the world
  Eigen::VectorXd q;          ///< positions of all joints [rad or m]
  Eigen::VectorXd v,          ///< velocities (n): base twist in base axes, then joint rates
      v_dot;                  ///< derivative of v (n)
  Eigen::VectorXd tau_d;      ///< forces of the full dynamics (n) [N, N m] (eq:dynamics)
  Matrix6Xd J;                ///< Jacobian of the end effector (6×n)
  /// The direction, in the world; of a payload or a table of wrenches the wrench of 1 kg or of the
  /// factor 1. Of a list of scenarios the wrench of the one that decides.
  Vector6d c = Vector6d::Zero();
  Vector6d h = Vector6d::Zero();  ///< the wrench that the robot exerts [N; N m]
  Eigen::VectorXd u;              ///< efforts (m)
  /// The factor of c, of a task with one factor for all instants or with a list of scenarios;
  /// otherwise NaN.
  double factor = std::numeric_limits<double>::quiet_NaN();
  /// Returns the wrench along c [N or N m], or the factor of c.
  double beta() const { return std::isnan(factor) ? c.dot(h) : factor; }
};

/// A table of knots of theta_r, with its instants and its value.
struct Trajectory : Verdict {
  Eigen::MatrixXd knots;          ///< knots of theta_r (k×r), without theta_0 of an impulse
  std::vector<Instant> instants;  ///< the instants; of an impulse the start first
  /// Value [N or N m]. Along a path: the least wrench along c at any instant. Of an impulse: the
  /// wrench along c at the peak. Of a payload its mass [kg], of a table of wrenches their factor.
  double value = std::numeric_limits<double>::quiet_NaN();
  /// The value between knots: that of the clamped spline through the knots at many more instants [N
  /// or N m]. NaN: none.
  double value_between_knots = std::numeric_limits<double>::quiet_NaN();
  Reason between_knots_reason;  ///< why there is no value between knots
  /// Of a transfer: how far the largest effort exceeds its limit between instants, as a share of
  /// the limit [-]. Negative: all are within their limits. NaN: not computed.
  double overshoot = std::numeric_limits<double>::quiet_NaN();
  /// The same of the speeds of joints, at the extremes of their cubics, as a share of the limit
  /// [-].
  double speed_overshoot = std::numeric_limits<double>::quiet_NaN();
  /// How far a joint exceeds its limits between instants, likewise [rad or m].
  double limit_overshoot = std::numeric_limits<double>::quiet_NaN();
  Reason collision;          ///< the first knot that collides, and the bodies; empty: none collides
  int t_h = 0;               ///< of an impulse: the knot of the peak
  Eigen::MatrixXd gradient;  ///< gradient of the value (k×r)
  TrajectorySolution solution;  ///< the solution of the trajectory program
  /// The scenario that decides, if the task has a list of scenarios: the first with the largest
  /// share of the multipliers. Efforts and wrenches of the instants are its own; c is that of the
  /// instant that decides.
  ScenarioChoice decides;
  int decides_at = -1;  ///< the instant that decides, in `instants`; -1: there is no value
};

/// A function that makes a solver of trajectory programs.
using TrajectorySolverMaker = std::function<std::unique_ptr<TrajectorySolver>()>;

/// Linear constraints r_min <= R x <= r_max on the stacked knots x (k r numbers, row by row).
struct KnotRows {
  Eigen::SparseMatrix<double> R;  ///< matrix (rows×(k r))
  Eigen::VectorXd r_min,          ///< lower limits (rows)
      r_max;                      ///< upper limits (rows)
};

/// Constraints on nonlinear functions of x, linearised at a trajectory.
///
/// To first order, r_min <= at + R y <= r_max for a step y of x.
struct DependentRows : KnotRows {
  Eigen::VectorXd at;  ///< values of the functions at the trajectory
};

/// Two bodies of the robot that are near each other at a knot, or at an instant between knots.
struct NearPair {
  int knot = 0;              ///< the knot, from 0; -1 at an instant between knots
  double clearance = 0;      ///< distance less the margin [m]
  Eigen::VectorXd gradient;  ///< derivative of the clearance by theta_r there (r)
  /// Of an instant between knots: theta_r there is the sum of the knots (k) with these weights, and
  /// of what is given. Empty at a knot.
  Eigen::VectorXd weights;
};

/// The least distance of two bodies of the robot along a trajectory.
struct Clearance {
  /// Least distance less the margin of the collision check [m]; negative: collision.
  double least = 0;
  double t = 0;      ///< time [s]
  std::string pair;  ///< links of the bodies, such as "forearm and base"
};

/// Evaluates trajectories of a task in time.
///
/// Of a list of scenarios, each has efforts of its own at all instants, and the value is the
/// largest one that all of them hold.
///
/// Use one object per thread. The table `knots` of its functions is k×r.
class TrajectoryEvaluator {
 public:
  /// Keeps a reference to the problem, which must outlive the evaluator.
  ///
  /// @param problem          the task; a static one is a task of k = 1
  /// @param wrench           the allowed wrenches
  /// @param make             makes the solver of trajectory programs
  /// @param check_collision  whether to check collisions
  /// @throws std::invalid_argument if the problem has a second contact, or is static with free
  ///         coordinates of the pose. Also if the scheme does not support the task, or if the
  ///         posture at the start of an impulse has no static capability (`Start::kStatic`).
  TrajectoryEvaluator(const Problem& problem, Wrench wrench, const TrajectorySolverMaker& make,
                      bool check_collision = true);
  /// Deleted: the problem must outlive the evaluator, and a temporary does not.
  TrajectoryEvaluator(const Problem&&, Wrench, const TrajectorySolverMaker&, bool = true) = delete;
  ~TrajectoryEvaluator();

  /// Solves the hard program, without slack, at a table of knots.
  ///
  /// If it has an optimum, the trajectory gets u, h and the gradient. If the task leaves t_h open,
  /// the best one is used. The status is kInvalidPosture, with knots and joint, if limits, speed
  /// limits or the reach are violated by more than 1e-6, also by dependent joints. A knot that
  /// collides is only reported. Instants that dependent joints do not reach are NaN.
  ///
  /// @param knots  the knots (k×r)
  /// @return the trajectory, valid until the next call
  /// @throws std::invalid_argument if the table has the wrong size or is not finite.
  const Trajectory& evaluate(const Eigen::MatrixXd& knots);

  /// Computes `Trajectory::value_between_knots` of the last trajectory.
  ///
  /// @param by  a solver to use instead of that of the evaluator, which may be designed for fewer
  ///            instants; null: none
  void evaluate_between_knots(TrajectorySolver* by = nullptr);

  /// Returns the least distance of all pairs of bodies on the spline of the last trajectory.
  ///
  /// It uses the instants of `value_between_knots`, and the earliest of several within 1e-9 m. A
  /// pair that has a test for collision only counts as 0 where it collides.
  ///
  /// @return nothing if collisions are not checked, if no pair has a distance and none collides, or
  ///         if dependent joints cannot follow the spline
  std::optional<Clearance> least_clearance();

  /// Solves the elastic program at a table of knots.
  ///
  /// @param knots     the knots (k×r)
  /// @param gradient  if not null, receives the gradient k×r of the result
  /// @return the value less the price of the slack; -infinity where `evaluate` finds an invalid
  ///         posture, where a knot collides, or without an optimum
  double evaluate_elastic(const Eigen::MatrixXd& knots, Eigen::MatrixXd* gradient);

  /// Returns whether a rate limit of efforts or a slack determines the last elastic value.
  ///
  /// Otherwise only the wrenches and efforts of single instants do.
  bool coupled() const;

  /// Linearises the elastic program of the last `evaluate_elastic` in steps y of the knots.
  ///
  /// y is stacked row by row: theta_r of the first knot comes first. The caller sets the bounds and
  /// rows of y.
  ///
  /// @throws std::logic_error if nothing was evaluated.
  TrajectoryProgram& linearize();
  /// Linearises the elastic program about given knots and wrenches, without solving it.
  ///
  /// For an impulse, the peak is that of the last solution.
  ///
  /// @param knots  the knots (k×r)
  /// @param w      the wrenches of all blocks (`TrajectoryProgram::instants`)
  TrajectoryProgram& linearize(const Eigen::MatrixXd& knots, const std::vector<Eigen::VectorXd>& w);

  /// Returns the limits of dependent joints and of their rates, after `linearize` at the same
  /// trajectory.
  ///
  /// Number and order of the rows are always the same. There are none without dependent joints.
  const DependentRows& dependent_rows() const;

  /// Returns the solution of the last `evaluate_elastic`.
  const TrajectorySolution& elastic_solution() const;

  /// Returns the pairs of bodies that are near each other at a knot, or at any instant
  /// (`MotionTask::clear_at_instants`).
  ///
  /// It includes only pairs that have a distance. The result is empty if collisions are not
  /// checked.
  ///
  /// @param knots   the knots (k×r)
  /// @param within  largest distance [m]
  const std::vector<NearPair>& near_pairs(const Eigen::MatrixXd& knots, double within);

  /// Returns the last trajectory.
  const Trajectory& trajectory() const;
  /// Returns the hard program of the last `evaluate`.
  const TrajectoryProgram& program() const;
  /// Returns the constraints on the stacked knots x in addition to the bounds of each.
  const KnotRows& rows() const;
  int knots() const;  ///< Returns the number of rows of a table, as `knots_of`.
  /// Returns whether the scheme is `spline`, which defines the motion between the instants.
  bool smooth() const;
  /// Returns whether the knot before the table is given, from which the motion starts.
  bool starts() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// The value of a trajectory that a search maximises.
enum class TrajectoryValue {
  /// The elastic value. It equals that of the hard program if that has an optimum.
  kAtInstants,
  /// The smaller one of the elastic value and `Trajectory::value_between_knots`. It does not exist
  /// if the hard program has no optimum or there is no value between knots. Schemes other than
  /// `spline` do not define the motion between instants, so they use kAtInstants.
  kThroughout
};

/// The objective f(x) of the stacked knots x (k r numbers, row by row).
///
/// It has no value where the knots violate limits, speed limits or the reach, or collide. The
/// gradient is that of the value at the instants. It is NaN where the value between knots is
/// smaller. Searches that solve linear programs in the knots use the functions of the evaluator.
class TrajectoryObjective : public Objective {
 public:
  /// Returns the evaluator, which holds the last trajectory.
  virtual TrajectoryEvaluator& trajectories() = 0;
  /// Returns which value counts.
  virtual TrajectoryValue counts() const = 0;
  /// Computes the value kThroughout where the value at the instants is known. It solves two
  /// programs.
  ///
  /// @param x            the stacked knots
  /// @param at_instants  the elastic value at x
  /// @return f(x)
  virtual double evaluate_throughout(const Eigen::VectorXd& x, double at_instants) = 0;
  /// Returns a clone for which the value `counts` counts.
  virtual std::unique_ptr<TrajectoryObjective> copy(TrajectoryValue counts) const = 0;
  /// Returns the objective of the same task with fewer knots and instants.
  ///
  /// Its values at the instants cost a fraction, and its best trajectories are near those of the
  /// task. So they can guide a search.
  ///
  /// @return nothing for an impulse, a transfer, a scheme other than `spline`, and a task that has
  ///         few knots
  virtual std::unique_ptr<TrajectoryObjective> coarser() const { return nullptr; }
  std::unique_ptr<Objective> clone() const final { return copy(counts()); }
};

/// Makes the objective of the trajectories of a task.
///
/// @param problem          the task, which must outlive the objective; a static one is a task of
///                         k = 1
/// @param wrench           the allowed wrenches
/// @param make             makes the solver of trajectory programs
/// @param check_collision  whether knots that collide have no value
/// @param counts           which value counts
/// @throws std::invalid_argument as `TrajectoryEvaluator`.
std::unique_ptr<TrajectoryObjective> make_trajectory_objective(
    const Problem& problem, Wrench wrench, const TrajectorySolverMaker& make,
    bool check_collision = true, TrajectoryValue counts = TrajectoryValue::kAtInstants);
/// Deleted: the problem must outlive the objective, and a temporary does not.
std::unique_ptr<TrajectoryObjective> make_trajectory_objective(
    const Problem&&, Wrench, const TrajectorySolverMaker&, bool = true,
    TrajectoryValue = TrajectoryValue::kAtInstants) = delete;

/// Returns theta_r (r) at an instant.
Eigen::VectorXd theta_r_at(const Problem& problem, const Instant& instant);

/// Returns the number of knots of a table: k, one for a static problem, k - 2 of a transfer.
int knots_of(const Problem& problem);

/// Returns a table of knots (k×r) that all equal `theta_r`.
Eigen::MatrixXd constant_knots(const Problem& problem, const Eigen::VectorXd& theta_r);

/// Returns the default table of a task: the default of theta_r throughout. Of a transfer it is the
/// straight line from its start to its end, with the progress 3 s^2 - 2 s^3.
Eigen::MatrixXd default_knots(const Problem& problem);

/// Returns the table of stacked knots.
///
/// @param x      the stacked knots: k r numbers, row by row
/// @param knots  the number of knots, k
/// @return the table (k×r)
Eigen::MatrixXd unstacked(const Eigen::VectorXd& x, Eigen::Index knots);
/// Returns the stacked knots of a table (k×r): k r numbers, row by row.
Eigen::VectorXd stacked(const Eigen::MatrixXd& knots);

}  // namespace maxwrench
