#include "verify/lp_proof.h"

#include <gtest/gtest.h>

namespace maxwrench {
namespace {

/// One row.
LinearProgram one_row(std::vector<double> a, double b, std::vector<double> c, std::vector<double> l,
                      std::vector<double> u) {
  LinearProgram program;
  const auto n = static_cast<Eigen::Index>(a.size());
  program.A = Eigen::Map<Eigen::RowVectorXd>(a.data(), n).sparseView();
  program.b = Eigen::VectorXd::Constant(1, b);
  program.c = Eigen::Map<Eigen::VectorXd>(c.data(), n);
  program.l = Eigen::Map<Eigen::VectorXd>(l.data(), n);
  program.u = Eigen::Map<Eigen::VectorXd>(u.data(), n);
  return program;
}

/// max x + y, 3 x + 3 y = 1, 0 <= x, y <= 1: 1/3, at any x; lambda = 1/3. No double is 1/3.
LinearProgram third() { return one_row({3, 3}, 1, {1, 1}, {0, 0}, {1, 1}); }
LpProof proof_of_third() { return {Status::kOptimal, {mpq_class(1, 3), 0}, {mpq_class(1, 3)}, {}}; }

TEST(LpProof, AnOptimumThatIsNoDouble) {
  const LpProof proof = proof_of_third();
  EXPECT_EQ(reject_lp_proof(third(), proof), "");
  EXPECT_EQ(exact_objective(third(), proof.x), mpq_class(1, 3));
}

TEST(LpProof, OptimaAreRejectedForTheLeastChange) {
  const mpq_class tiny = mpq_class(1) / (mpz_class(1) << 200);
  LpProof proof = proof_of_third();
  proof.x[0] += tiny;
  EXPECT_EQ(reject_lp_proof(third(), proof), "A x = b does not hold");
  proof.x[1] -= tiny;  // balanced again, but below zero
  EXPECT_EQ(reject_lp_proof(third(), proof), "x violates a bound");
  for (const int sign : {-1, 1}) {
    proof = proof_of_third();
    proof.lambda[0] += sign * tiny;
    EXPECT_EQ(reject_lp_proof(third(), proof), "a reduced cost improves x");
  }
  proof = proof_of_third();
  proof.x.pop_back();
  EXPECT_EQ(reject_lp_proof(third(), proof), "its sizes are not those of the program");
  proof = proof_of_third();
  proof.status = Status::kBestFound;
  EXPECT_EQ(reject_lp_proof(third(), proof), "its status is not a verdict");
}

/// x + y = 3 with x, y <= 1: sup of y'A x = 2 < 3. With x, y <= 1.5 they meet.
TEST(LpProof, Contradictions) {
  const LpProof proof = {Status::kInfeasible, {}, {}, {1}};
  EXPECT_EQ(reject_lp_proof(one_row({1, 1}, 3, {0, 0}, {0, 0}, {1, 1}), proof), "");
  EXPECT_EQ(reject_lp_proof(one_row({1, 1}, 3, {0, 0}, {0, 0}, {1.5, 1.5}), proof),
            "y'A x may be y'b");
  EXPECT_EQ(reject_lp_proof(one_row({1, 1}, 3, {0, 0}, {0, 0}, {1, 1e20}), proof),
            "y'A x has no supremum");
  // Bounds that cross are a contradiction, whatever y is.
  EXPECT_EQ(reject_lp_proof(one_row({1, 1}, 3, {0, 0}, {0, 2}, {1, 1}),
                            {Status::kInfeasible, {}, {}, {0}}),
            "");
}

/// x - y = 0, both free above: r = (1, 1) improves x + y, and not -x - y.
TEST(LpProof, Rays) {
  const LpProof proof = {Status::kUnbounded, {0, 0}, {}, {1, 1}};
  const double none = kInfinity;
  EXPECT_EQ(reject_lp_proof(one_row({1, -1}, 0, {1, 1}, {0, 0}, {none, none}), proof), "");
  EXPECT_EQ(reject_lp_proof(one_row({1, -1}, 0, {-1, 1}, {0, 0}, {none, none}), proof),
            "the ray does not improve");
  EXPECT_EQ(reject_lp_proof(one_row({1, -1}, 0, {1, 1}, {0, 0}, {none, 1}), proof),
            "the ray violates a bound");
  EXPECT_EQ(reject_lp_proof(one_row({1, 1}, 0, {1, 1}, {0, 0}, {none, none}), proof),
            "A r = 0 does not hold");
  EXPECT_EQ(reject_lp_proof(one_row({1, -1}, 1, {1, 1}, {0, 0}, {none, none}), proof),
            "A x = b does not hold");
}

}  // namespace
}  // namespace maxwrench
