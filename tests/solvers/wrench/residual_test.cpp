#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

using Eigen::Vector2d;

/// max w  subject to  u = (0.5 + w, w), |u_i| <= 2: w = 1.5, u = (2, 1.5). More of tau_1 is less of
/// w, so lambda = (-1, 0).
class ResidualTest : public testing::Test {
 protected:
  void SetUp() override {
    program.actuation = &set;
    program.W = Matrix6Xd::Identity(6, 1);
    program.c_w = Eigen::VectorXd::Ones(1);
    program.w_min = Eigen::VectorXd::Constant(1, -kInfinity);
    program.w_max = Eigen::VectorXd::Constant(1, kInfinity);
    program.JtW = Vector2d(1, 1);
    program.tau_d = Vector2d(0.5, 0);
    answer.u = Vector2d(2, 1.5);
    answer.w = Eigen::VectorXd::Constant(1, 1.5);
    answer.lambda = Vector2d(-1, 0);
  }
  static Residual of(const WrenchProgram& program, const Capability& answer) {
    return recheck(program, answer.u, answer.w, answer.lambda);
  }
  const Zonotope set =
      make_zonotope(Eigen::MatrixXd::Identity(2, 2), Vector2d(-2, -2), Vector2d(2, 2));
  WrenchProgram program;
  Capability answer;
};

TEST_F(ResidualTest, WhatIsNotANumberIsNotWithinAnything) {
  const Residual small{1e-9, 1e-9, 1e-9, 1e-9};
  EXPECT_TRUE(small.within(1e-8));
  for (double Residual::*field :
       {&Residual::balance, &Residual::bounds, &Residual::dual, &Residual::gap}) {
    for (const double bad : {static_cast<double>(NAN), kInfinity}) {
      Residual broken = small;
      broken.*field = bad;
      EXPECT_FALSE(broken.within(1e-8));
      EXPECT_FALSE(broken.within(kInfinity));
    }
  }
  EXPECT_FALSE(small.within(1e-8 * (1 + std::abs(NAN))));
  EXPECT_FALSE(small.within(NAN));
}

TEST_F(ResidualTest, VanishesAtTheOptimum) { EXPECT_TRUE(of(program, answer).within(2.5e-15)); }

TEST_F(ResidualTest, AnswersThatAreNotNumbersSatisfyNoProgram) {
  for (Eigen::VectorXd Capability::*part : {&Capability::u, &Capability::w, &Capability::lambda}) {
    for (Eigen::Index i = 0; i < (answer.*part).size(); ++i) {
      Capability broken = answer;
      (broken.*part)[i] = NAN;
      EXPECT_FALSE(of(program, broken).within(2.5e-7));
    }
    Capability shorter = answer;
    (shorter.*part).resize(0);
    EXPECT_EQ(of(program, shorter).gap, kInfinity);
  }
}

TEST_F(ResidualTest, ProgramsThatAreNotNumbersAreNotSatisfied) {
  const std::vector<std::function<void(WrenchProgram&)>> changes = {
      [](WrenchProgram& p) { p.tau_d[0] = NAN; },  [](WrenchProgram& p) { p.tau_d[1] = NAN; },
      [](WrenchProgram& p) { p.JtW(0, 0) = NAN; }, [](WrenchProgram& p) { p.w_max[0] = NAN; },
      [](WrenchProgram& p) { p.w_min[0] = NAN; },  [](WrenchProgram& p) { p.c_w[0] = NAN; }};
  for (const auto& change : changes) {
    WrenchProgram broken = program;
    change(broken);
    EXPECT_FALSE(of(broken, answer).within(2.5e-7));
  }
}

TEST_F(ResidualTest, FarkasVectorsWithoutNumbersProveNothing) {
  // tau_1 - tau_2 = 5 is out of reach: u_1 - u_2 <= 4.
  program.tau_d = Vector2d(5, 0);
  EXPECT_TRUE(proves_infeasible(program, Vector2d(1, -1)));
  EXPECT_FALSE(proves_infeasible(program, Vector2d(1, 0)));  // w may balance it
  EXPECT_FALSE(proves_infeasible(program, Vector2d(1, NAN)));
  EXPECT_FALSE(proves_infeasible(program, Eigen::VectorXd()));
  program.tau_d[0] = NAN;
  EXPECT_FALSE(proves_infeasible(program, Vector2d(1, -1)));
  program.tau_d[0] = 5;
  program.JtW(0, 0) = NAN;
  EXPECT_FALSE(proves_infeasible(program, Vector2d(1, -1)));
}

TEST_F(ResidualTest, WhatTheDataDoNotProveIsNoInfeasibleVerdict) {
  // Out of reach by rounding only: no solver may call that infeasible.
  for (const double over : {1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-3}) {
    program.tau_d = Vector2d(4 * (1 + over), 0);
    for (const WrenchSolverEntry& entry : wrench_solvers()) {
      Capability capability;
      entry.make()->solve(program, false, capability);
      if (capability.status == Status::kInfeasible) {
        EXPECT_TRUE(proves_infeasible(program, capability.lambda)) << entry.name << " " << over;
      }
      if (over < 1e-6) continue;
      EXPECT_EQ(capability.status, Status::kInfeasible) << entry.name;
    }
  }
}

}  // namespace
}  // namespace maxwrench
