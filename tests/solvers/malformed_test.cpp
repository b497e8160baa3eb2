#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "maxwrench/load.h"
#include "maxwrench/lp_solver.h"
#include "maxwrench/objective.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/trajectory_program.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "tests/support/support.h"
#include "tests/support/trajectories.h"

// Whoever uses the library may hand over anything: NaN and infinities get no verdict.

namespace maxwrench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The program of a task at its default posture.
struct AtDefault {
  Problem problem;
  PostureEvaluator model;
  WrenchProgram program;

  AtDefault(const char* name, Wrench wrench)
      : problem(load_problem(name)), model(problem), program(make_wrench_program(problem, wrench)) {
    set_posture(model.evaluate(problem.theta_r_default), program);
  }
};

/// Every way to spoil a program, one number or size at a time.
std::vector<std::function<void(WrenchProgram&)>> spoilers(const WrenchProgram& program) {
  std::vector<std::function<void(WrenchProgram&)>> all;
  for (const double x : {kNaN, kInfinity, -kInfinity}) {
    for (Eigen::Index i = 0; i < program.JtW.size(); ++i) {
      all.emplace_back([=](WrenchProgram& p) { p.JtW.data()[i] = x; });
    }
    for (Eigen::Index i = 0; i < program.tau_d.size(); ++i) {
      all.emplace_back([=](WrenchProgram& p) { p.tau_d[i] = x; });
    }
    for (Eigen::Index i = 0; i < program.c_w.size(); ++i) {
      all.emplace_back([=](WrenchProgram& p) { p.c_w[i] = x; });
    }
    all.emplace_back([=](WrenchProgram& p) { p.W(3, 0) = x; });
    if (program.C_2.size() > 0) all.emplace_back([=](WrenchProgram& p) { p.C_2(1, 0) = x; });
    if (x != -kInfinity) all.emplace_back([=](WrenchProgram& p) { p.w_min[0] = x; });
    if (x != kInfinity) all.emplace_back([=](WrenchProgram& p) { p.w_max[0] = x; });
  }
  all.emplace_back([](WrenchProgram& p) { p.tau_d.conservativeResize(p.tau_d.size() - 1); });
  all.emplace_back([](WrenchProgram& p) { p.JtW.conservativeResize(p.JtW.rows() - 1, 1); });
  all.emplace_back([](WrenchProgram& p) { p.w_max.resize(0); });
  all.emplace_back([](WrenchProgram& p) { p.W.resize(6, 0); });
  all.emplace_back([](WrenchProgram& p) { p.C_2 = Matrix6Xd::Zero(6, 5); });
  return all;
}

/// A solver that was fed such a program answers the next as if nothing had been.
TEST(Malformed, WrenchSolversGiveNoVerdict) {
  for (const auto& [name, wrench] : {std::pair{"uvms/valve", Wrench::kPure},
                                     {"uvms/valve", Wrench::kAny},
                                     {"planar/two_arms", Wrench::kPure}}) {
    const AtDefault at(name, wrench);
    for (const WrenchSolverEntry& entry : wrench_solvers()) {
      if (entry.one_column_only && at.program.columns() > 1) continue;
      SCOPED_TRACE(std::string(entry.name) + " on " + name);
      const auto solver = entry.make();
      Capability capability;
      solver->solve(at.program, true, capability);
      ASSERT_EQ(capability.status, Status::kOptimal);
      const double beta = capability.beta;
      for (const auto& spoil : spoilers(at.program)) {
        WrenchProgram program = at.program;
        spoil(program);
        EXPECT_FALSE(well_formed(program));
        solver->solve(program, true, capability);
        EXPECT_EQ(capability.status, Status::kNumericalError);
        EXPECT_FALSE(capability.reason.empty());
      }
      solver->solve(at.program, true, capability);
      EXPECT_EQ(capability.status, Status::kOptimal);
      EXPECT_NEAR(capability.beta, beta, 1e-9 * std::abs(beta));
    }
  }
}

/// Numbers whose squares or products no double holds: whoever has a verdict has one of numbers, and
/// the efforts do load what moves.
TEST(Malformed, WhatLeavesTheRangeOfDoublesHasNoValueWithoutEnd) {
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    const AtDefault at("uvms/valve", wrench);
    for (const WrenchSolverEntry& entry : wrench_solvers()) {
      if (entry.one_column_only && wrench == Wrench::kAny) continue;
      for (const double size : {1e-308, 1e-200, 1e200, 1e306}) {
        SCOPED_TRACE(std::string(entry.name) + " " + std::to_string(std::log10(size)));
        WrenchProgram program = at.program;
        program.JtW *= size;
        Capability capability;
        entry.make()->solve(program, true, capability);
        EXPECT_FALSE(size > 1 && capability.status == Status::kUnbounded);
        if (capability.status != Status::kOptimal) continue;
        EXPECT_TRUE(std::isfinite(capability.beta)) << capability.beta;
      }
      WrenchProgram program = at.program;
      program.c_w *= 1e308;
      Capability capability;
      entry.make()->solve(program, true, capability);
      EXPECT_TRUE(capability.status != Status::kOptimal || std::isfinite(capability.beta));
    }
  }
}

