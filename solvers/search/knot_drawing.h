#pragma once

#include "lib/math/random.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// Draws tables of knots around a start that satisfy the rows of the limits. Tables are stacked: k
/// r numbers, row by row.
class KnotDrawing {
 public:
  /// Keeps references to the objective and to the rows of its trajectories, but a copy of `start`.
  KnotDrawing(const Objective& objective, const TrajectoryEvaluator& trajectories,
              Eigen::VectorXd start);

  /// A table near the start or anywhere. All knots move by the same offset, unless the knot before
  /// the table is given. To a transfer a smooth curve is added.
  Eigen::VectorXd draw(Random random, bool near) const;

  /// Moves each number of the table by `reach` at most; with `alike`, each coordinate alike at all
  /// knots.
  Eigen::VectorXd kick(Random random, double reach, bool alike) const;

  /// The table after the largest share of a step, 1 at most, that the rows permit. In an impulse
  /// each coordinate has a share of its own, as each row is of one coordinate: the slowest joint
  /// does not hold the others back, and a joint at its limit does not stop them.
  Eigen::VectorXd moved(Eigen::VectorXd offset) const;

 private:
  Eigen::VectorXd bump(Random& random, double reach) const;
  Eigen::VectorXd shares(const Eigen::VectorXd& offset) const;

  const Objective& objective_;
  const KnotRows& rows_;
  Eigen::VectorXd start_;
  bool alike_;  ///< whether the knots of a table move alike
  Eigen::Index knots_;
  bool between_;  ///< whether both ends are given: a transfer
  Eigen::MatrixXd equations_, inverse_;
  Eigen::VectorXd down_, up_;  ///< limits of the offset, for all knots if they move alike
};

}  // namespace maxwrench
