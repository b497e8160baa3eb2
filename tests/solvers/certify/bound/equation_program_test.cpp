#include "solvers/certify/bound/equation_program.h"

#include <gtest/gtest.h>

#include <numbers>

#include "maxwrench/load.h"
#include "solvers/certify/bound/loop_model.h"
#include "tests/support/loops.h"

namespace maxwrench {
namespace {

/// f(x) of a model, m.
Eigen::VectorXd equations_at(const LoopModel& model, const Eigen::VectorXd& x) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(model.m);
  for (const LoopPart& part : model.parts) {
    if (part.kind == LoopPart::Kind::kEquations) f(part.rows) += part.f.evaluate(x);
  }
  return f;
}

/// The arm is singular here, so no lambda limits the values, and the box is too narrow to be cut.
/// The tool is 0.66 m away from its pose.
TEST(EquationProgram, ExcludesANarrowBoxWhereTheArmIsSingular) {
  const Problem problem = load_problem("gallery/ur10/lift");
  const auto bound = make_capability_bound(problem, "linf_polytope", Wrench::kPure);
  Eigen::VectorXd x(6);
  x << std::numbers::pi, -std::numbers::pi, 0, 0, std::numbers::pi / 2, -std::numbers::pi / 2;
  EXPECT_NEAR(equations_at(LoopModel(problem), x).minCoeff(), -0.657, 1e-9);
  BoxProof proof;
  bound->evaluate(x.array() - 1e-6, x.array() + 1e-6, 0, kInfinity, proof);
  EXPECT_EQ(proof.kind, BoxProof::Kind::kNoPosture);
}

/// Boxes somewhere, of which some have no posture. The nu of these has nu'f > 0 all over the box.
void test_exclusion(const Problem& problem, Wrench wrench) {
  constexpr double kWidth = 0.3;
  const std::string measure = "linf_polytope";
  const LoopModel model(problem, forces_in_bound(problem, measure),
                        left_out_coordinate(problem, measure, wrench));
  const LoopCoordinates& all = model.coordinates;
  const auto bound = make_capability_bound(problem, measure, wrench);
  Random random(5);
  int excluded = 0;
  for (int sample = 0; sample < 20; ++sample) {
    Eigen::VectorXd lower = all.lower, upper = all.upper;
    bound->extend(lower, upper);
    for (Eigen::Index i = 0; i < lower.size(); ++i) {
      lower[i] = random.uniform(std::max(lower[i], -3.0), std::min(upper[i], 3.0));
    }
    BoxProof proof;
    bound->evaluate(lower, lower.array() + kWidth, 0, kInfinity, proof);
    if (proof.kind != BoxProof::Kind::kNoPosture) continue;
    ++excluded;
    EXPECT_EQ(proof.high, -kInfinity);
    for (int point = 0; point < 20; ++point) {
      Eigen::VectorXd x = lower.head(all.lower.size());
      for (double& each : x) each += random.uniform(0, kWidth);
      EXPECT_GT(proof.nu.dot(equations_at(model, x)), 0);
    }
  }
  EXPECT_GT(excluded, 0);
}

TEST(EquationProgram, ExcludesBoxesWithoutAPosture) {
  for (const char* name : {"gallery/gen3/lift", "fixed/push", "mobile/push", "planar/two_arms",
                           "dual_arm/two_arms", "random, parked"}) {
    SCOPED_TRACE(name);
    test_exclusion(loop_problem(name), Wrench::kPure);
  }
  test_exclusion(load_problem("fixed/push"), Wrench::kAny);
}

/// Lists with forces of a second contact have a bound of their own.
TEST(EquationProgram, ExcludesBoxesWithoutAPostureOfAList) {
  for (const char* name : {"fixed/push", "planar/two_arms"}) {
    SCOPED_TRACE(name);
    Problem problem = load_problem(name);
    problem.scenarios.wrenches = {{.name = "one", .c = problem.c},
                                  {.name = "half", .c = problem.c / 2}};
    problem.scenarios.limits = {{"", problem.robot.actuation}};
    problem.scenarios.unit = "N";
    test_exclusion(problem, Wrench::kPure);
  }
}

}  // namespace
}  // namespace maxwrench
