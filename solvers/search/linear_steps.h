#pragma once

#include <memory>
#include <vector>

#include "solvers/trajectory/bordered_facets.h"

namespace maxwrench {

inline constexpr double kNearing = 2;   ///< m per radius: how much nearer bodies may come
inline constexpr double kSpare = 1e-9;  ///< m, added to the margin when bodies are moved apart
inline constexpr int kApartRounds = 5;  ///< rounds of moving bodies apart

/// The radius within which a linear program is trusted [rad or m].
class TrustRegion {
 public:
  explicit TrustRegion(double radius) : radius_(radius) {}
  double radius() const { return radius_; }

  /// After a step whose largest component is `size`, and with which the value has risen by `risen`
  /// of `predicted`: sets the next radius. Returns whether the step is accepted.
  bool judge(double risen, double predicted, double size);

 private:
  double radius_;
};

/// The rows low <= R y <= high of the linear program of a step y.
class StepRows {
 public:
  void clear();
  /// An entry of the row that the next call of `end_row` ends.
  void add(Eigen::Index column, double value);
  /// y = 0 is always allowed: a violation by rounding must not make the program infeasible.
  void end_row(double low, double high);
  /// Adds low <= R y <= high without the rows that no |y| <= radius reaches.
  void add(const Eigen::SparseMatrix<double>& R, const Eigen::VectorXd& low,
           const Eigen::VectorXd& high, double radius = kInfinity);
  /// Makes them the rows of the program, with so many columns.
  void move_to(TrajectoryProgram& program, Eigen::Index columns) const;

 private:
  Eigen::Index count() const { return static_cast<Eigen::Index>(low_.size()); }

  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> low_, high_;
  std::vector<Eigen::Index> row_of_;
  Eigen::VectorXd reach_;  ///< of each row of R: the sum of the magnitudes of its entries
};

/// Solves the linear programs of steps.
class StepSolver {
 public:
  StepSolver();

  /// While neither effort rates nor slacks matter, which is `coupled`, the program without them is
  /// enough. Returns whether there is an answer.
  bool solve(const TrajectoryProgram& program, bool coupled);
  bool by_facets() const { return by_facets_; }
  const TrajectorySolution& solution() const { return solution_; }

 private:
  BorderedFacets facets_;
  std::unique_ptr<TrajectorySolver> ipm_;
  TrajectorySolution solution_;
  bool by_facets_ = false;
};

}  // namespace maxwrench