/// A point that is none, of the right size or another: whoever asks made a mistake.
TEST(Malformed, ObjectivesRejectThePoint) {
  for (const char* name :
       {"planar/force", "mobile/push_any_height", "planar/two_arms", "planar/trajectory"}) {
    SCOPED_TRACE(name);
    const Problem problem = load_problem(name);
    const auto objective = make_objective(problem, resolve(problem, {problem.name}));
    const Eigen::VectorXd start = stacked(constant_knots(problem, problem.theta_r_default));
    const double value = objective->evaluate(start);
    for (const double x : {kNaN, kInfinity, -kInfinity}) {
      Eigen::VectorXd bad = start;
      bad[bad.size() - 1] = x;
      EXPECT_THROW(objective->evaluate(bad), std::invalid_argument);
    }
    for (const Eigen::Index size : {Eigen::Index{0}, start.size() - 1, start.size() + 1}) {
      Eigen::VectorXd bad = start;
      bad.conservativeResize(size);
      EXPECT_THROW(
          objective->evaluate(bad.size() > start.size() ? Eigen::VectorXd::Zero(size) : bad),
          std::invalid_argument)
          << size;
    }
    EXPECT_EQ(objective->evaluate(start), value);
  }
}

/// Those in closed form, too; and where the posture itself is none.
TEST(Malformed, MeasuresGiveNoVerdict) {
  const AtDefault at("uvms/valve", Wrench::kPure);
  for (const MeasureEntry& entry : measures()) {
    SCOPED_TRACE(entry.name);
    const auto measure = entry.make(at.problem, find_wrench_solver("facets").make());
    PostureEvaluator model(at.problem);
    Posture posture = model.evaluate(at.problem.theta_r_default);
    Capability capability;
    measure->evaluate(posture, at.program, true, capability);
    ASSERT_EQ(capability.status, Status::kOptimal);
    const double beta = capability.beta;
    for (const auto& spoil : spoilers(at.program)) {
      WrenchProgram program = at.program;
      spoil(program);
      measure->evaluate(posture, program, true, capability);
      EXPECT_EQ(capability.status, Status::kNumericalError);
    }
    for (const double x : {kNaN, kInfinity}) {
      posture.J(2, 3) = x;
      WrenchProgram program = at.program;
      set_posture(posture, program);
      measure->evaluate(posture, program, true, capability);
      EXPECT_EQ(capability.status, Status::kNumericalError) << capability.beta;
    }
    posture = model.evaluate(at.problem.theta_r_default);
    measure->evaluate(posture, at.program, true, capability);
    EXPECT_EQ(capability.status, Status::kOptimal);
    EXPECT_EQ(capability.beta, beta);
  }
}

/// Fills what it wants: the rest is that of no answer, not of the last.
class Fills final : public Measure {
 public:
  int calls = 0;

 private:
  void evaluate_well_formed(const Posture& /*posture*/, const WrenchProgram& /*program*/,
                            bool /*efforts*/, Capability& capability) override {
    if (++calls == 1) {
      capability.conclude(Status::kOptimal);
      capability.beta = 7;
      capability.lambda.setOnes(3);
      capability.h.setOnes();
      capability.iterations = 5;
    } else if (calls == 2) {
      capability.conclude(Status::kOptimal);
      capability.beta = kNaN;
    }
  }
};

TEST(Malformed, MeasuresOfOnesOwnGetAClearedCapability) {
  const AtDefault at("planar/force", Wrench::kPure);
  PostureEvaluator model(at.problem);
  const Posture& posture = model.evaluate(at.problem.theta_r_default);
  Fills measure;
  Capability capability;
  measure.evaluate(posture, at.program, false, capability);
  EXPECT_EQ(capability.status, Status::kOptimal);
  EXPECT_EQ(capability.beta, 7);
  for (int call = 2; call <= 3; ++call) {  // no number is no value; nor is nothing
    measure.evaluate(posture, at.program, false, capability);
    EXPECT_EQ(capability.status, Status::kNumericalError);
    EXPECT_FALSE(capability.reason.empty());
    EXPECT_TRUE(capability.lambda.isZero(0));
    EXPECT_TRUE(capability.h.isZero(0));
    EXPECT_EQ(capability.iterations, 0);
  }
  EXPECT_EQ(capability.beta, 0);
}

