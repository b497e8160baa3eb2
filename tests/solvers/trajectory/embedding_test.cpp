#include "solvers/trajectory/embedding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

constexpr double kTight = 1e-9;

TrajectorySolution trajectory_by_glpk(const TrajectoryProgram& program) {
  TrajectorySolution solution;
  find_trajectory_solver("glpk").make()->solve(program, solution);
  return solution;
}

/// All kinds: paths and impulses, pure and any wrench, elastic and not, with steps of the knots.
TrajectoryRecipe recipe_of(int sample) {
  TrajectoryRecipe recipe;
  recipe.instants = 1 + sample % 5;
  recipe.wrench = sample % 2 == 0 ? Wrench::kPure : Wrench::kAny;
  recipe.peak = sample % 3 == 0 ? recipe.instants / 2 : -1;
  recipe.rho = sample % 4 == 0 ? 100 : kInfinity;
  recipe.border = sample % 5 == 0 ? 3 : 0;
  recipe.load = sample % 7 == 0 ? 0.4 : 0.03;
  recipe.du = 0.1;
  return recipe;
}

TrajectorySolution embedded(const TrajectoryProgram& program, double tolerance = kTight) {
  TrajectorySolution solution;
  Embedding embedding;
  EXPECT_EQ(embedding.run(program, true, true, tolerance, solution), Embedding::End::kVerdict)
      << embedding.reason();
  return solution;
}

/// One embedding for programs of all shapes, one after the other, against a general solver.
TEST(Embedding, AgreesWithGlpkWhateverItHasSolvedBefore) {
  const Problem problem = load_problem("uvms/valve");
  Random random(1);
  Embedding embedding;
  int optimal = 0, infeasible = 0;
  for (int sample = 0; sample < samples(120); ++sample) {
    const TrajectoryProgram program = random_trajectory(problem, recipe_of(sample), random);
    const TrajectorySolution reference = trajectory_by_glpk(program);
    TrajectorySolution solution;
    const auto end = embedding.run(program, true, true, kTight, solution);
    ASSERT_EQ(end, Embedding::End::kVerdict) << sample << ' ' << embedding.reason();
    ASSERT_EQ(solution.status, reference.status) << sample;
    if (solution.status == Status::kInfeasible) {
      EXPECT_TRUE(proves_infeasible(program, solution)) << sample;
      ++infeasible;
      continue;
    }
    const double scale = 1 + std::abs(reference.value) + reference.price;
    EXPECT_NEAR(solution.value - solution.price, reference.value - reference.price, 1e-8 * scale);
    EXPECT_TRUE(recheck(program, solution).within(kTight * scale)) << sample;
    // What it has solved before leaves no trace.
    const TrajectorySolution fresh = embedded(program);
    EXPECT_EQ(fresh.value, solution.value);
    EXPECT_EQ(fresh.u, solution.u);
    EXPECT_EQ(fresh.lambda, solution.lambda);
    ++optimal;
  }
  EXPECT_GE(optimal, samples(60));
  EXPECT_GE(infeasible, samples(5));
}

/// Without rates it answers only if its answer keeps them: then it has the value with rates too.
/// The program without them has at least that value, as it asks for less.
TEST(Embedding, SaysWhenItNeedsTheRates) {
  const Problem problem = load_problem("uvms/valve");
  Random random(2);
  int needed = 0, kept = 0;
  for (int sample = 0; sample < samples(60); ++sample) {
    TrajectoryRecipe recipe;
    recipe.instants = 4;
    recipe.load = 0.03;
    recipe.du = sample % 2 == 0 ? 0.02 : 1.5;
    const TrajectoryProgram program = random_trajectory(problem, recipe, random);
    const TrajectorySolution reference = trajectory_by_glpk(program);
    Embedding embedding;
    TrajectorySolution solution;
    const auto end = embedding.run(program, false, true, kTight, solution);
    if (end == Embedding::End::kVerdict) {
      ASSERT_EQ(solution.status, reference.status);
      if (solution.status != Status::kOptimal) continue;
      EXPECT_NEAR(solution.value, reference.value, 1e-8 * (1 + std::abs(reference.value)));
      EXPECT_TRUE((solution.mu.array() == 0).all());
      ++kept;
      continue;
    }
    ++needed;
    TrajectoryProgram unbound = program;
    unbound.du_max.setConstant(kInfinity);
    const TrajectorySolution without = trajectory_by_glpk(unbound);
    if (without.status != Status::kOptimal || reference.status != Status::kOptimal) continue;
    EXPECT_GE(without.value, reference.value - 1e-9);
  }
  EXPECT_GE(needed, samples(10));
  EXPECT_GE(kept, samples(10));
}

