#include <gtest/gtest.h>

#include <numbers>

#include "maxwrench/certify.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/strategies.h"
#include "tests/support/support.h"

// Proofs of any wrenches with dependent joints.

namespace maxwrench {
namespace {

Options any_wrenches() {
  Options options;
  options.wrench = Wrench::kAny;
  options.budget = 2000;
  return options;
}

/// One joint is redundant, so all of theta_r can be tried, with all IK solutions.
TEST(FreeProof, SLOW_AgreesWithDenseSearch) {
  for (const char* name : {"fixed/push", "gallery/panda/push"}) {
    constexpr int kPlaces = 4000;
    Problem problem = load_problem(name);
    problem.robot.collision = nullptr;
    const auto objective = make_capability_objective(problem, Wrench::kAny, [&] {
      return find_measure("linf_polytope").make(problem, find_wrench_solver("condensed").make());
    });
    const double from = problem.theta_r_min[0], to = problem.theta_r_max[0];
    double most = -kInfinity;
    for (int i = 0; i <= kPlaces; ++i) {
      const double theta_r = from + (to - from) * i / kPlaces;
      most = std::max(most, objective->evaluate(Eigen::VectorXd::Constant(1, theta_r)));
    }
    const Proof proof = certify(problem, any_wrenches(), {.gap = 1e-3, .seconds = 600});
    EXPECT_EQ(proof.status, Status::kProven) << proof.reason.c_str();
    EXPECT_GE(proof.bound, most);
    EXPECT_NEAR(proof.answer.beta(), most, 2e-3 * most) << name;
    EXPECT_LE(proof.gap(), 1.000001e-3);
  }
}

/// Two joints are redundant. The best postures push with all that the wheels have, which are at 45
/// degrees to the push.
TEST(FreeProof, SLOW_IsThatOfTheWheels) {
  const Problem problem = load_problem("mobile/push");
  const Proof proof = certify(problem, any_wrenches(), {.gap = 3e-3, .seconds = 600});
  EXPECT_EQ(proof.status, Status::kProven) << proof.reason.c_str();
  const double most = 4 * 135 / std::numbers::sqrt2;
  EXPECT_NEAR(proof.answer.beta(), most, 1e-3 * most);
  EXPECT_GE(proof.bound, proof.answer.beta());
}

/// A list of scenarios has no such bound.
TEST(FreeProof, IsNotForLists) {
  Problem problem = load_problem("fixed/push");
  problem.scenarios.wrenches = {{"one", problem.c}, {"other", -problem.c}};
  try {
    certify(problem, any_wrenches());
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("list with dependent joints"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace maxwrench