TEST(Malformed, TrajectorySolversGiveNoVerdict) {
  const Problem problem = load_problem("uvms/valve");
  Random random(4);
  TrajectoryRecipe recipe;
  recipe.border = 2;
  for (const bool bordered : {false, true}) {
    recipe.border = bordered ? 2 : 0;
    const TrajectoryProgram good = random_trajectory(problem, recipe, random);
    ASSERT_TRUE(well_formed(good));
    std::vector<std::function<void(TrajectoryProgram&)>> all;
    for (const auto& spoil : spoilers(good.instants[1])) {
      all.emplace_back([spoil](TrajectoryProgram& p) { spoil(p.instants[1]); });
    }
    for (const double x : {kNaN, kInfinity}) {
      all.emplace_back([x](TrajectoryProgram& p) { p.first_min[0] = x; });
      all.emplace_back([x](TrajectoryProgram& p) { p.first_max[1] = -x; });
      all.emplace_back([x](TrajectoryProgram& p) { p.du_max(0, 1) = -x; });
      all.emplace_back([x](TrajectoryProgram& p) { p.rho = -x; });
      if (!bordered) continue;
      all.emplace_back([x](TrajectoryProgram& p) { p.y_min[0] = x; });
      all.emplace_back([x](TrajectoryProgram& p) { p.y_max[0] = -x; });
      all.emplace_back([x](TrajectoryProgram& p) { p.G[2](1, 1) = x; });
      all.emplace_back([x](TrajectoryProgram& p) { p.R.coeffRef(0, 0) = x; });
      all.emplace_back([x](TrajectoryProgram& p) { p.r_max[0] = -x; });
    }
    all.emplace_back([](TrajectoryProgram& p) { p.instants.clear(); });
    all.emplace_back([](TrajectoryProgram& p) { p.peak = p.size(); });
    all.emplace_back([](TrajectoryProgram& p) { p.du_max.resize(0, 0); });
    for (const TrajectorySolverEntry& entry : trajectory_solvers()) {
      SCOPED_TRACE(entry.name);
      const auto solver = entry.make();
      TrajectorySolution solution;
      solver->solve(good, solution);
      const Status status = solution.status;
      const double value = solution.value;
      EXPECT_TRUE(status == Status::kOptimal || status == Status::kInfeasible);
      for (std::size_t i = 0; i < all.size(); ++i) {
        TrajectoryProgram program = good;
        all[i](program);
        EXPECT_FALSE(well_formed(program)) << i;
        solver->solve(program, solution);
        EXPECT_EQ(solution.status, Status::kNumericalError) << i;
      }
      solver->solve(good, solution);
      EXPECT_EQ(solution.status, status);
      if (status == Status::kOptimal) {
        EXPECT_NEAR(solution.value, value, 1e-6 * std::abs(value));
      }
    }
  }
}

TEST(Malformed, LpSolversGiveNoVerdict) {
  const AtDefault at("planar/force", Wrench::kPure);
  const LinearProgram good = assemble(at.program);
  for (const LpEntry& entry : lp_solvers()) {
    SCOPED_TRACE(entry.name);
    const auto solver = entry.make();
    for (const double x : {kNaN, kInfinity, -kInfinity}) {
      std::vector<LinearProgram> bad(3, good);
      bad[0].A.coeffs()[0] = x;
      bad[1].b[0] = x;
      bad[2].c[0] = x;
      if (x != -kInfinity) bad.emplace_back(good).l[0] = x;
      if (x != kInfinity) bad.emplace_back(good).u[0] = x;
      for (const LinearProgram& program : bad) {
        LpSolution solution;
        solver->solve(program, solution);
        EXPECT_EQ(solution.status, Status::kNumericalError);
      }
    }
    LpSolution solution;
    solver->solve(good, solution);
    EXPECT_EQ(solution.status, Status::kOptimal);
  }
}

TEST(Malformed, ZonotopesRejectIt) {
  const Eigen::VectorXd low = Eigen::VectorXd::Constant(2, -1), high = -low;
  EXPECT_NO_THROW(make_zonotope(Eigen::MatrixXd::Identity(2, 2), low, high));
  for (const double x : {kNaN, kInfinity, -kInfinity}) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Identity(2, 2);
    B(0, 1) = x;
    EXPECT_THROW(make_zonotope(B, low, high), std::invalid_argument);
  }
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(2, kNaN);
  EXPECT_THROW(make_zonotope(Eigen::MatrixXd::Identity(2, 2), none, high), std::invalid_argument);
  EXPECT_THROW(make_zonotope(Eigen::MatrixXd::Identity(2, 2), low, none), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
