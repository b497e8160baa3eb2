#include "solvers/lp/simplex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/random.h"
#include "solvers/lp/glpk.h"
#include "tests/support.h"

namespace maxwrench {
namespace {

LpSolution solve(const LinearProgram& program) {
  LpSolution solution;
  make_simplex()->solve(program, solution);
  return solution;
}

void expect_verified(const LinearProgram& program, const LpSolution& solution) {
  EXPECT_TRUE(verified(program, solution)) << to_string(solution.status) << ": " << solution.reason;
}

// ------------------------------------------------------------------------------ random programs

/// Small integers, so that ties, dependent rows and degenerate vertices are frequent.
LinearProgram random_program(Random& random, int m, int n, bool bounded) {
  const auto integer = [&](int low, int high) {
    return low + static_cast<int>(random.next() % (high - low + 1));
  };
  LinearProgram p;
  Eigen::MatrixXd A(m, n);
  for (double& a : A.reshaped()) a = integer(0, 2) ? 0 : integer(-3, 3);
  for (int i = 1; i < m; ++i) {
    if (integer(0, 6) == 0) A.row(i) = A.row(integer(0, i - 1));
  }
  for (int j = 1; j < n; ++j) {
    if (integer(0, 6) == 0) A.col(j) = A.col(integer(0, j - 1));
  }
  p.A = A.sparseView();
  p.c.resize(n);
  p.l.resize(n);
  p.u.resize(n);
  Eigen::VectorXd x(n);
  for (int j = 0; j < n; ++j) {
    p.c[j] = integer(-2, 2);
    p.l[j] = integer(-3, 1);
    p.u[j] = p.l[j] + integer(0, 3);
    x[j] = integer(0, 1) ? p.l[j] : p.u[j];
    if (bounded) continue;
    if (integer(0, 2) == 0) p.l[j] = -kInfinity;
    if (integer(0, 2) == 0) p.u[j] = kInfinity;
  }
  p.b = A * x;
  if (integer(0, 3) == 0 && m > 0) p.b[integer(0, m - 1)] += integer(-2, 2);
  return p;
}

/// By GLPK, whose verdicts are verified too.
LpSolution solve_with_glpk(const LinearProgram& program) {
  LpSolution solution;
  make_glpk()->solve(program, solution);
  return solution;
}

TEST(Simplex, AgreesWithGlpk) {
  Random random(1);
  const auto simplex = make_simplex();
  for (int k = 0; k < 4000 / kSampleDivisor; ++k) {
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
    if (__builtin_popcount(static_cast<unsigned>(basis)) != m) continue;
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
  for (int k = 0; k < 600 / kSampleDivisor; ++k) {
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
  EXPECT_GT(compared, 200 / kSampleDivisor);
}

// ------------------------------------------------------------------------------ wrench programs

/// `B u - J'W w = tau_d`: six base rows driven by eight thrusters, `joints` rows driven directly,
/// `wrenches` free columns; J and tau_d move along a line.
struct Walk {
  Walk(Random& random, int joints, int wrenches)
      : rows(6 + joints), actuators(8 + joints), free(wrenches) {
    const auto matrix = [&](int m, int n, double scale) {
      return Eigen::MatrixXd(
          Eigen::MatrixXd::NullaryExpr(m, n, [&] { return scale * random.uniform(-1, 1); }));
    };
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(rows, actuators);
    B.topLeftCorner(6, 8) = matrix(6, 8, 1);
    B.bottomRightCorner(joints, joints).setIdentity();
    J = matrix(rows, free, 1);
    J_step = matrix(rows, free, 0.02);
    tau_d = matrix(rows, 1, 5);
    tau_d_step = matrix(rows, 1, 0.1);
    Eigen::MatrixXd A(rows, actuators + free);
    A << B, -J;
    program.A = A.sparseView();
    program.b = tau_d;
    program.c.setZero(actuators + free);
    program.c[actuators] = 1;
    program.l.setConstant(actuators + free, -kInfinity);
    program.u.setConstant(actuators + free, kInfinity);
    for (int i = 0; i < actuators; ++i) {
      program.l[i] = random.uniform(-40, -20);
      program.u[i] = random.uniform(30, 50);
    }
  }
  void step() {
    J += J_step;
    tau_d += tau_d_step;
    program.b = tau_d;
    for (int j = 0; j < free; ++j) {
      for (int i = 0; i < rows; ++i) program.A.coeffRef(i, actuators + j) = -J(i, j);
    }
  }

  int rows, actuators, free;
  Eigen::MatrixXd J, J_step;
  Eigen::VectorXd tau_d, tau_d_step;
  LinearProgram program;
};

TEST(Simplex, WarmWalksEqualColdSolvesWithoutAllocation) {
  Random random(3);
  const auto simplex = make_simplex(), other = make_simplex();
  int optima = 0;
  for (int k = 0; k < 200 / kSampleDivisor + 1; ++k) {
    Walk walk(random, 4, 1 + k % 6);
    LpSolution warm;
    simplex->solve(walk.program, warm);
    for (int i = 0; i < 20; ++i) {
      walk.step();
      const long before = allocation_count();
      simplex->solve(walk.program, warm);
      EXPECT_EQ(allocation_count(), before);
      LpSolution cold;
      other->solve(walk.program, cold);
      expect_verified(walk.program, warm);
      ASSERT_EQ(warm.status, cold.status);
      if (warm.status != Status::kOptimal) continue;
      ++optima;
      EXPECT_NEAR(warm.objective, cold.objective, 1e-9 * (1 + std::abs(cold.objective)));
      EXPECT_LE(residuals(walk.program, warm).row, 1e-14);
    }
  }
  EXPECT_GT(optima, 100);
}

/// With W = c the multiplier obeys lambda'(J'c) = -1 at an optimum, since w is basic and costs 1;
/// and it is the derivative of the value: a finite difference in every component of tau_d.
TEST(Simplex, MultipliersAreDerivativesOfTheValue) {
  Random random(4);
  for (int k = 0; k < 20; ++k) {
    Walk walk(random, 3, 1);
    const LpSolution solution = solve(walk.program);
    if (solution.status != Status::kOptimal) continue;
    EXPECT_NEAR(solution.lambda.dot(walk.J.col(0)), -1, 1e-12);
    for (int i = 0; i < walk.rows; ++i) {
      LinearProgram moved = walk.program;
      const double h = 1e-6;
      moved.b[i] += h;
      const double up = solve(moved).objective;
      moved.b[i] -= 2 * h;
      const double down = solve(moved).objective;
      EXPECT_NEAR((up - down) / (2 * h), solution.lambda[i], 1e-6);
    }
  }
}

/// Equal limits, duplicated thrusters, a dead thruster, and a wrench along one thruster, so that
/// facets and vertices coincide.
TEST(Simplex, DegenerateWrenchProgramsAgreeWithGlpk) {
  Random random(5);
  const auto simplex = make_simplex();
  for (int k = 0; k < 400 / kSampleDivisor; ++k) {
    Walk walk(random, 4, 1 + k % 3);
    LinearProgram& p = walk.program;
    Eigen::MatrixXd A = p.A;
    p.l.head(walk.actuators).setConstant(-1);
    p.u.head(walk.actuators).setConstant(1);
    A.leftCols(walk.actuators) = A.leftCols(walk.actuators).array().round();
    if (k % 2) A.col(1) = A.col(0);
    if (k % 3 == 0) p.l[2] = p.u[2] = 0;
    if (k % 5 == 0) A.col(walk.actuators) = -A.col(3);
    p.b.setZero();
    p.A = A.sparseView();
    LpSolution solution;
    simplex->solve(p, solution);
    expect_verified(p, solution);
    const LpSolution peer = solve_with_glpk(p);
    ASSERT_STREQ(to_string(solution.status), to_string(peer.status)) << k;
    if (peer.status != Status::kOptimal) continue;
    EXPECT_NEAR(solution.objective, peer.objective, 1e-9 * (1 + std::abs(peer.objective)));
  }
}

// ---------------------------------------------------------------------------------- behaviour

/// max x + y + z over pyramids whose apex (1, ..., 1) lies on many facets: every vertex ties.
TEST(Simplex, EndsOnHighlyDegeneratePrograms) {
  Random random(6);
  for (int k = 0; k < 30 / kSampleDivisor + 1; ++k) {
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
    const LpSolution solution = solve(p);
    EXPECT_EQ(solution.status, Status::kOptimal);
    expect_verified(p, solution);
    EXPECT_NEAR(solution.objective, solve_with_glpk(p).objective, 1e-9);
  }
}

TEST(Simplex, SmallestShapes) {
  LinearProgram p;  // nothing at all
  p.A.resize(0, 0);
  EXPECT_EQ(solve(p).status, Status::kOptimal);

  p.A.resize(0, 2);  // no rows: every column goes to its better bound
  p.c = Eigen::VectorXd{{1, -1}};
  p.l = Eigen::VectorXd{{-2, -3}};
  p.u = Eigen::VectorXd{{4, 5}};
  EXPECT_EQ(solve(p).objective, 4 + 3);
  p.u[0] = kInfinity;
  const LpSolution ray = solve(p);
  EXPECT_EQ(ray.status, Status::kUnbounded);
  expect_verified(p, ray);

  LinearProgram q;  // no columns: 0 = b
  q.A.resize(1, 0);
  q.b = Eigen::VectorXd{{0}};
  EXPECT_EQ(solve(q).status, Status::kOptimal);
  q.b[0] = 1;
  const LpSolution contradiction = solve(q);
  EXPECT_EQ(contradiction.status, Status::kInfeasible);
  expect_verified(q, contradiction);
}

TEST(Simplex, MalformedProgramsAreAStatusNotACrash) {
  Random random(7);
  LinearProgram p = random_program(random, 3, 5, true);
  p.c.resize(4);
  EXPECT_EQ(solve(p).status, Status::kNumericalError);
  for (int k = 0; k < 5; ++k) {
    p = random_program(random, 3, 5, true);
    (k == 0   ? p.c[1]
     : k == 1 ? p.b[1]
     : k == 2 ? p.l[1]
     : k == 3 ? p.u[1]
              : p.A.coeffRef(1, 1)) = NAN;
    const LpSolution solution = solve(p);
    EXPECT_EQ(solution.status, Status::kNumericalError);
    EXPECT_STRNE(solution.reason, "");
  }
}

TEST(Simplex, AnyBasisIsAcceptedAsAWarmStart) {
  Random random(8);
  const auto simplex = make_simplex();
  const VariableState states[] = {VariableState::kAtLower, VariableState::kAtUpper,
                                  VariableState::kFree, VariableState::kBasic};
  int restarts = 0;
  for (int k = 0; k < 2000 / kSampleDivisor; ++k) {
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

TEST(Simplex, IterationLimitEnds) {
  Random random(10);
  SimplexOptions options;
  options.max_iterations = 2;
  Walk walk(random, 4, 3);
  LpSolution solution;
  make_simplex(options)->solve(walk.program, solution);
  EXPECT_EQ(solution.status, Status::kBudgetExhausted);
  EXPECT_EQ(solution.iterations, 2);
}

/// Rows and columns scaled by powers of ten from 1e-5 to 1e5 leave the value alone.
TEST(Simplex, BadlyScaledProgramsKeepTheirValue) {
  Random random(11);
  for (int k = 0; k < 300 / kSampleDivisor; ++k) {
    LinearProgram p = random_program(random, 8, 14, k % 2 == 0);
    const LpSolution plain = solve(p);
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
    const LpSolution scaled = solve(p);
    EXPECT_EQ(scaled.status, plain.status) << k;
    expect_verified(p, scaled);
    if (plain.status != Status::kOptimal) continue;
    EXPECT_NEAR(scaled.objective, plain.objective, 1e-8 * (1 + std::abs(plain.objective))) << k;
  }
}

}  // namespace
}  // namespace maxwrench
