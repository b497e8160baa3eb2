#include "solvers/lp/elastic.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/math/farkas.h"

namespace maxwrench {
namespace {

/// The smallest violation that counts as infeasible, relative to 1 + |b|.
constexpr double kInfeasible = 1e-7;

}  // namespace

LinearProgram elastic(const LinearProgram& program) {
  const int rows = program.rows();
  const int cols = program.cols();
  LinearProgram e;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < cols; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(program.A, j); it; ++it) {
      entries.emplace_back(it.row(), j, it.value());
    }
  }
  for (int i = 0; i < rows; ++i) {
    entries.emplace_back(i, cols + i, 1.0);
    entries.emplace_back(i, cols + rows + i, -1.0);
  }
  e.A.resize(rows, cols + 2 * rows);
  e.A.setFromTriplets(entries.begin(), entries.end());
  e.b = program.b;
  e.c = Eigen::VectorXd::Zero(e.A.cols());
  e.c.tail(2 * rows).setConstant(-1);
  e.l = Eigen::VectorXd::Zero(e.A.cols());
  e.u = Eigen::VectorXd::Constant(e.A.cols(), kInfinity);
  e.l.head(cols) = program.l;
  e.u.head(cols) = program.u;
  return e;
}

LinearProgram recession(const LinearProgram& program) {
  LinearProgram r = program;
  r.b.setZero();
  for (int j = 0; j < program.cols(); ++j) {
    r.l[j] = program.l[j] > -kInfiniteBound ? 0 : -1;
    r.u[j] = program.u[j] < kInfiniteBound ? 0 : 1;
  }
  return r;
}

void give_up(LpSolution& solution, Status status, const char* reason) {
  solution.status = status;
  solution.reason = reason;
  solution.basis.clear();
}

void solve_by_attempts(const LinearProgram& program, const LpAttempt& attempt,
                       LpSolution& solution) {
  const bool warm = static_cast<int>(solution.basis.size()) == program.rows() + program.cols();
  if (attempt(program, warm, false, solution)) return;
  if (warm) ++solution.cold_restarts;
  if (attempt(program, false, true, solution)) return;
  const auto run = [&](const LinearProgram& other, LpSolution& proof) {
    return (attempt(other, false, false, proof) || attempt(other, false, true, proof)) &&
           proof.status == Status::kOptimal;
  };
  prove_no_optimum(program, run, solution);
}

bool rejected(const LinearProgram& program, LpSolution& solution) {
  solution.iterations = solution.cold_restarts = 0;
  solution.objective = 0;
  solution.certificate.resize(0);
  try {
    validate(program);
  } catch (const std::invalid_argument&) {
    give_up(solution, Status::kNumericalError,
            "the program is malformed: sizes disagree or an entry is not finite");
    return true;
  }
  const auto too_large = [](const auto& v) { return (v.array().abs() >= kInfiniteBound).any(); };
  if (too_large(program.b) || too_large(program.c) || too_large(program.A.coeffs())) {
    give_up(solution, Status::kNumericalError, "an entry is beyond 1e20, which libraries reject");
    return true;
  }
  if (!(program.l.array() > program.u.array()).any()) return false;
  give_up(solution, Status::kInfeasible, "a lower bound exceeds its upper bound");
  solution.certificate.setZero(program.rows());
  return true;
}

void prove_no_optimum(const LinearProgram& program, const LpRun& run, LpSolution& solution) {
  const int iterations = solution.iterations;
  const LinearProgram relaxed = elastic(program);
  LpSolution proof;
  const bool feasibility_known = run(relaxed, proof);
  solution.iterations = iterations + proof.iterations;
  const double size = program.rows() == 0 ? 0 : program.b.lpNorm<Eigen::Infinity>();
  if (feasibility_known && relaxed.c.dot(proof.x) < -kInfeasible * (1 + size)) {
    // The elastic optimum is lambda'b less sup {lambda'A x}, so -lambda points out of the reachable
    // set.
    solution.certificate = -proof.lambda;
    drop_rounding(solution.certificate);
    give_up(solution, Status::kInfeasible, "no x satisfies the rows within its bounds");
    if (verified(program, solution)) return;
  } else if (feasibility_known) {
    solution.x = proof.x.head(program.cols());
    LpSolution ray;
    if (run(recession(program), ray)) {
      solution.iterations += ray.iterations;
      solution.certificate = ray.x;
      drop_rounding(solution.certificate);
      give_up(solution, Status::kUnbounded, "the objective grows without limit");
      if (verified(program, solution)) return;
    }
  }
  solution.certificate.resize(0);
  give_up(solution, Status::kNumericalError, "no verdict that the program's data confirm");
}

}  // namespace maxwrench
