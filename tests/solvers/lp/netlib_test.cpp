#include "tests/support/netlib.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "maxwrench/mps.h"
#include "solvers/lp/makers.h"
#include "tests/support/programs.h"

namespace maxwrench {
namespace {

const std::filesystem::path kFolder = kNetlibFolder;

TEST(Netlib, OptimaToEightDigits) {
  const auto simplex = make_simplex();
  for (const auto& [name, optimum] : kNetlibOptima) {
    const MpsProgram mps = read_mps(kFolder / (std::string(name) + ".mps"));
    LpSolution solution;
    simplex->solve(mps.program, solution);
    EXPECT_EQ(solution.status, Status::kOptimal) << name;
    expect_verified(mps.program, solution);
    EXPECT_NEAR(mps.objective(solution), optimum, 1e-8 * std::abs(optimum)) << name;
    // The same again from its own basis: no pivot, same answer.
    const double objective = solution.objective;
    simplex->solve(mps.program, solution);
    EXPECT_EQ(solution.iterations, 0) << name;
    EXPECT_NEAR(solution.objective, objective, 1e-12 * std::abs(objective)) << name;
  }
}

TEST(Netlib, InfeasibleWithProof) {
  for (const char* name : kNetlibInfeasible) {
    const MpsProgram mps = read_mps(kFolder / "infeasible" / (std::string(name) + ".mps"));
    const LpSolution solution = solve_with_simplex(mps.program);
    EXPECT_EQ(solution.status, Status::kInfeasible) << name;
    expect_verified(mps.program, solution);
  }
}

TEST(Netlib, UnboundedWithRay) {
  const MpsProgram mps = read_mps(kFolder / "unbounded/gas11.mps");
  const LpSolution solution = solve_with_simplex(mps.program);
  EXPECT_EQ(solution.status, Status::kUnbounded);
  expect_verified(mps.program, solution);
}

}  // namespace
}  // namespace maxwrench