/// A load that no efforts balance: without slacks the elastic program has no answer.
TEST(Embedding, SaysWhenItNeedsTheSlacks) {
  const Problem problem = load_problem("uvms/valve");
  Random random(3);
  for (int at = 0; at < 3; ++at) {
    TrajectoryRecipe recipe;
    recipe.rho = 100;
    recipe.rates = false;
    recipe.load = 0.02;
    TrajectoryProgram program = random_trajectory(problem, recipe, random);
    program.instants[static_cast<std::size_t>(at)].tau_d *= 50;
    Embedding embedding;
    TrajectorySolution solution;
    EXPECT_EQ(embedding.run(program, true, false, kTight, solution), Embedding::End::kNeedsSlacks);
    EXPECT_EQ(embedding.run(program, true, true, kTight, solution), Embedding::End::kVerdict);
    ASSERT_EQ(solution.status, Status::kOptimal);
    const TrajectorySolution reference = trajectory_by_glpk(program);
    EXPECT_NEAR(solution.value - solution.price, reference.value - reference.price,
                1e-8 * (1 + reference.price));
    EXPECT_GT(solution.s.col(at).lpNorm<1>(), 1);
  }
}

/// A looser tolerance ends sooner, at an answer that is verified to it.
TEST(Embedding, IsAsExactAsItIsAskedToBe) {
  const Problem problem = load_problem("uvms/valve");
  Random random(4);
  for (int sample = 0; sample < 10; ++sample) {
    TrajectoryRecipe recipe;
    recipe.load = 0.02;
    recipe.border = 4;
    recipe.rho = 100;
    const TrajectoryProgram program = random_trajectory(problem, recipe, random);
    const TrajectorySolution tight = embedded(program), loose = embedded(program, 1e-4);
    ASSERT_EQ(tight.status, Status::kOptimal);
    ASSERT_EQ(loose.status, Status::kOptimal);
    EXPECT_LT(loose.iterations, tight.iterations);
    const double scale = 1 + std::abs(loose.value) + loose.price;
    EXPECT_NEAR(loose.value - loose.price, tight.value - tight.price, 2e-4 * scale);
    EXPECT_TRUE(recheck(program, loose).within(1e-4 * scale));
  }
}

/// A wrench that costs no effort grows without limit, for which it has no proof.
TEST(Embedding, GivesNoVerdictWhereTheValueHasNoLimit) {
  const Problem problem = load_problem("uvms/valve");
  Random random(5);
  TrajectoryRecipe recipe;
  recipe.load = 0.01;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  for (WrenchProgram& at : program.instants) at.JtW.setZero();
  ASSERT_EQ(trajectory_by_glpk(program).status, Status::kUnbounded);
  Embedding embedding;
  TrajectorySolution solution;
  EXPECT_EQ(embedding.run(program, true, true, kTight, solution), Embedding::End::kNone);
  EXPECT_STRNE(embedding.reason(), "");
}

/// Bounds that are one number are equations: with steps y fixed, the program is that of tau_d less
/// G y, and its multipliers are those of that program.
TEST(Embedding, FixedStepsMoveTheLoad) {
  const Problem problem = load_problem("uvms/valve");
  Random random(6);
  for (int sample = 0; sample < 5; ++sample) {
    TrajectoryRecipe recipe;
    recipe.load = 0.02;
    recipe.border = 3;
    TrajectoryProgram program = random_trajectory(problem, recipe, random);
    program.R.resize(0, 3);
    program.r_min.resize(0);
    program.r_max.resize(0);
    program.y_min = program.y_max = Eigen::Vector3d(0.01, -0.02, 0.03);
    TrajectoryProgram moved = program;
    for (int i = 0; i < moved.size(); ++i) {
      moved.instants[static_cast<std::size_t>(i)].tau_d -=
          moved.G[static_cast<std::size_t>(i)] * program.y_max;
    }
    moved.G.clear();
    moved.y_min.resize(0);
    moved.y_max.resize(0);
    moved.R.resize(0, 0);
    const TrajectorySolution with = embedded(program), without = embedded(moved);
    ASSERT_EQ(with.status, without.status);
    if (with.status != Status::kOptimal) continue;
    EXPECT_NEAR(with.value, without.value, 1e-8 * (1 + std::abs(with.value)));
    EXPECT_LT((with.y - program.y_max).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace maxwrench
