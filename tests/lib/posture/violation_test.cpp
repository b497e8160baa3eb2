#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/edited_copy.h"

namespace maxwrench {
namespace {

/// A planar problem with one passage changed.
Problem edited(const std::string& task, const std::string& file, const std::string& from,
               const std::string& to) {
  EditedCopy copy;
  copy.replace(file, from, to);
  return load_problem((copy.path() / (task + ".toml")).string());
}

std::string violation_at(const Problem& problem, const Eigen::VectorXd& theta_r) {
  PostureEvaluator model(problem);
  return describe_violation(problem, model.evaluate(theta_r));
}

TEST(Violation, OfAValidPostureIsEmpty) {
  EXPECT_EQ(violation_at(load_problem("planar/force"), Eigen::Vector2d(0, 0)), "");
}

TEST(Violation, NamesTheJointAndItsLimits) {
  const Problem problem = edited("force", "vehicle.urdf",
                                 "<child link=\"link_2\"/>\n    <origin xyz=\"0.1 0 0\"/>\n"
                                 "    <axis xyz=\"0 0 1\"/>\n    <limit lower=\"-1.04719755119659"
                                 "76\" upper=\"1.0471975511965976\"",
                                 "<child link=\"link_2\"/>\n    <origin xyz=\"0.1 0 0\"/>\n"
                                 "    <axis xyz=\"0 0 1\"/>\n    <limit lower=\"-1\" upper=\"1\"");
  EXPECT_EQ(violation_at(problem, Eigen::Vector2d(0, 1.95)),
            "joint limit: elbow at 1.95 rad, limits -1 .. 1");
}

/// Where all postures of a theta_r leave the limits of the dependent joints, one of them is named.
TEST(Violation, NamesTheDependentJoint) {
  Problem problem = load_problem("mobile/push");
  Joint& elbow = problem.robot.joints[static_cast<std::size_t>(problem.dependent[0])];
  elbow.q_min = -0.1;  // which the others rarely allow
  elbow.q_max = 0.1;
  PostureEvaluator model(problem);
  Random random(1);
  int seen = 0;
  for (int sample = 0; sample < 100; ++sample) {
    const Posture& posture = model.evaluate(random_theta_r(problem, random));
    if (posture.violation != Violation::kDependentJoint) continue;
    ++seen;
    const std::string text = describe_violation(problem, posture);
    std::array<char, 20> name{};
    double at = 0, low = 0, high = 0;
    ASSERT_EQ(std::sscanf(text.c_str(),
                          "joint limit of a dependent joint: %19s at %lf rad, limits %lf .. %lf",
                          name.data(), &at, &low, &high),
              4)
        << text;
    EXPECT_TRUE(at < low || at > high) << text;
    EXPECT_EQ(posture.ik_solutions.found, posture.ik_solutions.beyond_limit);
  }
  EXPECT_GT(seen, 10);
}

TEST(Violation, NamesTheRegraspCoordinate) {
  EXPECT_EQ(violation_at(load_problem("planar/two_arms"), Eigen::Vector3d(0, 0, 0.5)),
            "regrasp coordinate beyond its limits: regrasp_1 at 0.5 m, limits -0.12 .. 0.12");
}

/// Folded as far as the second arm has to be here, its elbow is beyond 120 degrees.
TEST(Violation, NamesTheJointOfTheSecondArm) {
  const std::string text =
      violation_at(load_problem("planar/two_arms"), Eigen::Vector3d(-1, 0, 0.1));
  EXPECT_TRUE(text.starts_with("joint limit of the second arm: elbow_2 at ")) << text;
  EXPECT_TRUE(text.ends_with(" rad, limits -2.0944 .. 2.0944")) << text;
}

/// The tool is 0.4 m above the plane in which the vehicle floats.
TEST(Violation, SaysWhereTheBaseWouldHaveToGo) {
  const Problem problem = edited("force", "force.toml", "xyz = [0, 0, 0]", "xyz = [0, 0, 0.4]");
  EXPECT_EQ(violation_at(problem, Eigen::Vector2d(0, 0)),
            "unreachable pose: the base would leave its free axes: it would be 0.4 m along z from "
            "its mount");
}

/// A hull that reaches over both links, of which the first is its neighbour and does not count.
TEST(Violation, NamesThePairThatCollides) {
  const Problem problem = edited("force", "vehicle.urdf", "0.6 0.4 0.2", "1 0.4 0.2");
  EXPECT_EQ(violation_at(problem, Eigen::Vector2d(0, 0)), "self-collision: hull and link_2");
}

}  // namespace
}  // namespace maxwrench
