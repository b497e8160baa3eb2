#include "lib/posture/ik/ik_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/posture/ik/ik_start_system.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/completeness.h"
#include "tests/support/dependents.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

class IkSolutionsOf : public testing::TestWithParam<const char*> {};

TEST_P(IkSolutionsOf, AreAllThatRandomStartsFind) {
  constexpr int kMany = std::max(50, samples(200));
  expect_complete(load_problem(GetParam()), kMany, kMany, kMany);
}

INSTANTIATE_TEST_SUITE_P(Shipped, IkSolutionsOf, testing::Values("mobile/push", "fixed/push"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

/// A general chain of six revolute joints has 16 solutions, real or not (Primrose 1986); a vehicle
/// with two dependent joints, x, y, z and yaw has two: two cones of directions cross twice.
TEST(IkSolver, AreAsManyAsTheoryHas) {
  Random random(6);
  for (int sample = 0; sample < 3; ++sample) {
    Problem problem = problem_with_dependents(random, {}, 1, true);
    EXPECT_EQ(IkStartSystem(problem).solutions(), 16);
    problem = problem_with_dependents(random, {0, 1, 2, 5}, 2, true);
    EXPECT_EQ(IkStartSystem(problem).solutions(), 2);
    // Three angles turn one orientation into another, in two ways.
    problem = problem_with_dependents(random, {0, 1, 2}, 2, true);
    EXPECT_EQ(IkStartSystem(problem).solutions(), 2);
  }
}

TEST(IkSolver, OfRandomChainsReachThePose) {
  Random random(2);
  for (int sample = 0; sample < std::max(8, samples(28)); ++sample) {
    const auto& axes = kIntegrableAxes[static_cast<std::size_t>(sample) % kIntegrableAxes.size()];
    const Problem problem = problem_with_dependents(random, axes, 1 + sample % 4);
    expect_complete(problem, samples(11), 20, -1);
    PostureEvaluator model(problem, false);
    for (int place = 0; place < 10; ++place) {
      model.evaluate(random_theta_r(problem, random));
      for (int i = 0; i < model.ik_solutions(); ++i) {
        EXPECT_LT(pose_error(problem, model.select(i)), 1e-12) << sample;
      }
    }
  }
}

/// The way there does not matter.
TEST(IkSolver, DependOnThetaRAlone) {
  Random random(3);
  const Problem problem = problem_with_dependents(random, {0, 1, 5}, 2);
  const auto start_system = std::make_shared<const IkStartSystem>(problem);
  IkSolver there(start_system), back(start_system);
  std::vector<Eigen::VectorXd> points;
  std::vector<std::vector<Six<double>>> list;
  for (int i = 0; i < 50; ++i) {
    points.push_back(random_theta_r(problem, random));
    list.emplace_back();
    for (int b = 0, n = there.solve(points.back()); b < n; ++b) list.back().push_back(there.y(b));
  }
  for (std::size_t i = points.size(); i-- > 0;) {
    ASSERT_EQ(back.solve(points[i]), static_cast<int>(list[i].size()));
    for (int b = 0; b < back.count(); ++b) {
      EXPECT_LT(apart(start_system->chain(), back.y(b), list[i][static_cast<std::size_t>(b)]),
                1e-9);
    }
  }
}

/// Where a pair of postures ends (a stretched arm), both are found as near to it from anywhere as
/// from close by. The four bars of dependent_joints_test: with the elbow at (cos q_0, sin q_0) the
/// rest of the way to the tool is stretched at a distance of 2 m.
TEST(IkSolver, AreTheSameFromAnywhereNearAFold) {
  const Problem problem = four_bars();
  const auto start_system = std::make_shared<const IkStartSystem>(problem);
  const auto apart_by = [](double q_0) {
    return std::hypot(1.5 - std::cos(q_0), 0.5 - std::sin(q_0)) - 2;
  };
  double inside = 0.5, outside = 3;
  while (outside - inside > 1e-15) {
    const double middle = (inside + outside) / 2;
    if (middle == inside || middle == outside) break;
    (apart_by(middle) < 0 ? inside : outside) = middle;
  }
  for (double distance = 1e-2; distance > 1e-11; distance /= 10) {
    const Eigen::VectorXd place = Eigen::VectorXd::Constant(1, inside - distance);
    IkSolver fresh(start_system), close(start_system);
    close.solve(Eigen::VectorXd::Constant(1, inside - 1.5 * distance));
    EXPECT_EQ(fresh.solve(place), 2) << distance;
    EXPECT_EQ(close.solve(place), 2) << distance;
    EXPECT_TRUE(fresh.complete() && close.complete()) << distance;
    EXPECT_EQ(fresh.solve(Eigen::VectorXd::Constant(1, inside + distance)), 0) << distance;
  }
}

/// A base that drives anywhere reaches a pose anywhere.
TEST(IkSolver, OfAPoseFarAway) {
  Problem problem = load_problem("mobile/push");
  const int near = IkSolver(serving_start_system(problem)).solve(problem.theta_r_default);
  problem.pose.p += Eigen::Vector3d(2000, -700, 0);
  EXPECT_EQ(IkSolver(serving_start_system(problem)).solve(problem.theta_r_default), near);
  EXPECT_GT(near, 0);
}

TEST(IkSolver, StartSystemIsOfOneProblem) {
  Problem problem = load_problem("mobile/push");
  ASSERT_NE(problem.start_system, nullptr);
  EXPECT_TRUE(problem.start_system->serves(problem));
  EXPECT_EQ(serving_start_system(problem), problem.start_system);
  problem.pose.p.x() += 0.01;
  EXPECT_FALSE(problem.start_system->serves(problem));
  EXPECT_NE(serving_start_system(problem), problem.start_system);
  problem = load_problem("mobile/push");
  problem.robot.joints[static_cast<std::size_t>(problem.dependent[0])].placement.p.z() += 0.01;
  EXPECT_FALSE(problem.start_system->serves(problem));
}

TEST(IkSolver, SLOW_OfAnUnreachablePoseAreNone) {
  Problem problem = load_problem("mobile/push");
  problem.pose.p.z() = 9;
  const auto start_system = std::make_shared<const IkStartSystem>(problem);
  EXPECT_FALSE(start_system->reaches());
  EXPECT_EQ(IkSolver(start_system).solve(problem.theta_r_default), 0);
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  EXPECT_EQ(posture.reason.str().find("unreachable pose"), 0u);
  EXPECT_EQ(posture.ik_solutions.unreachable, 1);
  EXPECT_EQ(model.ik_solutions(), 0);
}

}  // namespace
}  // namespace maxwrench
