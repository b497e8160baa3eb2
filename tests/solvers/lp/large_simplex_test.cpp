// Programs of so many rows and so few entries that the simplex takes sparse factors.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "solvers/lp/makers.h"
#include "solvers/lp/simplex/model.h"
#include "tests/support/programs.h"

namespace maxwrench {
namespace {

constexpr int kRows = simplex::kSparseRows + 40, kCols = 2 * kRows;

/// A program with an optimum by construction: x is at a bound or inside, and c = A'y + d with a d
/// whose signs fit x. The rows of a column are near each other, so that the factors stay sparse.
struct Constructed {
  LinearProgram program;
  double optimum = 0;
};

Constructed construct(Random& random, bool integer) {
  const auto number = [&] {
    return integer ? static_cast<double>(random.next() % 5) - 2 : random.normal();
  };
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < kCols; ++j) {
    for (int k = 0; k < 4; ++k) {
      entries.emplace_back((j / 2 + static_cast<int>(random.next() % 30)) % kRows, j, number());
    }
  }
  LinearProgram p;
  p.A.resize(kRows, kCols);
  p.A.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd x(kCols), y(kRows), d(kCols);
  for (double& v : y) v = number();
  p.l.resize(kCols);
  p.u.resize(kCols);
  for (int j = 0; j < kCols; ++j) {
    const int kind = static_cast<int>(random.next() % 10);
    x[j] = number();
    p.l[j] = kind == 0 || kind == 1 ? -kInfinity : x[j];
    p.u[j] = kind == 0 || kind > 4 ? kInfinity : kind == 1 ? x[j] : x[j] + 2;
    // Free columns, columns with one bound, boxed columns at either bound or inside.
    d[j] = kind == 0 ? 0 : (kind == 1 ? 1 : -1) * std::abs(number());
    if (kind == 2) p.l[j] -= 2, p.u[j] -= 2, d[j] *= -1;
    if (kind == 3) p.l[j] -= 1, d[j] = 0;
  }
  p.b = p.A * x;
  p.c = p.A.transpose() * y + d;
  return {p, p.c.dot(x)};
}

TEST(LargeSimplex, OptimaByConstruction) {
  Random random(51);
  const auto simplex = make_simplex(), clp = make_clp();
  for (const bool integer : {false, true}) {
    auto [program, optimum] = construct(random, integer);
    LpSolution solution, peer;
    simplex->solve(program, solution);
    EXPECT_EQ(solution.status, Status::kOptimal);
    expect_verified(program, solution);
    EXPECT_NEAR(solution.objective, optimum, 1e-8 * (1 + std::abs(optimum)));
    // From its own basis: no pivot.
    simplex->solve(program, solution);
    EXPECT_EQ(solution.iterations, 0);
    // From this basis to the optimum for other right-hand sides and bounds.
    Eigen::VectorXd shift(kCols);
    for (double& v : shift) v = 0.1 * random.uniform();
    program.b += program.A * shift;
    program.u.array() += 0.1;
    simplex->solve(program, solution);
    EXPECT_EQ(solution.status, Status::kOptimal);
    expect_verified(program, solution);
    clp->solve(program, peer);
    EXPECT_EQ(solution.status, peer.status);
    EXPECT_NEAR(solution.objective, peer.objective, 1e-6 * (1 + std::abs(peer.objective)));
  }
}

/// max c'x  subject to  D x + s = b, x and s not negative, where half of D and more than a tenth of
/// all entries are not zero.
LinearProgram dense_program(Random& random) {
  const int columns = kRows / 3;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < columns; ++j) {
    for (int i = j % 2; i < kRows; i += 2) entries.emplace_back(i, j, random.uniform(0.1, 1));
  }
  for (int i = 0; i < kRows; ++i) entries.emplace_back(i, columns + i, 1);
  LinearProgram p;
  p.A.resize(kRows, columns + kRows);
  p.A.setFromTriplets(entries.begin(), entries.end());
  p.b = Eigen::VectorXd::NullaryExpr(kRows, [&] { return random.uniform(50, 100); });
  p.c.setZero(columns + kRows);
  for (double& c : p.c.head(columns)) c = random.uniform(0.5, 2);
  p.l.setZero(columns + kRows);
  p.u.setConstant(columns + kRows, kInfinity);
  return p;
}

