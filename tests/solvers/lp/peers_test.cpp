#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "lib/math/random.h"
#include "maxwrench/mps.h"
#include "maxwrench/strategies.h"
#include "solvers/lp/elastic.h"
#include "solvers/lp/makers.h"
#include "tests/support/netlib.h"
#include "tests/support/programs.h"
#include "tests/support/support.h"

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

TEST_P(EveryLpSolver, MultiplierIsTheDerivativeByTheRightHandSide) {
  LpSolution solution;
  GetParam().make()->solve(small_program(), solution);
  ASSERT_EQ(solution.status, Status::kOptimal) << solution.reason.c_str();
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
    EXPECT_STREQ(to_string(solution.status), to_string(status)) << solution.reason.c_str();
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
    ASSERT_EQ(kept.status, Status::kOptimal) << kept.reason.c_str();
    ASSERT_EQ(fresh.status, Status::kOptimal) << fresh.reason.c_str();
    EXPECT_NEAR(kept.objective, fresh.objective, 1e-9 * (1 + std::abs(fresh.objective)));
    EXPECT_TRUE(verified(program, kept, 1e-9));
  }
}

TEST(KeptModels, GiveTheAnswersOfFreshOnes) {
  // The pattern stays in some, changes in others; so does the basis that is handed in.
  using Make = std::unique_ptr<LpSolver> (*)();
  for (const auto& [kept, fresh] :
       {std::pair<Make, Make>(make_clp_keeping_its_model, make_clp),
        std::pair<Make, Make>(make_glpk_keeping_its_model, make_glpk)}) {
    Random random(3);
    const auto solver = kept();
    LpSolution solution;
    LinearProgram program = random_program(random, 6, 14);
    for (int sample = 0; sample < 300; ++sample) {
      if (sample % 10 == 0) {
        program = random_program(random, sample % 20 == 0 ? 6 : 7, 14);
      } else {
        for (double& a : program.A.coeffs()) a *= random.uniform(0.5, 1.5);
        if (sample % 3 == 0) program.A.coeffs()[0] = 0;
        program.b = program.A * Eigen::VectorXd::Constant(14, 0.5);
        if (sample % 7 == 0) program.b[0] += 100;  // out of reach
        for (double& c : program.c) c = random.normal();
      }
      if (sample % 4 == 0) solution.basis.clear();
      solver->solve(program, solution);
      LpSolution expected;
      fresh()->solve(program, expected);
      ASSERT_EQ(solution.status, expected.status) << sample << " " << solution.reason.c_str();
      EXPECT_TRUE(verified(program, solution, 1e-9)) << sample;
      if (solution.status != Status::kOptimal) continue;
      EXPECT_NEAR(solution.objective, expected.objective,
                  1e-8 * (1 + std::abs(expected.objective)));
    }
  }
}

TEST_P(EveryLpSolver, SolvesInManyThreadsAtOnce) {
  std::vector<LinearProgram> programs;
  std::vector<double> expected;
  Random random(2);
  for (int i = 0; i < std::max(5, samples(20)); ++i) {
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

/// Programs of realistic size; how each optimum is known stands at the head of its file.
struct KnownProgram {
  const char* name;
  Status status;
  double optimum;
};
constexpr KnownProgram kKnownPrograms[] = {{"transport", Status::kOptimal, 16188},
                                           {"production", Status::kOptimal, 27092},
                                           {"assignment", Status::kOptimal, 1540},
                                           {"blending", Status::kOptimal, 3480},
                                           {"production_infeasible", Status::kInfeasible, 0},
                                           {"trading_unbounded", Status::kUnbounded, 0}};

TEST_P(EveryLpSolver, SolvesProgramsWithKnownAnswers) {
  const auto solver = GetParam().make();
  for (const KnownProgram& known : kKnownPrograms) {
    // Its points are accurate to 1e-6 only, too little for proofs of this size.
    if (interior() && known.status != Status::kOptimal) continue;
    SCOPED_TRACE(known.name);
    const MpsProgram mps =
        read_mps(std::string(MAXWRENCH_SOURCE_DIR "/tests/data/lp/") + known.name + ".mps");
    LpSolution solution;
    solver->solve(mps.program, solution);
    ASSERT_STREQ(to_string(solution.status), to_string(known.status)) << solution.reason.c_str();
    EXPECT_TRUE(verified(mps.program, solution, interior() ? 1e-6 : 1e-7));
    if (known.status != Status::kOptimal) continue;
    EXPECT_NEAR(mps.objective(solution), known.optimum, (interior() ? 1e-5 : 1e-9) * known.optimum);
  }
}

std::vector<std::string> mps_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".mps") files.push_back(entry.path().string());
  }
  return files;
}

/// Compares with the simplex; the number of files that the solver admits to have no verdict on.
int compare_on_files(LpSolver& solver, const std::string& folder) {
  int unproven = 0;
  for (const std::string& file : mps_files(folder)) {
    const MpsProgram mps = read_mps(file);
    LpSolution expected;
    LpSolution solution;
    find_lp_solver("simplex").make()->solve(mps.program, expected);
    solver.solve(mps.program, solution);
    // A library may admit that it found nothing, but not say what does not hold.
    unproven += solution.status == Status::kNumericalError;
    if (solution.status == Status::kNumericalError) continue;
    EXPECT_TRUE(verified(mps.program, solution)) << file << ": " << solution.reason.c_str();
    EXPECT_STREQ(to_string(solution.status), to_string(expected.status)) << file;
    if (solution.status != Status::kOptimal) continue;
    EXPECT_NEAR(solution.objective, expected.objective, 1e-8 * (1 + std::abs(expected.objective)))
        << file;
  }
  return unproven;
}

TEST_P(EveryLpSolver, AgreesWithSimplexOnFiles) {
  if (interior()) GTEST_SKIP() << "awkward programs are no task for an interior point";
  EXPECT_EQ(compare_on_files(*GetParam().make(), MAXWRENCH_SOURCE_DIR "/tests/data/lp"), 0);
}

TEST_P(EveryLpSolver, AgreesWithSimplexOnNetlib) {
  if (interior()) GTEST_SKIP() << "awkward programs are no task for an interior point";
  // GLPK gives up on klein1 and gas11.
  EXPECT_LE(compare_on_files(*GetParam().make(), kNetlibFolder),
            std::string_view(GetParam().name) == "glpk" ? 2 : 0);
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
