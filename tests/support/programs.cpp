#include "tests/support/programs.h"

#include <gtest/gtest.h>

#include "solvers/lp/makers.h"

namespace maxwrench {
namespace {

LpSolution solve_by(LpSolver& solver, const LinearProgram& program) {
  LpSolution solution;
  solver.solve(program, solution);
  return solution;
}

}  // namespace

LpSolution solve_with_simplex(const LinearProgram& program) {
  return solve_by(*make_simplex(), program);
}

LpSolution solve_with_glpk(const LinearProgram& program) { return solve_by(*make_glpk(), program); }

void expect_verified(const LinearProgram& program, const LpSolution& solution) {
  EXPECT_TRUE(verified(program, solution))
      << to_string(solution.status) << ": " << solution.reason.c_str();
}

LinearProgram small_program() {
  LinearProgram p;
  p.A = Eigen::RowVector3d(1, 1, 1).sparseView();
  p.b = Eigen::VectorXd::Constant(1, 4);
  p.c = Eigen::Vector3d(1, 2, 0);
  p.l = Eigen::Vector3d::Zero();
  p.u = Eigen::Vector3d(3, 2, kInfinity);
  return p;
}

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

}  // namespace maxwrench
