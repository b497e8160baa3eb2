#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "maxwrench/objective.h"
#include "maxwrench/trajectory_program.h"
#include "maxwrench/types.h"

namespace maxwrench {

struct Problem;

/// Everything known at one instant of a motion.
struct Instant {
  double t = 0;                     ///< s
  Pose<double> end_effector, base;  ///< in the world
  Eigen::VectorXd q;                ///< all joints
  Eigen::VectorXd v, v_dot;         ///< n, base twist in base axes and joint rates; its derivative
  Eigen::VectorXd tau_d;            ///< n, by the full dynamics (eq:dynamics)
  Matrix6Xd J;                      ///< 6×n
  Vector6d c = Vector6d::Zero();    ///< the direction in the world
  Vector6d h = Vector6d::Zero();    ///< what the robot exerts
  Eigen::VectorXd u;                ///< m
  double beta() const { return c.dot(h); }
};

/// A table of theta_r and what it is worth.
struct Trajectory : Verdict {
  Eigen::MatrixXd knots;                                    ///< k×r, without theta_0 of an impulse
  std::vector<Instant> instants;                            ///< of an impulse the start first
  double value = std::numeric_limits<double>::quiet_NaN();  ///< N or N m
  double value_between_knots = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none, and why
  Reason between_knots_reason;
  Reason collision;          ///< the first knot that collides, and which bodies; empty: none
  int t_h = 0;               ///< of an impulse: the knot of the peak
  Eigen::MatrixXd gradient;  ///< k×r, of the value
  TrajectorySolution solution;
};

using TrajectorySolverMaker = std::function<std::unique_ptr<TrajectorySolver>()>;

/// Rows on the stacked knots x (k r numbers, row by row): r_min <= R x <= r_max.
struct KnotRows {
  Eigen::SparseMatrix<double> R;
  Eigen::VectorXd r_min, r_max;
};

/// What is limited beside, no linear function of x: its values `at` a trajectory, so to first order
/// r_min <= at + R y <= r_max for a step y of x.
struct DependentRows : KnotRows {
  Eigen::VectorXd at;
};

/// Two bodies of the robot that are near each other at a knot (from 0): how much is left, and its
/// derivative by theta_r there.
struct NearPair {
  int knot = 0;
  double clearance = 0;
  Eigen::VectorXd gradient;  ///< r
};

/// How near the robot comes to itself along a trajectory.
struct Clearance {
  double least = 0;  ///< m, beyond the margin of the collision check; negative: collision
  double t = 0;      ///< s
  std::string pair;  ///< which links, such as "forearm and base"
};

/// Evaluates tables of theta_r of a task in time.
class TrajectoryEvaluator {
 public:
  /// Keeps a reference to the problem; a static one is a task of k = 1. Throws
  /// std::invalid_argument if it has a second contact.
  TrajectoryEvaluator(const Problem& problem, Wrench wrench, const TrajectorySolverMaker& make,
                      bool check_collision = true);
  TrajectoryEvaluator(const Problem&&, Wrench, const TrajectorySolverMaker&, bool = true) = delete;
  ~TrajectoryEvaluator();

  /// knots k×r. The hard program, with u, h and the gradient where it has an optimum. The best t_h
  /// if the task leaves it open. kInvalidPosture names knots and joint where limits, speed limits
  /// or the reach are violated beyond 1e-6, dependent joints' too; a knot that collides is
  /// reported, no more. Instants that dependent joints do not get to are NaN. Throws
  /// std::invalid_argument if the table has the wrong size or is not finite.
  const Trajectory& evaluate(const Eigen::MatrixXd& knots);

  /// The value of the last trajectory on the clamped cubic spline through its knots, see
  /// `Trajectory`. `by`: instead of the evaluator's solver, which may be made for fewer instants.
  void evaluate_between_knots(TrajectorySolver* by = nullptr);

  /// The least of all pairs of bodies on that spline, at the instants of `value_between_knots`, the
  /// earliest of several within 1e-9 m. A pair of which only a test is known counts where it
  /// collides, as 0. Nothing if collisions are not checked, if no distance is known and nothing
  /// collides, or if dependent joints do not get along it.
  std::optional<Clearance> least_clearance();

