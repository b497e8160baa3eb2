#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "solvers/lp/makers.h"
#include "tests/support/programs.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Simplex, AgreesWithGlpk) {
  Random random(1);
  const auto simplex = make_simplex();
  for (int k = 0; k < samples(4000); ++k) {
    const int m = static_cast<int>(random.next() % 20),
              n = 1 + static_cast<int>(random.next() % 30);
    const LinearProgram p = random_program(random, m, n, k % 2 == 0);
    LpSolution solution;
    simplex->solve(p, solution);
    expect_verified(p, solution);
    const LpSolution peer = solve_with_glpk(p);
    EXPECT_STREQ(to_string(solution.status), to_string(peer.status)) << "program " << k;
    if (peer.status != Status::kOptimal) continue;
    EXPECT_NEAR(solution.objective, peer.objective, 1e-9 * (1 + std::abs(peer.objective))) << k;
  }
}

/// The best of all basic feasible points: every choice of m columns with a regular basis matrix,
/// every other column at one of its bounds. Exact for boxed programs with A of full row rank.
double enumerate(const LinearProgram& p) {
  const int m = p.rows(), n = p.cols();
  const Eigen::MatrixXd A = p.A;
  double best = -kInfinity;
  for (int basis = 0; basis < 1 << n; ++basis) {
    if (std::popcount(static_cast<unsigned>(basis)) != m) continue;
    Eigen::MatrixXd B(m, m);
    for (int j = 0, k = 0; j < n; ++j) {
      if (basis >> j & 1) B.col(k++) = A.col(j);
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(B);
    if (!lu.isInvertible()) continue;
    for (int side = 0; side < 1 << (n - m); ++side) {
      Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
      for (int j = 0, k = 0; j < n; ++j) {
        if (!(basis >> j & 1)) x[j] = side >> k++ & 1 ? p.u[j] : p.l[j];
      }
      const Eigen::VectorXd x_basic = lu.solve(p.b - A * x);
      for (int j = 0, k = 0; j < n; ++j) {
        if (basis >> j & 1) x[j] = x_basic[k++];
      }
      const bool feasible = ((x - p.l).array() > -1e-9).all() && ((p.u - x).array() > -1e-9).all();
      if (feasible) best = std::max(best, p.c.dot(x));
    }
  }
  return best;
}

TEST(Simplex, AgreesWithEnumerationOfBases) {
  Random random(2);
  const auto simplex = make_simplex();
  int compared = 0;
  for (int k = 0; k < samples(600); ++k) {
    const LinearProgram p = random_program(random, 1 + k % 3, 4 + k % 4, true);
    if (Eigen::FullPivLU<Eigen::MatrixXd>(Eigen::MatrixXd(p.A)).rank() < p.rows()) continue;
    LpSolution solution;
    simplex->solve(p, solution);
    expect_verified(p, solution);
    const double best = enumerate(p);
    EXPECT_EQ(solution.status, std::isfinite(best) ? Status::kOptimal : Status::kInfeasible);
    ++compared;
    if (!std::isfinite(best)) continue;
    EXPECT_NEAR(solution.objective, best, 1e-10 * (1 + std::abs(best)));
  }
  EXPECT_GT(compared, samples(200));
}

/// max x + y + z over pyramids whose apex (1, ..., 1) lies on many facets: every vertex ties.
TEST(Simplex, EndsOnHighlyDegeneratePrograms) {
  Random random(6);
  for (int k = 0; k < samples(30); ++k) {
    const int n = 20, m = 60;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(m, n + m);
    A.leftCols(n) = Eigen::MatrixXd::NullaryExpr(
        m, n, [&] { return static_cast<double>(random.next() % 3) - 1; });
    A.rightCols(m).setIdentity();
    LinearProgram p;
    p.A = A.sparseView();
    p.b.setZero(m);  // every slack is zero at the origin
    p.c = Eigen::VectorXd::NullaryExpr(n + m, [&] { return random.uniform(-1, 1); });
    p.c.tail(m).setZero();
    p.l.setZero(n + m);
    p.u.setConstant(n + m, kInfinity);
    p.u.head(n).setConstant(1);
    const LpSolution solution = solve_with_simplex(p);
    EXPECT_EQ(solution.status, Status::kOptimal);
    expect_verified(p, solution);
    EXPECT_NEAR(solution.objective, solve_with_glpk(p).objective, 1e-9);
  }
}

TEST(Simplex, SmallestShapes) {
  LinearProgram p;  // nothing at all
  p.A.resize(0, 0);
  EXPECT_EQ(solve_with_simplex(p).status, Status::kOptimal);

  p.A.resize(0, 2);  // no rows: every column goes to its better bound
  p.c = Eigen::VectorXd{{1, -1}};
  p.l = Eigen::VectorXd{{-2, -3}};
  p.u = Eigen::VectorXd{{4, 5}};
  EXPECT_EQ(solve_with_simplex(p).objective, 4 + 3);
  p.u[0] = kInfinity;
  const LpSolution ray = solve_with_simplex(p);
  EXPECT_EQ(ray.status, Status::kUnbounded);
  expect_verified(p, ray);

  LinearProgram q;  // no columns: 0 = b
  q.A.resize(1, 0);
  q.b = Eigen::VectorXd{{0}};
  EXPECT_EQ(solve_with_simplex(q).status, Status::kOptimal);
  q.b[0] = 1;
  const LpSolution contradiction = solve_with_simplex(q);
  EXPECT_EQ(contradiction.status, Status::kInfeasible);
  expect_verified(q, contradiction);
}

TEST(Simplex, MalformedProgramsAreAStatusNotACrash) {
  Random random(7);
  LinearProgram p = random_program(random, 3, 5, true);
  p.c.resize(4);
  EXPECT_EQ(solve_with_simplex(p).status, Status::kNumericalError);
  for (int k = 0; k < 5; ++k) {
    p = random_program(random, 3, 5, true);
    (k == 0   ? p.c[1]
     : k == 1 ? p.b[1]
     : k == 2 ? p.l[1]
     : k == 3 ? p.u[1]
              : p.A.coeffRef(1, 1)) = NAN;
    const LpSolution solution = solve_with_simplex(p);
    EXPECT_EQ(solution.status, Status::kNumericalError);
    EXPECT_STRNE(solution.reason.c_str(), "");
  }
}

TEST(Simplex, AnyBasisIsAcceptedAsAWarmStart) {
  Random random(8);
  const auto simplex = make_simplex();
  const VariableState states[] = {VariableState::kAtLower, VariableState::kAtUpper,
                                  VariableState::kFree, VariableState::kBasic};
  int restarts = 0;
  for (int k = 0; k < samples(2000); ++k) {
    const LinearProgram p = random_program(random, 6, 10, k % 2 == 0);
    LpSolution cold, warm;
    simplex->solve(p, cold);
    // Right number of basic variables but arbitrary, often singular; or not even the right number.
    for (int j = 0; j < 16; ++j) warm.basis.push_back(states[random.next() % (k % 3 ? 3 : 4)]);
    for (int i = 0; i < 6 && k % 3; ++i) warm.basis[(random.next() % 3 + 3 * i) % 16] = states[3];
    simplex->solve(p, warm);
    restarts += warm.cold_restarts;
    EXPECT_EQ(warm.status, cold.status);
    expect_verified(p, warm);
    if (cold.status != Status::kOptimal) continue;
    EXPECT_NEAR(warm.objective, cold.objective, 1e-9 * (1 + std::abs(cold.objective)));
  }
  EXPECT_GT(restarts, 0);
}

TEST(Simplex, SameProgramAndBasisGiveTheSameBits) {
  Random random(9);
  const auto used = make_simplex();
  for (int k = 0; k < 100; ++k) {
    const LinearProgram p = random_program(random, 10, 20, true);
    LpSolution a, b;
    used->solve(p, a);
    make_simplex()->solve(p, b);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.lambda, b.lambda);
    EXPECT_EQ(a.basis, b.basis);
  }
}

