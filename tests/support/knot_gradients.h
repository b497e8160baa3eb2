#pragma once

#include <gtest/gtest.h>

#include "lib/math/random.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {

/// These knots, each coordinate moved a little at random, so that nothing is special.
inline Eigen::MatrixXd moved_a_little(Eigen::MatrixXd knots, Random& random) {
  for (double& entry : knots.reshaped()) entry += 0.02 * random.normal();
  return knots;
}

/// Compares the gradient at knots of a value with central differences.
inline void expect_knot_gradient(TrajectoryEvaluator& evaluator, const Eigen::MatrixXd& knots,
                                 double tolerance) {
  const Eigen::MatrixXd gradient = evaluator.evaluate(knots).gradient;
  ASSERT_EQ(evaluator.trajectory().status, Status::kOptimal);
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    Eigen::MatrixXd up = knots, down = knots;
    up.reshaped()[i] += kStep;
    down.reshaped()[i] -= kStep;
    const double rise = evaluator.evaluate(up).value - evaluator.evaluate(down).value;
    EXPECT_NEAR(gradient.reshaped()[i], rise / (2 * kStep), tolerance) << i;
  }
}

}  // namespace maxwrench
