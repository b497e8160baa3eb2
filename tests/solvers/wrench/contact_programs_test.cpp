#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr int kBase = 6, kThrusters = 8, kArmJoints = 4;  // of each of two arms

/// A vehicle with two arms.
Zonotope random_vehicle(Random& random) {
  const int rows = kBase + 2 * kArmJoints;
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(rows, kThrusters + 2 * kArmJoints);
  for (double& b : B.topLeftCorner(kBase, kThrusters).reshaped()) b = random.normal();
  B.bottomRightCorner(2 * kArmJoints, 2 * kArmJoints).setIdentity();
  Eigen::VectorXd u_min(B.cols()), u_max(B.cols());
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    u_min[j] = random.uniform(-4, -1);
    u_max[j] = random.uniform(1, 4);
  }
  return make_zonotope(B, u_min, u_max);
}

/// One or six free columns that load base and first arm; then one to six of a second contact that
/// load base and second arm: free, one-sided, limited or at rest.
WrenchProgram random_program(Random& random, const Zonotope& set) {
  WrenchProgram program;
  program.actuation = &set;
  const int own = random.uniform() < 0.5 ? 1 : 6;
  const int l = 1 + static_cast<int>(random.uniform(0, 6));
  const int n = set.dimension();
  program.W = Matrix6Xd::Identity(6, own);
  program.C_2 = Matrix6Xd::Identity(6, l);
  program.c_w = Eigen::VectorXd::Unit(own + l, 0);
  program.w_min = Eigen::VectorXd::Constant(own + l, -kInfinity);
  program.w_max = Eigen::VectorXd::Constant(own + l, kInfinity);
  for (int j = own; j < own + l; ++j) {
    const double kind = random.uniform();
    if (kind < 0.6) program.w_min[j] = 0;
    if (kind > 0.4 && kind < 0.6) program.w_max[j] = random.uniform(0, 2);
    if (kind > 0.95) program.w_min[j] = program.w_max[j] = 0;
  }
  program.JtW = Eigen::MatrixXd::NullaryExpr(n, own + l, [&] { return random.normal(); });
  program.JtW.topLeftCorner(n, own).bottomRows(kArmJoints).setZero();
  program.JtW.rightCols(l).middleRows(kBase, kArmJoints).setZero();
  const double load = random.uniform() < 0.3 ? 4 : 1;
  program.tau_d = Eigen::VectorXd::NullaryExpr(n, [&] { return load * random.normal(); });
  return program;
}

/// 10,000 programs, of which Ipopt solves 200.
TEST(ContactPrograms, EverySolverGivesTheSameAnswer) {
  Random random(7);
  int infeasible = 0, compared = 0, undecided = 0;
  for (int robot = 0; robot < samples(100); ++robot) {
    const Zonotope set = random_vehicle(random);
    std::vector<std::pair<std::string, std::unique_ptr<WrenchSolver>>> solvers;
    for (const char* name : {"condensed", "simplex", "clp", "glpk", "ipopt"}) {
      solvers.emplace_back(name, find_wrench_solver(name).make());
    }
    for (int i = 0; i < 100; ++i, ++compared) {
      const WrenchProgram program = random_program(random, set);
      Capability reference;
      for (auto& [name, solver] : solvers) {
        const bool interior = name == "ipopt";
        if (interior && i >= 2) continue;
        Capability capability;
        solver->solve(program, true, capability);
        if (name == "condensed") reference = capability;
        // Rarely a library says something that the program's own numbers do not bear out.
        if (capability.status == Status::kNumericalError && name != "condensed") {
          ++undecided;
          continue;
        }
        EXPECT_EQ(capability.status, reference.status) << name << ": " << capability.reason.c_str();
        if (capability.status == Status::kInfeasible) {
          EXPECT_TRUE(proves_infeasible(program, capability.lambda)) << name;
        }
        if (capability.status != Status::kOptimal) continue;
        const double tolerance = interior ? 1e-6 : 1e-9;
        EXPECT_NEAR(capability.beta, reference.beta, tolerance * (1 + std::abs(reference.beta)))
            << name;
        const Residual residual = recheck(program, capability.u, capability.w, capability.lambda);
        EXPECT_TRUE(residual.within((interior ? 1e-5 : 1e-7) * (1 + std::abs(capability.beta))))
            << name;
      }
      infeasible += reference.status == Status::kInfeasible;
    }
  }
  EXPECT_LE(undecided, std::max(3, compared / 500));
  EXPECT_GT(infeasible, compared / 20);
  EXPECT_LT(infeasible, compared * 19 / 20);
}

}  // namespace
}  // namespace maxwrench