/// Rows and columns scaled by powers of ten from 1e-5 to 1e5 leave the value alone.
TEST(Simplex, BadlyScaledProgramsKeepTheirValue) {
  Random random(11);
  for (int k = 0; k < samples(300); ++k) {
    LinearProgram p = random_program(random, 8, 14, k % 2 == 0);
    const LpSolution plain = solve_with_simplex(p);
    Eigen::MatrixXd A = p.A;
    for (int i = 0; i < p.rows(); ++i) {
      const double r = std::pow(10, random.uniform(-5, 5));
      A.row(i) *= r;
      p.b[i] *= r;
    }
    for (int j = 0; j < p.cols(); ++j) {
      const double s = std::pow(10, random.uniform(-5, 5));
      A.col(j) *= s;
      p.c[j] *= s;
      p.l[j] /= s;
      p.u[j] /= s;
    }
    p.A = A.sparseView();
    const LpSolution scaled = solve_with_simplex(p);
    EXPECT_EQ(scaled.status, plain.status) << k;
    expect_verified(p, scaled);
    if (plain.status != Status::kOptimal) continue;
    EXPECT_NEAR(scaled.objective, plain.objective, 1e-8 * (1 + std::abs(plain.objective))) << k;
  }
}

}  // namespace
}  // namespace maxwrench