/// One object takes dense factors for a program of as many rows but more entries, and sparse ones
/// again.
TEST(LargeSimplex, DenseBetweenSparse) {
  Random random(55);
  const auto simplex = make_simplex();
  const auto [program, optimum] = construct(random, false);
  const LinearProgram dense = dense_program(random);
  ASSERT_GT(static_cast<double>(dense.A.nonZeros()),
            simplex::kSparseDensity * kRows * dense.cols());
  LpSolution solution, between, again;
  simplex->solve(program, solution);
  simplex->solve(dense, between);
  simplex->solve(program, again);
  expect_verified(dense, between);
  EXPECT_NEAR(between.objective, solve_with_glpk(dense).objective, 1e-7 * between.objective);
  expect_verified(program, again);
  EXPECT_NEAR(again.objective, optimum, 1e-8 * (1 + std::abs(optimum)));
  EXPECT_EQ(again.x, solution.x);  // bit for bit
}

/// An assignment of workers to tasks, each worker with 4 possible tasks: every basis is degenerate.
LinearProgram assignment(Random& random) {
  const int workers = kRows / 2, choices = 4;
  std::vector<Eigen::Triplet<double>> entries;
  LinearProgram p;
  const int columns = workers * choices;
  p.c.resize(columns);
  for (int j = 0; j < columns; ++j) {
    const int worker = j % workers;
    const int task = (worker + (j < workers ? 7 : static_cast<int>(random.next() % 30))) % workers;
    entries.emplace_back(worker, j, 1);
    entries.emplace_back(workers + task, j, 1);
    p.c[j] = -1 - static_cast<double>(random.next() % 20);
  }
  p.A.resize(2 * workers, columns);
  p.A.setFromTriplets(entries.begin(), entries.end());
  p.b.setOnes(2 * workers);
  p.l.setZero(columns);
  p.u.setConstant(columns, kInfinity);
  return p;
}

TEST(LargeSimplex, DegenerateAssignments) {
  Random random(52);
  for (int k = 0; k < 2; ++k) {
    LinearProgram p = assignment(random);
    const LpSolution least = solve_with_simplex(p);
    EXPECT_EQ(least.status, Status::kOptimal);
    expect_verified(p, least);
    EXPECT_NEAR(least.objective, solve_with_glpk(p).objective, 1e-7);
    EXPECT_NEAR(least.objective, std::round(least.objective), 1e-7);
    p.c *= -1;  // the reduced costs of the first basis have the wrong sign
    const LpSolution most = solve_with_simplex(p);
    expect_verified(p, most);
    EXPECT_NEAR(most.objective, solve_with_glpk(p).objective, 1e-7);
    EXPECT_GE(most.objective, -least.objective);
  }
}

TEST(LargeSimplex, InfeasibleAndUnboundedWithProof) {
  Random random(53);
  for (int k = 0; k < 3; ++k) {
    // One worker too few for the tasks.
    LinearProgram p = assignment(random);
    p.b[static_cast<int>(random.next() % (kRows / 2))] = 0;
    const LpSolution none = solve_with_simplex(p);
    EXPECT_EQ(none.status, Status::kInfeasible);
    expect_verified(p, none);
    // Negative amounts let more of one choice and less of others go round without end.
    LinearProgram free = assignment(random);
    free.l.setConstant(-kInfinity);
    const LpSolution ray = solve_with_simplex(free);
    EXPECT_EQ(ray.status, Status::kUnbounded);
    expect_verified(free, ray);
  }
}

TEST(LargeSimplex, DataThatAreNotFinite) {
  Random random(54);
  const LinearProgram program = construct(random, false).program;
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    LinearProgram p = program;
    p.A.valuePtr()[100] = bad;
    EXPECT_EQ(solve_with_simplex(p).status, Status::kNumericalError) << bad;
    p = program;
    p.b[kRows / 2] = bad;
    EXPECT_EQ(solve_with_simplex(p).status, Status::kNumericalError) << bad;
    p = program;
    p.c[kCols / 2] = bad;
    EXPECT_EQ(solve_with_simplex(p).status, Status::kNumericalError) << bad;
  }
  LinearProgram p = program;
  p.l[3] = std::nan("");
  EXPECT_EQ(solve_with_simplex(p).status, Status::kNumericalError);
}

}  // namespace
}  // namespace maxwrench
