#pragma once

#include <memory>

#include "maxwrench/batch.h"
#include "maxwrench/trajectory.h"
#include "solvers/search/linear_steps.h"
#include "solvers/search/probe.h"

namespace maxwrench {

/// Moves bodies that collide at the trajectory x apart, by Newton's method along the gradients of
/// their clearance and within the bounds of the objective. Neighbouring instants between knots move
/// the same knots, so each takes up what those before it have left.
Eigen::VectorXd moved_apart(TrajectoryEvaluator& trajectories, const Objective& objective,
                            Eigen::VectorXd x);

/// One local search by sequential linear programming. Each step y of the knots comes from a linear
/// program in the knots, the efforts and the wrenches at once,
///
///     max t - rho sum |s_i|_1   subject to the balance linearised at the last trajectory, |y| <=
///     radius, the limits and speed limits of the knots, to first order those of dependent joints,
///     and no bodies nearer than their margin to first order.
///
/// A step is accepted if the elastic value, an exact penalty function, rises by
/// a share of what the linear program predicted. This share also determines the next radius. Knots
/// that collide after a step are moved apart.
class SlpRun {
 public:
  /// Takes a clone of the objective. `start` must have a value at its instants, which the local
  /// search maximises. `alike`: all knots take the same step, and the program has the coordinates
  /// of one knot. `guides`: the objective is not the function that the search maximises, so none of
  /// its values is reported.
  SlpRun(const TrajectoryObjective& objective, Candidate start, SearchRun& run, bool alike = false,
         bool guides = false);

  /// Continues until it has converged or has used this many evaluations. A linear program counts as
  /// one.
  void optimise(long evaluations);

  /// Ends the local search of a trajectory with one factor at all instants by SLSQP between facets,
  /// from the best point, until this many evaluations are used. Where efforts jump between their
  /// limits, the optimum is no vertex of the linear programs, and these crawl. Does nothing for
  /// other trajectories, and in a build without NLopt.
  void polish(long evaluations);

  /// The most evaluations of `worth`: the program at the instants, and that between them.
  static constexpr int kJudgement = 2;
  /// The objective's value of a trajectory with this value at its instants. The two are the same if
  /// the objective uses the value at the instants; otherwise this call ends the local search.
  double worth(const Candidate& trajectory);

  /// One evaluation at x, from which the local search does not continue.
  Candidate look(const Eigen::VectorXd& x) { return {x, evaluate(x)}; }

  // Values at the instants.
  double value() const { return at_.value; }
  const Candidate& at() const { return at_; }
  const Candidate& best() const { return best_; }  ///< best evaluated point, the start included

  /// Values of the objective, and how its linear programs were solved: one call "facets" or "ipm"
  /// of slp for each.
  const Part& found() const { return found_; }

 private:
  double evaluate(const Eigen::VectorXd& x);
  void note(const Eigen::VectorXd& x, double value);
  TrajectoryProgram* linearize();
  bool try_step();
  bool solve();
  void set_bounds();
  void set_rows();
  Eigen::VectorXd inside(const Eigen::VectorXd& x) const;

  std::unique_ptr<TrajectoryObjective> objective_;
  TrajectoryEvaluator& trajectories_;
  SearchRun& run_;
  Eigen::MatrixXd shared_;  ///< step of one knot -> steps of all; empty: separate steps
  StepSolver solver_;
  bool coupled_ = true;  ///< at the last point with a value
  Candidate at_, best_;
  bool guides_;  ///< the values at the instants are not those of the objective
  TrustRegion trust_;
  StepRows rows_;
  bool done_ = false;
  TrajectoryProgram* program_ = nullptr;  ///< about at_; null: not linearised yet
  Part found_;
};

}  // namespace maxwrench
