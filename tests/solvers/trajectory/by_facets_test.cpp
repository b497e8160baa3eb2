#include "solvers/trajectory/by_facets.h"

#include <gtest/gtest.h>

#include <functional>

#include "maxwrench/load.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

/// One change each that ends it: facets then say nothing, or not all.
TEST(BoundedByFacets, OneFreeColumnAtEveryInstant) {
  const Problem problem = load_problem("uvms/valve");
  Zonotope many = problem.robot.actuation;
  many.has_facets = false;
  Random random(1);
  const TrajectoryProgram program = random_trajectory(problem, {}, random);
  ASSERT_TRUE(bounded_by_facets(program));
  const std::function<void(TrajectoryProgram&)> changes[] = {
      [](TrajectoryProgram& p) { p.peak = 0; },
      [](TrajectoryProgram& p) { p.instants[2].w_max[0] = 1e9; },
      [](TrajectoryProgram& p) { p.instants[0].w_min[0] = -1e9; },
      [](TrajectoryProgram& p) { p.instants[1].c_w[0] = 0; },
      [](TrajectoryProgram& p) { p.instants[1].c_w[0] = -1; },
      [](TrajectoryProgram& p) { p.first_min[0] += 1; },
      [](TrajectoryProgram& p) { p.first_max[3] -= 1; },
      [&](TrajectoryProgram& p) { p.instants[0].actuation = &many; },
  };
  for (const auto& change : changes) {
    TrajectoryProgram other = program;
    change(other);
    EXPECT_FALSE(bounded_by_facets(other)) << &change - changes;
  }
  const TrajectoryProgram any = random_trajectory(problem, {.wrench = Wrench::kAny}, random);
  EXPECT_FALSE(bounded_by_facets(any));
}

TEST(BoundedByFacets, RatesSlacksAndStepsDoNotCount) {
  const Problem problem = load_problem("uvms/valve");
  Random random(2);
  EXPECT_TRUE(bounded_by_facets(random_trajectory(problem, {.rates = false}, random)));
  EXPECT_TRUE(bounded_by_facets(random_trajectory(problem, {.rho = 100}, random)));
  EXPECT_TRUE(bounded_by_facets(random_trajectory(problem, {.border = 3}, random)));
}

}  // namespace
}  // namespace maxwrench
