#include "maxwrench/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "maxwrench/batch.h"
#include "maxwrench/load.h"
#include "maxwrench/lp_solver.h"
#include "maxwrench/pareto.h"
#include "maxwrench/strategies.h"

namespace maxwrench {
namespace {

TEST(Interruption, IsThatOfThisThreadWhileItLives) {
  const std::atomic<bool> ends = true, goes_on = false;
  EXPECT_FALSE(is_interrupted());
  {
    const Interruption outer(&ends);
    EXPECT_TRUE(is_interrupted());
    EXPECT_THROW(end_if_interrupted(), Interrupted);
    {
      const Interruption inner(&goes_on);
      EXPECT_FALSE(is_interrupted());
      EXPECT_NO_THROW(end_if_interrupted());
    }
    EXPECT_TRUE(is_interrupted());
    std::thread([] { EXPECT_FALSE(is_interrupted()); }).join();
  }
  EXPECT_FALSE(is_interrupted());
}

/// The bodies that have begun end; no other one begins in a thread that sees the flag.
TEST(Interruption, EndsAParallelLoop) {
  constexpr long kMany = 1'000'000;
  for (const int threads : {1, 4}) {
    std::atomic<bool> ends = false;
    std::atomic<long> calls = 0;
    const auto loop = [&] {
      parallel_for(threads, kMany, [&](long) {
        if (++calls == 10) ends = true;
      });
    };
    {
      const Interruption interruption(&ends);
      EXPECT_THROW(loop(), Interrupted);
    }
    EXPECT_GE(calls, 10);
    EXPECT_LT(calls, kMany);
    loop();  // the flag counts no more, and the threads of the loop have forgotten it
    EXPECT_GE(calls, kMany);
  }
}

TEST(Interruption, EndsALinearProgram) {
  // max x + 2 y  subject to  x + y = 1: y = 1.
  LinearProgram program;
  program.c = Eigen::Vector2d(1, 2);
  program.A = Eigen::MatrixXd::Ones(1, 2).sparseView();
  program.b = Eigen::VectorXd::Ones(1);
  program.l = Eigen::VectorXd::Zero(2);
  program.u = Eigen::VectorXd::Constant(2, kInfinity);
  const auto solver = find_lp_solver("simplex").make();
  LpSolution solution;
  const std::atomic<bool> ends = true;
  {
    const Interruption interruption(&ends);
    EXPECT_THROW(solver->solve(program, solution), Interrupted);
  }
  solver->solve(program, solution);  // the same solver, whole
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_NEAR(solution.objective, 2, 1e-12);
}

/// No task is said to have no value because its search was interrupted.
TEST(Interruption, OfAFrontIsNoVerdict) {
  Options options;
  options.budget = 100;
  options.interrupted = [] { return true; };
  const Problem valve = load_problem("uvms/valve"), lift = load_problem("uvms/lift");
  const Front front =
      pareto({{valve, "linf_polytope", Wrench::kPure}, {lift, "linf_polytope", Wrench::kPure}}, {},
             options);
  EXPECT_EQ(front.status, Status::kBudgetExhausted);
  EXPECT_EQ(front.reason.str(), "interrupted");
}

}  // namespace
}  // namespace maxwrench
