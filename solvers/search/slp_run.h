#pragma once

#include <memory>
#include <vector>

#include "maxwrench/batch.h"
#include "maxwrench/trajectory.h"
#include "solvers/search/probe.h"
#include "solvers/trajectory/bordered_facets.h"

namespace maxwrench {

/// One local search of sequential linear programming: each step y of the knots comes from a linear
/// program in the knots, the efforts and the wrenches at once,
///
///     max t - rho sum |s_i|_1   subject to the balance linearised at the last trajectory, |y| <=
///     radius, the limits and speed limits of the knots, to first order those of dependent joints,
///     and no bodies nearer than their margin to first order.
///
/// While neither effort rates nor slacks decide, the program without them is enough
/// (`BorderedFacets`). A step counts if the elastic value, an exact penalty function, rises by a
/// share of what the linear program predicted; the radius follows from that share. Knots that
/// collide after a step are moved apart.
class SlpRun {
 public:
  /// Takes a clone of the objective. `start` has a value at its instants, by which it local
  /// searches. `alike`: all knots take the same step, a program in the coordinates of one.
  SlpRun(const TrajectoryObjective& objective, Candidate start, SearchRun& run, bool alike = false);

  /// Goes on until it has converged or has used so many evaluations; a linear program counts as
  /// one.
  void optimise(long evaluations);

  /// What `worth` costs at most: the program at the instants, and that between them.
  static constexpr int kJudgement = 2;
  /// What the objective makes of a trajectory with this value at its instants, which is the value
  /// itself where nothing else counts. Ends the local search otherwise.
  double worth(const Candidate& trajectory);

  /// One evaluation elsewhere, which the local search does not follow.
  Candidate look(const Eigen::VectorXd& x) { return {x, evaluate(x)}; }

  // Values at the instants.
  double value() const { return at_.value; }
  const Candidate& at() const { return at_; }
  const Candidate& best() const { return best_; }  ///< of what was evaluated, the start included

  /// Values of the objective, and how its linear programs were solved: a call "facets" or "ipm" of
  /// slp for each.
  const Part& found() const { return found_; }

 private:
  double evaluate(const Eigen::VectorXd& x);
  void note(const Eigen::VectorXd& x, double value);
  TrajectoryProgram* linearize();
  bool try_step();
  bool solve();
  void set_bounds();
  void add_rows(const Eigen::SparseMatrix<double>& R, const Eigen::VectorXd& reach,
                const Eigen::VectorXd& low, const Eigen::VectorXd& high);
  void set_rows();
  Eigen::VectorXd inside(const Eigen::VectorXd& x) const;
  Eigen::VectorXd apart(Eigen::VectorXd x);

  std::unique_ptr<TrajectoryObjective> objective_;
  TrajectoryEvaluator& trajectories_;
  SearchRun& run_;
  Eigen::MatrixXd shared_;  ///< the step of the knots by that of one; empty: each its own
  BorderedFacets uncoupled_;
  std::unique_ptr<TrajectorySolver> solver_;
  bool coupled_ = true;  ///< at the last point with a value
  Candidate at_, best_;
  double radius_;
  Eigen::VectorXd reach_;  ///< of each row of the knots: sum of the magnitudes of its entries
  bool done_ = false;
  TrajectoryProgram* program_ = nullptr;  ///< about at_; null: not linearised yet
  TrajectorySolution solution_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> low_, high_;
  std::vector<int> row_of_;
  Part found_;
};

}  // namespace maxwrench
