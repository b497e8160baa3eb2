#include "lib/scenario/scenario_margins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lib/scenario/current_load.h"
#include "lib/scenario/scenario_program.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

LoadGroup random_cases(Random& random, int count) {
  LoadGroup cases(1);
  for (int i = 0; i < count; ++i) {
    cases.emplace_back().current = {random.uniform(-1, 1), random.uniform(-1, 1), 0};
  }
  return cases;
}

/// By definition: the least of all cases, each from the inverse dynamics. Bounds are not above it.
void expect_least_of_cases(Problem problem) {
  Random random(8);
  problem.scenarios.loads = {random_cases(random, 30)};
  const LoadGroup& cases = problem.scenarios.loads.front();
  const Eigen::MatrixXd N = problem.robot.actuation.N;
  PostureEvaluator evaluator(problem, false);
  ScenarioPosture at(problem);
  ScenarioMargins margins(problem);
  CurrentLoad one(problem.robot);
  Eigen::VectorXd tau(problem.robot.velocities());
  for (int i = 0; i < samples(20); ++i) {
    const Posture& posture = evaluator.evaluate(random_theta_r(problem, random));
    at.set(posture);
    margins.set(at);
    EXPECT_FALSE(margins.exact());
    const Eigen::ArrayXd bounds = margins.values();
    margins.refine_all();
    one.set(posture.base.R, posture.q);
    Eigen::ArrayXXd all(2 * N.cols(), static_cast<Eigen::Index>(cases.size()));
    for (std::size_t k = 0; k < cases.size(); ++k) {
      one.evaluate(cases[k].current, tau);
      const Eigen::VectorXd loaded = N.transpose() * (posture.tau_d + tau);
      all.col(static_cast<Eigen::Index>(k)) << -loaded.array(), loaded.array();
    }
    const Eigen::ArrayXd least = all.rowwise().minCoeff();
    const double rounding = 1e-12 * (1 + all.abs().maxCoeff());
    EXPECT_LT((margins.values() - least).abs().maxCoeff(), rounding);
    EXPECT_LT((bounds - least).maxCoeff(), rounding);
    ScenarioChoice choice;
    for (Eigen::Index row = 0; row < least.size(); ++row) {
      margins.choose(row, choice);
      ASSERT_EQ(choice.cases.size(), 1U);
      EXPECT_NEAR(all(row, choice.cases.front()), least[row], rounding);
    }
  }
}

TEST(ScenarioMargins, AreThoseOfTheWorstCurrents) {
  expect_least_of_cases(load_problem("uvms/valve"));
}

/// Nothing bounds the arms of a prismatic joint without limits, so bounds are of each posture.
TEST(ScenarioMargins, OfAJointWithoutLimits) {
  Problem problem = load_problem("uvms/valve");
  Joint& joint = problem.robot.joints[1];
  joint.type = JointType::kPrismatic;
  joint.q_min = -kInfinity;
  joint.q_max = kInfinity;
  Random random(9);
  const LoadGroup cases = random_cases(random, 3);
  const Eigen::VectorXd normal = Eigen::VectorXd::Ones(problem.robot.velocities());
  EXPECT_FALSE(std::isfinite(CurrentCases(problem.robot, cases).most(normal)));
  expect_least_of_cases(problem);
}

TEST(ScenarioMargins, RejectACurrentWithMasses) {
  Problem problem = load_problem("uvms/valve");
  LoadCase both;
  both.current = {0.3, 0, 0};
  both.loads.push_back({0, 1, Eigen::Vector3d::Zero()});
  problem.scenarios.loads = {{both}};
  EXPECT_THROW(ScenarioMargins margins(problem), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
