#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "problems/mps.h"
#include "solvers/lp/simplex.h"

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

struct Known {
  std::string name;
  double optimum;
};

/// Koch (2004); e226 with its constant, minus the RHS entry of the objective: -18.7519 + 7.113.
const std::vector<Known> kNetlib = {
    {"adlittle", 225494.96316238038}, {"afiro", -464.75314285714286},
    {"blend", -30.812149845828220},   {"brandy", 1518.5098964881284},
    {"capri", 2690.0129137681610},    {"degen2", -1435.178},
    {"e226", -11.638929066370549},    {"israel", -896644.82186304573},
    {"kb2", -1749.9001299062057},     {"recipe", -266.616},
    {"sc50a", -64.575077058564509},   {"sc50b", -70},
    {"scagr7", -2331389.824330984},   {"share2b", -415.73224074141949},
    {"stocfor1", -41131.976219436406}};

class Netlib : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "no folder " << folder_;
  }
  const std::filesystem::path folder_ = MAXWRENCH_NETLIB_DIR;
};

TEST_F(Netlib, OptimaToEightDigits) {
  const auto simplex = make_simplex();
  for (const Known& known : kNetlib) {
    const MpsProgram mps = read_mps(folder_ / (known.name + ".mps"));
    LpSolution solution;
    simplex->solve(mps.program, solution);
    EXPECT_EQ(solution.status, Status::kOptimal) << known.name;
    expect_verified(mps.program, solution);
    EXPECT_NEAR(mps.objective(solution), known.optimum, 1e-8 * std::abs(known.optimum))
        << known.name;
    // The same again from its own basis: no pivot, same answer.
    const double objective = solution.objective;
    simplex->solve(mps.program, solution);
    EXPECT_EQ(solution.iterations, 0) << known.name;
    EXPECT_NEAR(solution.objective, objective, 1e-12 * std::abs(objective)) << known.name;
  }
}

TEST_F(Netlib, InfeasibleWithProof) {
  for (const char* name : {"itest2", "itest6", "galenet", "bgprtr", "woodinfe", "klein1"}) {
    const MpsProgram mps = read_mps(folder_ / "infeasible" / (std::string(name) + ".mps"));
    const LpSolution solution = solve(mps.program);
    EXPECT_EQ(solution.status, Status::kInfeasible) << name;
    expect_verified(mps.program, solution);
  }
}

TEST_F(Netlib, UnboundedWithRay) {
  const MpsProgram mps = read_mps(folder_ / "unbounded/gas11.mps");
  const LpSolution solution = solve(mps.program);
  EXPECT_EQ(solution.status, Status::kUnbounded);
  expect_verified(mps.program, solution);
}

}  // namespace
}  // namespace maxwrench
