#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "lib/random.h"
#include "problems/mps.h"
#include "solvers/lp/elastic.h"
#include "solvers/strategies.h"

namespace maxwrench {
namespace {

class EveryLpSolver : public testing::TestWithParam<LpEntry> {
 protected:
  bool interior() const { return std::string_view(GetParam().name) == "ipopt"; }
  double tolerance() const { return interior() ? 1e-6 : 1e-10; }
};

INSTANTIATE_TEST_SUITE_P(Table, EveryLpSolver,
                         testing::ValuesIn(lp_solvers().begin(), lp_solvers().end()),
                         [](const auto& entry) { return std::string(entry.param.name); });

/// max x + 2 y  subject to  x + y + s = 4, 0 <= x <= 3, 0 <= y <= 2, s >= 0: y = 2, x = 2, value 6.
/// More of b goes into x, so lambda = 1.
LinearProgram small_program() {
  LinearProgram p;
  p.A = Eigen::RowVector3d(1, 1, 1).sparseView();
  p.b = Eigen::VectorXd::Constant(1, 4);
  p.c = Eigen::Vector3d(1, 2, 0);
  p.l = Eigen::Vector3d::Zero();
  p.u = Eigen::Vector3d(3, 2, kInfinity);
  return p;
}

TEST_P(EveryLpSolver, MultiplierIsTheDerivativeByTheRightHandSide) {
  LpSolution solution;
  GetParam().make()->solve(small_program(), solution);
  ASSERT_EQ(solution.status, Status::kOptimal) << solution.reason;
  EXPECT_NEAR(solution.objective, 6, 10 * tolerance());
  EXPECT_NEAR(solution.lambda[0], 1, 10 * tolerance());
}

TEST_P(EveryLpSolver, VerdictsComeWithProofs) {
  // x + y + s reaches no less than 0.
  LinearProgram infeasible = small_program();
  infeasible.b[0] = -1;
  // s, free below, makes up for any y.
  LinearProgram unbounded = small_program();
  unbounded.l[2] = -kInfinity;
  unbounded.u[1] = kInfinity;
  LinearProgram crossing = small_program();
  crossing.l[0] = 5;
  const auto solver = GetParam().make();
  for (const auto& [program, status] :
       {std::pair(infeasible, Status::kInfeasible), std::pair(unbounded, Status::kUnbounded),
        std::pair(crossing, Status::kInfeasible)}) {
    if (interior() && status == Status::kUnbounded) continue;  // accurate to 1e-6 only
    LpSolution solution;
    solver->solve(program, solution);
    EXPECT_STREQ(to_string(solution.status), to_string(status)) << solution.reason;
    EXPECT_TRUE(verified(program, solution));
  }
}

TEST_P(EveryLpSolver, MalformedProgramsHaveNoVerdict) {
  LinearProgram program = small_program();
  program.c[1] = NAN;
  LpSolution solution;
  GetParam().make()->solve(program, solution);
  EXPECT_EQ(solution.status, Status::kNumericalError);
  program = small_program();
  program.b.resize(2);
  GetParam().make()->solve(program, solution);
  EXPECT_EQ(solution.status, Status::kNumericalError);
}

/// A program with 0 < x_0 < u feasible by construction.
LinearProgram random_program(Random& random, int rows, int cols) {
  LinearProgram p;
  Eigen::MatrixXd A(rows, cols);
  for (double& a : A.reshaped()) a = random.uniform() < 0.5 ? random.normal() : 0;
  Eigen::VectorXd x(cols);
  p.c.resize(cols);
  p.l.setZero(cols);
  p.u.resize(cols);
  for (int j = 0; j < cols; ++j) {
    p.u[j] = random.uniform(1, 2);
    x[j] = random.uniform(0, 1);
    p.c[j] = random.normal();
  }
  p.A = A.sparseView();
  p.b = A * x;
  return p;
}

TEST_P(EveryLpSolver, WarmStartsAfterAnyChangeGiveTheColdAnswer) {
  if (interior()) GTEST_SKIP() << "knows no basis";
  Random random(1);
  const auto warm = GetParam().make();
  const auto cold = GetParam().make();
  LpSolution kept;
  for (int sample = 0; sample < 200; ++sample) {
    const LinearProgram program = random_program(random, 6, 14);
    LpSolution fresh;
    warm->solve(program, kept);
    cold->solve(program, fresh);
    ASSERT_EQ(kept.status, Status::kOptimal) << kept.reason;
    ASSERT_EQ(fresh.status, Status::kOptimal) << fresh.reason;
    EXPECT_NEAR(kept.objective, fresh.objective, 1e-9 * (1 + std::abs(fresh.objective)));
    EXPECT_TRUE(verified(program, kept, 1e-9));
  }
}

TEST_P(EveryLpSolver, SolvesInManyThreadsAtOnce) {
  std::vector<LinearProgram> programs;
  std::vector<double> expected;
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    programs.push_back(random_program(random, 5, 10));
    LpSolution solution;
    GetParam().make()->solve(programs.back(), solution);
    expected.push_back(solution.objective);
  }
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      const auto solver = GetParam().make();
      for (std::size_t i = 0; i < programs.size(); ++i) {
        LpSolution solution;
        solver->solve(programs[i], solution);
        EXPECT_EQ(solution.objective, expected[i]);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

/// Every file below `folder`; the suites of public files may be absent.
std::vector<std::string> mps_files(const std::string& folder) {
  std::vector<std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".mps") files.push_back(entry.path().string());
  }
  return files;
}

TEST_P(EveryLpSolver, AgreesWithSimplexOnFiles) {
  if (interior()) GTEST_SKIP() << "awkward programs are no task for an interior point";
  std::vector<std::string> files = mps_files(MAXWRENCH_SOURCE_DIR "/tests/data/lp");
  for (const std::string& file : mps_files(MAXWRENCH_NETLIB_DIR)) files.push_back(file);
  int unproven = 0;
  for (const std::string& file : files) {
    const MpsProgram mps = read_mps(file);
    LpSolution expected;
    LpSolution solution;
    find_lp_solver("simplex").make()->solve(mps.program, expected);
    GetParam().make()->solve(mps.program, solution);
    // A library may admit that it found nothing, but not say what does not hold.
    unproven += solution.status == Status::kNumericalError;
    if (solution.status == Status::kNumericalError) continue;
    EXPECT_TRUE(verified(mps.program, solution)) << file << ": " << solution.reason;
    EXPECT_STREQ(to_string(solution.status), to_string(expected.status)) << file;
    if (solution.status != Status::kOptimal) continue;
    EXPECT_NEAR(solution.objective, expected.objective, 1e-8 * (1 + std::abs(expected.objective)))
        << file;
  }
  // GLPK gives up on klein1 and gas11.
  EXPECT_LE(unproven, std::string_view(GetParam().name) == "glpk" ? 2 : 0);
}

TEST(Elastic, OptimumIsTheLeastViolation) {
  // x + y + s >= 0 misses b = -1 by 1.
  LinearProgram program = small_program();
  program.b[0] = -1;
  LpSolution solution;
  find_lp_solver("simplex").make()->solve(elastic(program), solution);
  EXPECT_NEAR(solution.objective, -1, 1e-12);
}

}  // namespace
}  // namespace maxwrench
