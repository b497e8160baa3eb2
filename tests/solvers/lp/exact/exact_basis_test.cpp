#include "solvers/lp/exact/exact_basis.h"

#include <gtest/gtest.h>

#include "maxwrench/strategies.h"
#include "tests/support/programs.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// The verdict of Clp, which shares no code with the exact one, on random programs with ties,
/// dependent rows and degenerate vertices; with the basis that our simplex ends with, and with
/// none.
TEST(ExactBasis, VerdictsAreThoseOfAPeer) {
  Random random(71);
  const auto simplex = find_lp_solver("simplex").make(), clp = find_lp_solver("clp").make();
  std::map<Status, int> seen;
  for (int sample = 0; sample < samples(300); ++sample) {
    const int m = 1 + sample % 6;
    const LinearProgram program = random_program(random, m, m + sample % 5, sample % 2 == 0);
    LpSolution peer, ours;
    clp->solve(program, peer);
    simplex->solve(program, ours);
    for (const LpSolution& start : {ours, LpSolution()}) {
      const LpProof proof = exact_proof(program, start);
      EXPECT_EQ(reject_lp_proof(program, proof), "") << sample;
      EXPECT_EQ(proof.status, peer.status) << sample;
      if (proof.status != Status::kOptimal) continue;
      const double value = exact_objective(program, proof.x).get_d();
      EXPECT_NEAR(value, peer.objective, 1e-9 * (1 + std::abs(value)));
    }
    ++seen[peer.status];
  }
  for (const Status status : {Status::kOptimal, Status::kInfeasible, Status::kUnbounded}) {
    EXPECT_GT(seen[status], 0) << to_string(status);
  }
}

/// max x, 0.1 x + 0.2 y = 0.3, y >= 1: in decimals x = 1, in doubles 0.3 is less than 0.1 + 0.2.
TEST(ExactBasis, ProvesTheProgramOfDoubles) {
  LinearProgram program;
  program.A = Eigen::RowVector2d(0.1, 0.2).sparseView();
  program.b = Eigen::VectorXd::Constant(1, 0.3);
  program.c = Eigen::Vector2d(1, 0);
  program.l = Eigen::Vector2d(0, 1);
  program.u = Eigen::Vector2d(kInfinity, kInfinity);
  const LpProof proof = exact_proof(program, {});
  ASSERT_EQ(proof.status, Status::kOptimal);
  EXPECT_EQ(reject_lp_proof(program, proof), "");
  EXPECT_EQ(proof.x[0], (mpq_class(0.3) - mpq_class(0.2)) / mpq_class(0.1));
  EXPECT_LT(proof.x[0], 1);
}

/// Two columns that are the same make no basis: it is begun anew. max x + 2 y + z, x + y + z = 2,
/// 2 x + 2 y - z = 1, so z = 1 and x + y = 1, best y = 1: the objective is 3.
TEST(ExactBasis, SingularStartsAreGivenUp) {
  LinearProgram program;
  program.A = (Eigen::MatrixXd(2, 3) << 1, 1, 1, 2, 2, -1).finished().sparseView();
  program.b = Eigen::Vector2d(2, 1);
  program.c = Eigen::Vector3d(1, 2, 1);
  program.l.setZero(3);
  program.u.setConstant(3, kInfinity);
  LpSolution start;
  using enum VariableState;
  start.basis = {kBasic, kBasic, kAtLower, kAtLower, kAtLower};
  const LpProof proof = exact_proof(program, start);
  ASSERT_EQ(proof.status, Status::kOptimal);
  EXPECT_EQ(reject_lp_proof(program, proof), "");
  EXPECT_EQ(exact_objective(program, proof.x), 3);
}

TEST(ExactBasis, LargeProgramsAreRejected) {
  LinearProgram program;
  const int rows = kMostExactRows + 1;
  program.A.resize(rows, 1);
  program.b.setZero(rows);
  program.c.setZero(1);
  program.l.setZero(1);
  program.u.setZero(1);
  EXPECT_THROW(exact_proof(program, {}), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
