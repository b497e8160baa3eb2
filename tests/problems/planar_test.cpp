#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

constexpr double kDegree = std::numbers::pi / 180;

TEST(PlanarForce, IsShipped) {
  EXPECT_THAT(shipped_problems(), testing::Contains("planar/force"));
  const fs::path folder = fs::path(MAXWRENCH_SOURCE_DIR) / "problems/planar";
  EXPECT_TRUE(is_task(folder / "force.toml"));
  EXPECT_FALSE(is_task(folder / "vehicle.toml"));
  const std::string path = (folder / "force.toml").string();
  EXPECT_EQ(load_problem(path).name, path);
}

TEST(PlanarForce, RobotIsAsDescribed) {
  const Robot robot = load_problem("planar/force").robot;
  EXPECT_THAT(robot.base_axes, ElementsAre(0, 1, 5));
  ASSERT_EQ(robot.joints.size(), 2u);
  ASSERT_EQ(robot.links.size(), 3u);
  EXPECT_EQ(robot.links[0].name, "hull");
  EXPECT_EQ(robot.links[2].name, "link_2");
  EXPECT_EQ(robot.joints[0].name, "shoulder");
  EXPECT_TRUE(robot.joints[0].placement.p.isApprox(Eigen::Vector3d(0.3, 0.1, 0)));
  EXPECT_TRUE(robot.joints[1].placement.p.isApprox(Eigen::Vector3d(0.1, 0, 0)));
  for (const Joint& joint : robot.joints) {
    EXPECT_EQ(joint.type, JointType::kRevolute);
    EXPECT_EQ(joint.axis, Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(joint.q_min, -60 * kDegree, 1e-15);
    EXPECT_NEAR(joint.q_max, 60 * kDegree, 1e-15);
    EXPECT_EQ(joint.effort_max, 1);
  }
  ASSERT_EQ(robot.end_effectors.size(), 1u);
  EXPECT_EQ(robot.end_effectors[0].link, 2);
  EXPECT_TRUE(robot.end_effectors[0].placement.p.isApprox(Eigen::Vector3d(0.1, 0, 0)));
  ASSERT_NE(robot.collision, nullptr);
  EXPECT_EQ(robot.collision->pairs(), 1);  // hull and link 2; neighbours are ignored
}

TEST(PlanarForce, ThrustersLieOnTheDiagonals) {
  const Robot robot = load_problem("planar/force").robot;
  ASSERT_EQ(robot.thrusters.size(), 4u);
  // Left thrusters at y = 0.2, front ones at x = 0.3; lines at atan(1/4).
  const double c = std::cos(std::atan(0.25)), s = std::sin(std::atan(0.25));
  const std::vector<Eigen::Vector3d> directions = {{c, -s, 0}, {c, s, 0}, {c, s, 0}, {c, -s, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Thruster& thruster = robot.thrusters[i];
    EXPECT_TRUE(thruster.direction.isApprox(directions[i], 1e-15)) << thruster.name;
    EXPECT_EQ(thruster.position.x(), i < 2 ? 0.3 : -0.3);
    EXPECT_EQ(thruster.position.y(), i % 2 == 0 ? 0.2 : -0.2);
    EXPECT_EQ(thruster.force_min, -1);
    EXPECT_EQ(thruster.force_max, 1);
    EXPECT_EQ(thruster.force_rate_max, kInfinity);
  }
  EXPECT_EQ(robot.actuation.actuators(), 6);
  EXPECT_EQ(robot.actuation.rank, 5);
  EXPECT_EQ(robot.sources.front().first, "robot");
  EXPECT_EQ(robot.sources[1].first, "base");
}

TEST(PlanarForce, TaskIsAsDescribed) {
  const Problem problem = load_problem("planar/force");
  EXPECT_EQ(problem.name, "planar/force");
  EXPECT_EQ(problem.label, "identified");
  EXPECT_EQ(problem.end_effector, 0);
  EXPECT_EQ(problem.c, Vector6d::Unit(0));
  EXPECT_STREQ(problem.unit(), "N");
  ASSERT_EQ(problem.W_any.cols(), 3);
  EXPECT_EQ(problem.W_any.col(0), Vector6d::Unit(0));
  EXPECT_EQ(problem.W_any.col(1), Vector6d::Unit(1));
  EXPECT_EQ(problem.W_any.col(2), Vector6d::Unit(5));
  EXPECT_THAT(problem.redundant, ElementsAre(0, 1));
  EXPECT_EQ(problem.redundancy(), 2);
  EXPECT_TRUE(problem.theta_r_default.isZero());
  // The tool's x axis is 10 degrees left of c.
  EXPECT_NEAR(problem.pose.R(0, 0), std::cos(10 * kDegree), 1e-15);
  EXPECT_NEAR(problem.pose.R(1, 0), std::sin(10 * kDegree), 1e-15);
  EXPECT_TRUE(problem.pose.p.isZero());
}

}  // namespace
}  // namespace maxwrench
