#pragma once

#include <gtest/gtest.h>

#include <string>

#include "maxwrench/solve.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {

/// Compares gradients of a list of scenarios with central differences at five random postures,
/// where the scenario that decides and its multipliers do not change between them.
inline void expect_gradients(const Problem& task, const Options& options, Random& random) {
  constexpr double kChange = 1e-6;
  int compared = 0;
  for (int i = 0; compared < 5; ++i) {
    ASSERT_LT(i, 1000);
    const Eigen::VectorXd theta_r = random_theta_r(task, random);
    const Answer answer = evaluate(task, theta_r, options);
    if (answer.status != Status::kOptimal) continue;
    const std::string decides = describe(task.scenarios, answer.capability.decides);
    Eigen::VectorXd difference(theta_r.size());
    bool smooth = true;
    for (Eigen::Index k = 0; k < theta_r.size(); ++k) {
      double sides[2] = {0, 0};
      for (const int side : {0, 1}) {
        Eigen::VectorXd moved = theta_r;
        moved[k] += side == 0 ? kChange : -kChange;
        const Answer there = evaluate(task, moved, options);
        smooth = smooth && there.status == Status::kOptimal &&
                 describe(task.scenarios, there.capability.decides) == decides &&
                 (there.capability.lambda - answer.capability.lambda).norm() <
                     1e-3 * (1 + answer.capability.lambda.norm());
        sides[side] = there.beta();
      }
      difference[k] = (sides[0] - sides[1]) / (2 * kChange);
    }
    if (!smooth) continue;
    ++compared;
    const Eigen::VectorXd gradient = answer.trajectory.gradient.transpose();
    EXPECT_LT((gradient - difference).norm(), 1e-5 * (1 + difference.norm()))
        << gradient.transpose() << " / " << difference.transpose();
  }
}

}  // namespace maxwrench
