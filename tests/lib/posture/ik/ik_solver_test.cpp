#include "lib/posture/ik/ik_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lib/posture/ik/ik_start_system.h"
#include "lib/robot/kinematics.h"
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

/// The origins of the joints (x, y, z, roll, pitch, yaw), all about z, as makers publish them.
/// Right angles are rounded, and axes that ought to meet miss each other by some tenths of a
/// millimetre.
using Origins = std::vector<std::array<double, 6>>;

/// github.com/Kinovarobotics/ros_kortex, GEN3-7DOF-VISION_ARM_URDF_V12.urdf
const Origins kKinovaGen3 = {{0, 0, 0.15643, 3.1416, 0, 0},
                             {0, 0.005375, -0.12838, 1.5708, 0, 0},
                             {0, -0.21038, -0.006375, -1.5708, 0, 0},
                             {0, 0.006375, -0.21038, 1.5708, 0, 0},
                             {0, -0.20843, -0.006375, -1.5708, 0, 0},
                             {0, 0.00017505, -0.10593, 1.5708, 0, 0},
                             {0, -0.10593, -0.00017505, -1.5708, 0, 0}};
/// github.com/Kinovarobotics/ros_kortex, GEN3-6DOF_VISION_URDF_ARM_V01.urdf
const Origins kKinovaGen3Six = {{0, 0, 0.15643, -3.1416, 0, 0},
                                {0, 0.005375, -0.12838, 1.5708, 0, 0},
                                {0, -0.41, 0, 3.1416, 0, 0},
                                {0, 0.20843, -0.006375, 1.5708, 0, 0},
                                {0, -0.00017505, -0.10593, -1.5708, 0, 0},
                                {0, 0.10593, -0.00017505, 1.5708, 0, 0}};
/// github.com/doosan-robotics/doosan-robot, m1013.urdf
const Origins kDoosanM1013 = {{0, 0, 0.1525, 0, 0, 0},   {0, 0.0345, 0, 0, -1.571, -1.571},
                              {0.62, 0, 0, 0, 0, 1.571}, {0, -0.559, 0, 1.571, 0, 0},
                              {0, 0, 0, -1.571, 0, 0},   {0, -0.121, 0, 1.571, 0, 0}};

/// The arm on a base with these axes, at the pose of the joint positions q of the guess.
Problem published_arm(const Origins& origins, const std::vector<int>& base_axes,
                      const std::vector<int>& redundant, Random& random) {
  Problem problem;
  Robot& robot = problem.robot;
  robot.base_axes = base_axes;
  const int joints = static_cast<int>(origins.size());
  robot.links.resize(origins.size() + 1);
  for (int i = 0; i < joints; ++i) {
    const std::array<double, 6>& origin = origins[static_cast<std::size_t>(i)];
    Joint joint;
    joint.parent = i;
    joint.placement.p = {origin[0], origin[1], origin[2]};
    joint.placement.R = (Eigen::AngleAxisd(origin[5], Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(origin[4], Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(origin[3], Eigen::Vector3d::UnitX()))
                            .toRotationMatrix();
    joint.q_min = -M_PI;
    joint.q_max = M_PI;
    robot.joints.push_back(joint);
  }
  robot.end_effectors = {{"tool", joints, {}}};
  complete_actuation(robot);
  problem.guess_q = Eigen::VectorXd::NullaryExpr(joints, [&] { return random.uniform(-3, 3); });
  Kinematics<double> kinematics(robot);
  kinematics.set_joints(problem.guess_q);
  problem.pose = kinematics.end_effector(robot.end_effectors[0]);
  problem.redundant = redundant;
  for (int i = 0; i < joints; ++i) {
    if (std::find(redundant.begin(), redundant.end(), i) == redundant.end()) {
      problem.dependent.push_back(i);
    }
  }
  const auto r = static_cast<Eigen::Index>(redundant.size());
  problem.theta_r_min = Eigen::VectorXd::Constant(r, -M_PI);
  problem.theta_r_max = Eigen::VectorXd::Constant(r, M_PI);
  problem.theta_r_default = problem.guess_q(redundant);
  return problem;
}

/// Sixteen solutions each, as of any chain of six joints without special geometry: half of them
/// have imaginary parts up to 14 rad.
TEST(IkSolver, OfArmsAsPublishedAreAll) {
  Random random(4);
  struct Arm {
    const Origins& origins;
    std::vector<int> redundant;
  };
  for (const auto& [origins, redundant] :
       {Arm{kKinovaGen3, {0}}, Arm{kKinovaGen3, {5}}, Arm{kKinovaGen3, {6}},
        Arm{kKinovaGen3Six, {}}, Arm{kDoosanM1013, {}}}) {
    for (int sample = 0; sample < samples(6); ++sample) {
      const Problem problem = published_arm(origins, {}, redundant, random);
      const auto start_system = std::make_shared<const IkStartSystem>(problem);
      ASSERT_EQ(start_system->solutions(), 16) << origins.size() << " joints, sample " << sample;
      IkSolver solver(start_system);
      solver.solve(problem.theta_r_default);
      const ToolChain& chain = start_system->chain();
      Six<double> known{};
      for (std::size_t i = 0; i < 6; ++i) {
        known[i] = problem.guess_q[problem.dependent[i]];
      }
      double nearest = kInfinity;
      for (int i = 0; i < solver.count(); ++i) {
        nearest = std::min(nearest, apart(chain, solver.y(i), known));
      }
      EXPECT_LT(nearest, 1e-6);
      expect_complete(problem, 10, 20, -1);
    }
  }
}

TEST(IkSolver, OfAPublishedArmOnWheelsAreAll) {
  Random random(5);
  for (int sample = 0; sample < samples(6); ++sample) {
    const Problem problem = published_arm(kKinovaGen3Six, {0, 1, 5}, {0, 1, 4}, random);
    EXPECT_EQ(IkStartSystem(problem).solutions(), 4);
    expect_complete(problem, 10, 20, -1);
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
  EXPECT_TRUE(problem.start_system->supports(problem));
  EXPECT_EQ(serving_start_system(problem), problem.start_system);
  problem.pose.p.x() += 0.01;
  EXPECT_FALSE(problem.start_system->supports(problem));
  EXPECT_NE(serving_start_system(problem), problem.start_system);
  problem = load_problem("mobile/push");
  problem.robot.joints[static_cast<std::size_t>(problem.dependent[0])].placement.p.z() += 0.01;
  EXPECT_FALSE(problem.start_system->supports(problem));
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
