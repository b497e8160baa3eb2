#include "solvers/trajectory/bordered_facets.h"

#include <gtest/gtest.h>

#include "lib/math/random.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/trajectory/makers.h"

namespace maxwrench {
namespace {

/// The program of steps of at most `radius` about a table around the default, without rates and
/// slacks.
TrajectoryProgram step_program(const Problem& problem, double radius, Random& random) {
  TrajectoryEvaluator trajectories(problem, Wrench::kPure, find_trajectory_solver("ipm").make,
                                   false);
  Eigen::MatrixXd knots = problem.theta_r_default.transpose().replicate(trajectories.knots(), 1);
  for (double& value : knots.reshaped()) value += random.uniform(-0.02, 0.02);
  EXPECT_GT(trajectories.evaluate_elastic(knots, nullptr), -kInfinity);
  TrajectoryProgram program = trajectories.linearize();
  const Eigen::Index p = knots.size();
  program.y_min.setConstant(p, -radius);
  program.y_max.setConstant(p, radius);
  program.R = trajectories.rows().R;
  const Eigen::VectorXd at = program.R * stacked(knots);
  program.r_min = (trajectories.rows().r_min - at).cwiseMin(0);
  program.r_max = (trajectories.rows().r_max - at).cwiseMax(0);
  program.rho = kInfinity;
  program.du_max.setConstant(kInfinity);
  return program;
}

class BorderedFacetsOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tasks, BorderedFacetsOf,
                         testing::Values("uvms/valve_trajectory", "uvms/jet_trajectory",
                                         "planar/trajectory"));

TEST_P(BorderedFacetsOf, AgreesWithTheInteriorPoint) {
  const Problem problem = load_problem(GetParam());
  Random random(1);
  BorderedFacets facets;
  const auto ipm = make_trajectory_ipm();
  for (const double radius : {1e-4, 0.01, 0.1, 0.4}) {
    for (int sample = 0; sample < 3; ++sample) {
      const TrajectoryProgram program = step_program(problem, radius, random);
      ASSERT_TRUE(BorderedFacets::suits(program));
      TrajectorySolution mine, reference;
      ASSERT_TRUE(facets.solve(program, mine)) << radius;
      ipm->solve(program, reference);
      ASSERT_EQ(reference.status, Status::kOptimal) << radius;
      const double scale = 1 + std::abs(reference.value);
      EXPECT_NEAR(mine.value, reference.value, 1e-8 * scale) << radius;
      // y keeps its limits, and with the other method's efforts for it the value is the same.
      EXPECT_LE((mine.y.array() - program.y_max.array()).maxCoeff(), 1e-9);
      EXPECT_LE((program.y_min.array() - mine.y.array()).maxCoeff(), 1e-9);
      EXPECT_LE((program.R * mine.y - program.r_max).maxCoeff(), 1e-8);
      EXPECT_LE((program.r_min - program.R * mine.y).maxCoeff(), 1e-8);
      TrajectoryProgram there = program;
      there.y_min = there.y_max = mine.y;
      TrajectorySolution efforts;
      ipm->solve(there, efforts);
      EXPECT_NEAR(efforts.value, mine.value, 1e-7 * scale) << radius;
      // The multipliers prove the value: with them `recheck` finds no gap.
      efforts.lambda = mine.lambda;
      efforts.pi = mine.pi;
      efforts.nu = mine.nu;
      efforts.mu.setZero();
      const Residual residual = recheck(program, efforts);
      EXPECT_LE(residual.gap, 1e-6 * scale) << radius;
      EXPECT_LE(residual.dual, 1e-8) << radius;
    }
  }
}

TEST(BorderedFacets, SuitsWhatIsDecidedByFacetsAlone) {
  const Problem problem = load_problem("planar/trajectory");
  Random random(2);
  TrajectoryProgram program = step_program(problem, 0.1, random);
  EXPECT_TRUE(BorderedFacets::suits(program));
  TrajectoryProgram impulse = program;
  impulse.peak = 1;
  EXPECT_FALSE(BorderedFacets::suits(impulse));
  TrajectoryProgram limited = program;
  limited.instants[1].w_max.setConstant(1);
  EXPECT_FALSE(BorderedFacets::suits(limited));
  program.y_min.resize(0);
  program.y_max.resize(0);
  EXPECT_FALSE(BorderedFacets::suits(program));
}

}  // namespace
}  // namespace maxwrench
