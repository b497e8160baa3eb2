#include "solvers/certify/bound/multiplier_program.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/linear_program.h"
#include "maxwrench/lp_solver.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Numbers of a random program.
struct Numbers {
  Eigen::MatrixXd B, P;  ///< n×m, n×N
  Eigen::VectorXd x_min, x_max, c;

  Numbers(Eigen::Index n, Eigen::Index m, Eigen::Index N, Random& random)
      : B(n, m), P(n, N), x_min(m), x_max(m), c(N) {
    for (double& x : B.reshaped()) x = random.uniform(-1, 1);
    for (double& x : P.reshaped()) x = random.uniform(-1, 1);
    for (double& x : c) x = random.uniform(1, 3);
    for (double& x : x_min) x = random.uniform(-2, -0.5);
    for (double& x : x_max) x = random.uniform(0.5, 1);
  }

  /// U(lambda), by its definition.
  double U(const Eigen::VectorXd& lambda) const {
    double sum = (c - P.transpose() * lambda).maxCoeff();
    const Eigen::VectorXd slope = B.transpose() * lambda;
    for (Eigen::Index k = 0; k < slope.size(); ++k) {
      sum += std::max(slope[k] * x_min[k], slope[k] * x_max[k]);
    }
    return sum;
  }

  /// The dual program by a general solver: max c'mu, P mu = B x, sum mu = 1.
  LpSolution by_simplex() const {
    const Eigen::Index n = B.rows(), m = B.cols(), N = P.cols();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 1, m + N);
    A.topLeftCorner(n, m) = -B;
    A.topRightCorner(n, N) = P;
    A.bottomRightCorner(1, N).setOnes();
    LinearProgram lp;
    lp.A = A.sparseView();
    lp.b = Eigen::VectorXd::Unit(n + 1, n);
    lp.c = Eigen::VectorXd::Zero(m + N);
    lp.c.tail(N) = c;
    lp.l = Eigen::VectorXd::Zero(m + N);
    lp.l.head(m) = x_min;
    lp.u = Eigen::VectorXd::Constant(m + N, kInfinity);
    lp.u.head(m) = x_max;
    LpSolution solution;
    find_lp_solver("simplex").make()->solve(lp, solution);
    return solution;
  }

  void fill(MultiplierProgram& program) const {
    program.set_points(P.cols());
    for (Eigen::Index j = 0; j < P.rows(); ++j) program.row(j) = P.row(j).transpose();
    program.costs() = c;
  }
};

constexpr int kManySteps = 500;

/// Strong duality: the least U is the optimum of the dual program.
TEST(MultiplierProgram, FindsTheLeastU) {
  Random random(1);
  for (int sample = 0; sample < 100; ++sample) {
    const Numbers numbers(1 + sample % 11, 12, 60, random);
    const LpSolution expected = numbers.by_simplex();
    ASSERT_EQ(expected.status, Status::kOptimal);
    MultiplierProgram program(numbers.B, numbers.x_min, numbers.x_max, 60);
    numbers.fill(program);
    std::vector<int> basis;
    Eigen::VectorXd lambda;
    const double said = program.solve(-kInfinity, kManySteps, basis, lambda);
    EXPECT_NEAR(numbers.U(lambda), expected.objective, 1e-9);
    EXPECT_NEAR(said, expected.objective, 1e-9);
  }
}

/// The basis of a program that differs by a little leads to the same, and one that does not belong
/// to it does no harm.
TEST(MultiplierProgram, StartsAnywhere) {
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    Numbers numbers(8, 12, 60, random);
    MultiplierProgram program(numbers.B, numbers.x_min, numbers.x_max, 60);
    std::vector<int> basis;
    Eigen::VectorXd lambda;
    for (int change = 0; change < 5; ++change) {
      numbers.fill(program);
      program.solve(-kInfinity, kManySteps, basis, lambda);
      EXPECT_NEAR(numbers.U(lambda), numbers.by_simplex().objective, 1e-9);
      for (double& x : numbers.P.reshaped()) x += random.uniform(-0.05, 0.05);
      if (change == 2) basis.assign(basis.size(), 3);  // singular
      if (change == 3) basis = {1, 2};
    }
  }
}

/// Points that no x balances: U has no least value, and falls below what is asked for.
TEST(MultiplierProgram, FallsForEver) {
  Random random(3);
  Numbers numbers(4, 6, 30, random);
  numbers.P.row(0).array() += 100;
  EXPECT_EQ(numbers.by_simplex().status, Status::kInfeasible);
  MultiplierProgram program(numbers.B, numbers.x_min, numbers.x_max, 30);
  numbers.fill(program);
  std::vector<int> basis;
  Eigen::VectorXd lambda;
  program.solve(-50, kManySteps, basis, lambda);
  EXPECT_LE(numbers.U(lambda), -50);
}

TEST(MultiplierProgram, StopsWhereItIsEnough) {
  Random random(4);
  int early = 0;
  for (int sample = 0; sample < 20; ++sample) {
    const Numbers numbers(8, 12, 60, random);
    MultiplierProgram program(numbers.B, numbers.x_min, numbers.x_max, 60);
    numbers.fill(program);
    std::vector<int> basis;
    Eigen::VectorXd lambda;
    const double least = program.solve(-kInfinity, kManySteps, basis, lambda);
    basis.clear();
    program.solve(least + 0.5, kManySteps, basis, lambda);
    EXPECT_LE(numbers.U(lambda), least + 0.5);
    early += numbers.U(lambda) > least + 1e-6 ? 1 : 0;
  }
  EXPECT_GT(early, 0);
}

TEST(MultiplierProgram, AllocatesNothing) {
  Random random(5);
  const Numbers numbers(10, 12, 162, random);
  MultiplierProgram program(numbers.B, numbers.x_min, numbers.x_max, 162);
  numbers.fill(program);
  std::vector<int> basis;
  Eigen::VectorXd lambda;
  program.solve(-kInfinity, kManySteps, basis, lambda);
  const long before = allocation_count();
  program.solve(-kInfinity, kManySteps, basis, lambda);
  basis.clear();
  basis.reserve(11);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace maxwrench