  /// The elastic program at knots: value less the price of the slack, and its gradient k×r.
  /// -infinity where `evaluate` finds an invalid posture or a knot that collides.
  double evaluate_elastic(const Eigen::MatrixXd& knots, Eigen::MatrixXd* gradient);

  /// After `evaluate_elastic`: whether anything but the wrenches and efforts of single instants
  /// decided, a rate of efforts or a slack.
  bool coupled() const;

  /// After `evaluate_elastic`: the elastic program as a linear one in steps y of the knots too, row
  /// by row (theta_r of the first knot first), about the last answer. The caller sets bounds and
  /// rows of y. Throws std::logic_error if nothing was evaluated.
  TrajectoryProgram& linearize();
  /// The same about knots and the wrenches of all blocks (`TrajectoryProgram::instants`), with
  /// nothing solved. Of an impulse the peak is that of the last answer.
  TrajectoryProgram& linearize(const Eigen::MatrixXd& knots, const std::vector<Eigen::VectorXd>& w);

  /// After `linearize`, about the same trajectory: the limits of dependent joints and of their
  /// rates. Rows are always the same in number and place; none without dependent joints.
  const DependentRows& dependent_rows() const;

  /// The answer of the last `evaluate_elastic`.
  const TrajectorySolution& elastic_solution() const;

  /// The pairs of bodies within `within` [m] of each other at each knot, of those whose distance
  /// is known. Empty if collisions are not checked.
  const std::vector<NearPair>& near_pairs(const Eigen::MatrixXd& knots, double within);

  const Trajectory& trajectory() const;
  /// The hard program of the last `evaluate`.
  const TrajectoryProgram& program() const;
  /// The limits on x, the stacked knots, beside the bounds of each.
  const KnotRows& rows() const;
  int knots() const;  ///< k
  /// Whether the scheme is `spline`, which says what happens between the instants.
  bool smooth() const;
  /// Whether knot 0 is given, from which the others set out.
  bool starts() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// What counts of a trajectory.
enum class TrajectoryValue {
  /// The elastic value, which is that of the hard program where that has one.
  kAtInstants,
  /// The lesser of that and of what is possible between the instants
  /// (`Trajectory::value_between_knots`): no value
  /// where the hard program has none, or nothing is possible there. Of schemes other than `spline`,
  /// which do not say what happens there, kAtInstants.
  kThroughout
};

/// f(x) of the stacked knots x (k r numbers, row by row). No value where the knots violate limits,
/// speed limits or the reach, or collide. The gradient is that at the instants; NaN where less is
/// possible between them. Searches that solve linear programs in the knots ask for the rest.
class TrajectoryObjective : public Objective {
 public:
  /// Its evaluator, which knows what was evaluated last.
  virtual TrajectoryEvaluator& trajectories() = 0;
  virtual TrajectoryValue counts() const = 0;
  /// Of kThroughout: f(x) where the value at the instants is known. Solves two programs.
  virtual double evaluate_throughout(const Eigen::VectorXd& x, double at_instants) = 0;
  /// A clone to which this counts.
  virtual std::unique_ptr<TrajectoryObjective> copy(TrajectoryValue counts) const = 0;
  std::unique_ptr<Objective> clone() const final { return copy(counts()); }
};

/// A static problem is one of k = 1. Throws as `TrajectoryEvaluator`.
std::unique_ptr<TrajectoryObjective> make_trajectory_objective(
    const Problem& problem, Wrench wrench, const TrajectorySolverMaker& make,
    bool check_collision = true, TrajectoryValue counts = TrajectoryValue::kAtInstants);
std::unique_ptr<TrajectoryObjective> make_trajectory_objective(
    const Problem&&, Wrench, const TrajectorySolverMaker&, bool = true,
    TrajectoryValue = TrajectoryValue::kAtInstants) = delete;

/// theta_r at an instant.
Eigen::VectorXd theta_r_at(const Problem& problem, const Instant& instant);

/// k; one of a static problem.
int knots_of(const Problem& problem);

/// One theta_r throughout, k×r.
Eigen::MatrixXd constant_knots(const Problem& problem, const Eigen::VectorXd& theta_r);

/// The table of stacked knots, so many rows, and the other way round.
Eigen::MatrixXd unstacked(const Eigen::VectorXd& x, Eigen::Index knots);
Eigen::VectorXd stacked(const Eigen::MatrixXd& knots);

}  // namespace maxwrench
