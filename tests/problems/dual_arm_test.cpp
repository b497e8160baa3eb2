#include <gtest/gtest.h>

#include <algorithm>

#include "benchmarks/row.h"
#include "problems/loader.h"
#include "solvers/strategies.h"
#include "tests/support.h"

namespace maxwrench {
namespace {

Case pure_torque(const Problem& problem) {
  Case c;
  c.problem = problem.name;
  c.measure = "linf_polytope";
  c.search = "grid";
  c.budget = kSampleDivisor > 1 ? 500 : 5000;
  return complete(c, problem.contact_columns());
}

/// The order that the paper measured: one contact, the default one, the best one.
TEST(DualArm, WallHelpsAndABetterPlaceHelpsMore) {
  const Problem alone = load_problem("dual_arm/bar_alone");
  const Problem wall = load_problem("dual_arm/bar_wall");
  const Row one = evaluate(alone, pure_torque(alone), alone.theta_r_default);
  const Row chosen = evaluate(wall, pure_torque(wall), wall.theta_r_default);
  const Row best = solve(wall, pure_torque(wall), 1);
  ASSERT_TRUE(one.has_value() && chosen.has_value() && best.has_value());
  EXPECT_NEAR(one.capability.beta, 30.165, 1e-3);
  EXPECT_NEAR(chosen.capability.beta, 35.365, 1e-3);
  EXPECT_NEAR(best.capability.beta, 37.944, kSampleDivisor > 1 ? 0.1 : 1e-2);
  // The hand presses into the wall, or rests.
  EXPECT_GT(chosen.capability.w.tail<1>()[0], 0);
  EXPECT_GT(best.capability.w.tail<1>()[0], 0);
}

/// No place of a dense grid, judged by another solver and without gradients, is better than what
/// the search finds, and one is nearly as good.
TEST(DualArm, SearchFindsTheBestPlaceOfADenseGrid) {
  const Problem wall = load_problem("dual_arm/bar_wall");
  const Row found = solve(wall, pure_torque(wall), 1);
  ASSERT_TRUE(found.has_value());
  Case c = pure_torque(wall);
  c.lp = "simplex";
  constexpr int kPlaces = kSampleDivisor > 1 ? 11 : 61;
  double best = 0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int k = 0; k < kPlaces; ++k) {
      const Eigen::Vector2d share(i / (kPlaces - 1.0), k / (kPlaces - 1.0));
      const Eigen::VectorXd place =
          wall.theta_r_min + share.cwiseProduct(wall.theta_r_max - wall.theta_r_min);
      const Row row = evaluate(wall, c, place);
      if (row.has_value()) best = std::max(best, row.capability.beta);
    }
  }
  EXPECT_GE(found.capability.beta, best * (1 - 1e-9));
  EXPECT_GE(best, found.capability.beta * (kSampleDivisor > 1 ? 0.9 : 0.98));
}

}  // namespace
}  // namespace maxwrench
