#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "benchmarks/timing/slow_trajectory.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "solvers/trajectory/makers.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

namespace maxwrench {
namespace {

TrajectoryProgram any_trajectory(const Problem& problem, Random& random) {
  TrajectoryRecipe recipe;
  recipe.instants = 1 + static_cast<int>(random.uniform(0, 12));
  recipe.wrench = random.uniform() < 0.5 ? Wrench::kPure : Wrench::kAny;
  recipe.rates = random.uniform() < 0.7;
  if (random.uniform() < 0.3) recipe.peak = static_cast<int>(random.uniform(0, recipe.instants));
  if (random.uniform() < 0.2) recipe.rho = 100;
  if (random.uniform() < 0.3) recipe.border = 1 + static_cast<int>(random.uniform(0, 10));
  recipe.load = random.uniform() < 0.3 ? 0.05 : 0.6;
  TrajectoryProgram program = random_trajectory(problem, recipe, random);
  if (random.uniform() < 0.5) program.first_elastic = 1;
  return program;
}

/// How one solver compares with the interior point method.
struct TrajectoryTally {
  int optimal = 0, infeasible = 0, none = 0;
};

void compare_trajectories(const TrajectoryProgram& program, const TrajectorySolution& reference,
                          TrajectorySolver& solver, double tolerance, const std::string& name,
                          TrajectoryTally& tally) {
  TrajectorySolution solution;
  solver.solve(program, solution);
  // A library that has no verdict says so; what it says must be right.
  if (solution.status == Status::kNumericalError) ++tally.none;
  if (solution.status == Status::kNumericalError) return;
  ASSERT_EQ(solution.status, reference.status) << name << ": " << solution.reason.c_str();
  tally.optimal += solution.status == Status::kOptimal;
  tally.infeasible += solution.status == Status::kInfeasible;
  if (solution.status == Status::kInfeasible) {
    EXPECT_TRUE(proves_infeasible(program, solution)) << name;
    return;
  }
  const double value = reference.value - reference.price;
  const double size = 1 + std::abs(reference.value) + reference.price;
  EXPECT_NEAR(solution.value - solution.price, value, tolerance * size) << name;
  EXPECT_TRUE(recheck(program, solution).within(10 * tolerance * size)) << name;
}

TEST(TrajectoryAgreement, EverySolverGivesTheSameAnswerOnRandomPrograms) {
  const Problem problem = load_problem("uvms/valve");
  Random random(1);
  std::map<std::string, TrajectoryTally> tallies;
  std::map<std::string, std::unique_ptr<TrajectorySolver>> solvers;
  for (const TrajectorySolverEntry& entry : trajectory_solvers())
    solvers[entry.name] = entry.make();
  for (int sample = 0; sample < samples(400); ++sample) {
    const TrajectoryProgram program = any_trajectory(problem, random);
    TrajectorySolution reference;
    solvers["ipm"]->solve(program, reference);
    ASSERT_NE(reference.status, Status::kNumericalError) << sample;
    for (auto& [name, solver] : solvers) {
      if (name == "ipopt" && sample % 10 != 0) continue;
      if (name == "simplex" && program.size() > 6) continue;  // its factors are dense
      compare_trajectories(program, reference, *solver, name == "ipopt" ? 1e-6 : 1e-8, name,
                           tallies[name]);
    }
  }
  for (const auto& [name, tally] : tallies) {
    fmt::print("{}: {} optimal, {} infeasible, {} without a verdict\n", name, tally.optimal,
               tally.infeasible, tally.none);
    // Ipopt finds few of the proofs; of a handful of programs a share tells nothing.
    const int most = (tally.optimal + tally.infeasible) / (name == "ipopt" ? 2 : 20);
    EXPECT_LE(tally.none, std::max(most, 5)) << name;
  }
  EXPECT_EQ(tallies["ipm"].none, 0);
  EXPECT_GT(tallies["ipm"].infeasible, samples(120));
  EXPECT_GT(tallies["ipm"].optimal, samples(120));
}

TEST(TrajectoryAgreement, SLOW_OtherRobots) {
  for (const std::string& name : shipped_problems()) {
    const Problem problem = load_problem(name);
    Random random(2);
    const auto ipm = make_trajectory_ipm();
    const auto peer = find_trajectory_solver("simplex").make();
    TrajectoryTally tally;
    for (int sample = 0; sample < std::max(4, samples(20)); ++sample) {
      TrajectoryProgram program = any_trajectory(problem, random);
      if (program.size() > 4) continue;
      TrajectorySolution reference;
      ipm->solve(program, reference);
      ASSERT_NE(reference.status, Status::kNumericalError) << name << " " << sample;
      compare_trajectories(program, reference, *peer, 1e-8, name, tally);
    }
    EXPECT_LE(tally.none, 1) << name;
  }
}

TEST(TrajectoryAgreement, AWarmStartGivesTheSameAnswer) {
  const Problem problem = load_problem("uvms/valve");
  Random random(3);
  TrajectoryProgram program = slow_trajectory(problem, Wrench::kPure, 4, 5, random);
  const auto warm = find_trajectory_solver("simplex").make();
  TrajectorySolution kept;
  int cold_pivots = 0, warm_pivots = 0;
  for (int step = 0; step < 10; ++step) {
    for (WrenchProgram& at : program.instants) at.tau_d *= 1.01;
    TrajectorySolution fresh;
    warm->solve(program, kept);
    find_trajectory_solver("simplex").make()->solve(program, fresh);
    ASSERT_EQ(kept.status, Status::kOptimal);
    EXPECT_NEAR(kept.value, fresh.value, 1e-8 * (1 + std::abs(fresh.value)));
    if (step > 0) warm_pivots += kept.iterations;
    if (step > 0) cold_pivots += fresh.iterations;
  }
  EXPECT_LT(2 * warm_pivots, cold_pivots);
}

TEST(TrajectorySolvers, ATableNamesThem) {
  EXPECT_STREQ(trajectory_solvers().front().name, "facets_or_ipm");
  EXPECT_STREQ(find_trajectory_solver("simplex").name, "simplex");
  EXPECT_THROW(find_trajectory_solver("none"), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
