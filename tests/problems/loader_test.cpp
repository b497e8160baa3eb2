#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

/// A link of 1 kg.
std::string solid(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='1'/>"
         "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
}

/// A folder of its own for each test, removed with it.
class LoaderTest : public testing::Test {
 protected:
  LoaderTest() {
    std::string name = (fs::temp_directory_path() / "maxwrench_loader_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~LoaderTest() override { fs::remove_all(folder_); }

  Robot load(const std::string& urdf, const std::string& toml) {
    write(folder_ / "robot.urdf", "<robot name='r'>" + urdf + "</robot>");
    write(folder_ / "robot.toml", "name = 'r'\nurdf = 'robot.urdf'\n" + toml);
    return load_robot(folder_ / "robot.toml");
  }

  fs::path folder_;
};

TEST_F(LoaderTest, TasksOfAFolderAreListedEvenIfTheyAreBroken) {
  fs::create_directories(folder_ / "family");
  write(folder_ / "family/robot.toml", "name = 'r'\nurdf = 'robot.urdf'\n");
  write(folder_ / "family/state.toml", "[theta]\nrobot = 'a joint of this name'\n");
  write(folder_ / "family/task.toml", "type = 'static'\n robot = 'robot.toml'\n");
  write(folder_ / "broken.toml", "robot = 'robot.toml'\n[pose\n");
  EXPECT_THAT(tasks_in(folder_), ElementsAre("broken", "family/task"));
  EXPECT_THAT(tasks_in(folder_ / "none"), testing::IsEmpty());
  EXPECT_TRUE(is_task(folder_ / "broken.toml"));
  EXPECT_THROW(load_problem((folder_ / "broken.toml").string()), std::invalid_argument);
  EXPECT_THROW(is_task(folder_ / "none.toml"), std::invalid_argument);
}

constexpr const char* kTwoBodies = R"(
  <link name='arm'><inertial><origin xyz='1 0 0'/><mass value='3'/>
    <inertia ixx='1' ixy='0' ixz='0' iyy='2' iyz='0' izz='2'/></inertial></link>
  <link name='tank'><inertial><mass value='1'/>
    <inertia ixx='1' ixy='0' ixz='0' iyy='2' iyz='0' izz='2.5'/></inertial></link>
  <joint name='weld' type='fixed'><parent link='arm'/><child link='tank'/>
    <origin xyz='1 4 0' rpy='0 0 1.5707963267948966'/></joint>)";

TEST_F(LoaderTest, FixedLinksAreMergedIntoTheirCarrier) {
  const Robot robot = load(kTwoBodies, R"(
    base = { axes = [] }
    [buoyancy]
    arm = { volume = 0.1, cob = [0, 0, 0] }
    tank = { volume = 0.3, cob = [2, 0, 0] }
    [end_effectors]
    valve = { link = "tank", xyz = [1, 0, 0], rpy = [0.5, 0, 0] }
  )");
  ASSERT_EQ(robot.links.size(), 1u);
  const Link& link = robot.links[0];
  EXPECT_EQ(link.mass, 4);
  // Masses 3 at (1, 0, 0) and 1 at (1, 4, 0): the common centre is at (1, 1, 0).
  EXPECT_TRUE(link.com.isApprox(Eigen::Vector3d(1, 1, 0)));
  // The tank turned by 90 degrees has (ixx, iyy, izz) = (2, 1, 2.5); the distances along y add
  // 3 * 1^2 + 1 * 3^2 = 12 to ixx and izz.
  const Eigen::Vector3d moments(1 + 2 + 12, 2 + 1, 2 + 2.5 + 12);
  EXPECT_TRUE(link.inertia.isApprox(Eigen::Matrix3d(moments.asDiagonal()), 1e-12));
  // The tank's cob (2, 0, 0) is (1, 4 + 2, 0) in axes of the arm; weights 1 : 3.
  EXPECT_DOUBLE_EQ(link.volume, 0.4);
  EXPECT_TRUE(link.cob.isApprox(Eigen::Vector3d(0.75, 4.5, 0)));
  ASSERT_EQ(robot.end_effectors.size(), 1u);
  const EndEffector& valve = robot.end_effectors[0];
  EXPECT_EQ(valve.link, 0);
  EXPECT_TRUE(valve.placement.p.isApprox(Eigen::Vector3d(1, 5, 0)));
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  EXPECT_TRUE(valve.placement.R.isApprox(R, 1e-12));
}

TEST_F(LoaderTest, HydrodynamicBodiesOnOneLinkStayApart) {
  const Robot robot = load(kTwoBodies, R"(
    base = { axes = [] }
    environment = { water_density = 998 }
    [hydrodynamics.tank]
    center = [2, 0, 0]
    added_mass = [1, 2, 3, 4, 5, 6]
    damping_linear = [0, 0, 0, 0, 0, 7]
    damping_quadratic = [8, 0, 0, 0, 0, 0]
    [hydrodynamics.arm]
    added_mass = [9, 9, 9, 0, 0, 0]
    damping_linear = [0, 0, 0, 0, 0, 0]
    damping_quadratic = [0, 0, 0, 0, 0, 0]
  )");
  ASSERT_EQ(robot.links[0].hydrodynamics.size(), 2u);
  const HydrodynamicBody &tank = robot.links[0].hydrodynamics[0],
                         &arm = robot.links[0].hydrodynamics[1];
  // The tank lies at (1, 4, 0), turned by 90 degrees: its point (2, 0, 0) is (1, 6, 0).
  EXPECT_TRUE(tank.frame.p.isApprox(Eigen::Vector3d(1, 6, 0)));
  EXPECT_TRUE(tank.frame.R.col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_THAT(tank.added_mass, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(tank.damping_linear, 7 * Vector6d::Unit(5));
  EXPECT_EQ(tank.damping_quadratic, 8 * Vector6d::Unit(0));
  EXPECT_TRUE(arm.frame.p.isZero());
  EXPECT_TRUE(arm.frame.R.isIdentity());
  EXPECT_EQ(arm.added_mass[2], 9);
}

TEST_F(LoaderTest, TrimIsOptional) {
  EXPECT_EQ(load(kTwoBodies, "base = { axes = [] }").trim.buoyancy_mass, 0);
  const Trim trim =
      load(kTwoBodies, "base = { axes = [] }\ntrim = { buoyancy_mass = -2, position = [1, 2, 3] }")
          .trim;
  EXPECT_EQ(trim.buoyancy_mass, -2);
  EXPECT_EQ(trim.position, Eigen::Vector3d(1, 2, 3));
}

/// A tree: `slide` (prismatic) and `turn` (continuous) on the root, `tip` behind a fixed bracket on
/// `turn`. Their order in the file is neither alphabetical nor depth-first.
const std::string kTree = solid("root") + solid("rail") + solid("wheel") +
                          "<link name='bracket'/>" + solid("finger") + R"(
  <joint name='turn' type='continuous'><parent link='root'/><child link='wheel'/>
    <axis xyz='0 2 0'/><limit effort='5' velocity='3'/></joint>
  <joint name='slide' type='prismatic'><parent link='root'/><child link='rail'/>
    <axis xyz='0 3 4'/><limit lower='0.1' upper='0.4' effort='7' velocity='2'/></joint>
  <joint name='hold' type='fixed'><parent link='wheel'/><child link='bracket'/>
    <origin xyz='0 0 2'/></joint>
  <joint name='tip' type='revolute'><parent link='bracket'/><child link='finger'/>
    <origin xyz='1 0 0'/><axis xyz='0 0 1'/>
    <limit lower='-1' upper='2' effort='0.5' velocity='1'/></joint>)";

TEST_F(LoaderTest, TreeIsFlattenedDepthFirstInTheOrderOfTheFile) {
  const Robot robot = load(kTree, "base = { axes = ['yaw', 'z', 'y', 'x'], link = 'root' }");
  EXPECT_THAT(robot.base_axes, ElementsAre(0, 1, 2, 5));
  ASSERT_EQ(robot.joints.size(), 3u);
  const Joint &turn = robot.joints[0], &tip = robot.joints[1], &slide = robot.joints[2];
  EXPECT_EQ(turn.name, "turn");
  EXPECT_EQ(turn.type, JointType::kRevolute);
  EXPECT_EQ(turn.axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(turn.q_min, -std::numbers::pi);
  EXPECT_EQ(turn.q_max, std::numbers::pi);
  EXPECT_EQ(turn.velocity_max, 3);
  EXPECT_EQ(tip.name, "tip");
  EXPECT_EQ(tip.parent, 1);
  EXPECT_TRUE(tip.placement.p.isApprox(Eigen::Vector3d(1, 0, 2)));  // through the bracket
  EXPECT_EQ(slide.name, "slide");
  EXPECT_EQ(slide.type, JointType::kPrismatic);
  EXPECT_EQ(slide.parent, 0);
  EXPECT_TRUE(slide.axis.isApprox(Eigen::Vector3d(0, 0.6, 0.8)));
  EXPECT_EQ(slide.q_min, 0.1);
  EXPECT_EQ(slide.effort_max, 7);
  EXPECT_EQ(robot.links[3].name, "rail");
  EXPECT_EQ(robot.collision, nullptr);
}

/// What does not move by itself needs no inertia: a fixed base, a frame on a moving link.
TEST_F(LoaderTest, MasslessFramesAreFine) {
  const Robot robot = load("<link name='root'/>" + solid("wheel") + R"(
    <link name='hub'><inertial><mass value='0'/>
      <inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/></inertial></link>
    <joint name='turn' type='continuous'><parent link='root'/><child link='hub'/>
      <axis xyz='0 1 0'/><limit effort='5' velocity='3'/></joint>
    <joint name='hold' type='fixed'><parent link='hub'/><child link='wheel'/>
      <origin xyz='0 0 2'/></joint>)",
                           "base = { axes = [] }");
  EXPECT_EQ(robot.links[0].mass, 0);
  EXPECT_EQ(robot.links[1].mass, 1);
  EXPECT_TRUE(robot.links[1].com.isApprox(Eigen::Vector3d(0, 0, 2)));
}

TEST_F(LoaderTest, ThetaRIsTheChainAndItsDefaultLiesWithinTheLimits) {
  load(kTree,
       "base = { axes = ['x', 'y', 'z', 'roll', 'pitch', 'yaw'] }\nend_effectors = { finger = { "
       "link = 'finger' }, "
       "rail = { link = 'rail' } }");
  const auto task = [&](const std::string& end_effector) {
    write(folder_ / "task.toml",
          "type = 'static'\nrobot = 'robot.toml'\nlabel = 'test'\n"
          "source = 'test'\nend_effector = '" +
              end_effector +
              "'\npose = { xyz = [1, 2, 3], rpy = [0, 0, 0] }\n"
              "wrench = { c = [0, 0, 0, 0, 3, 4] }\n");
    return load_problem((folder_ / "task.toml").string());
  };
  const Problem finger = task("finger");
  EXPECT_THAT(finger.redundant, ElementsAre(0, 1));
  EXPECT_TRUE(finger.theta_r_max.isApprox(Eigen::Vector2d(std::numbers::pi, 2)));
  EXPECT_TRUE(finger.W_any.isApprox(Eigen::MatrixXd::Identity(6, 6)));
  EXPECT_DOUBLE_EQ(finger.c[4], 0.6);
  EXPECT_DOUBLE_EQ(finger.c[5], 0.8);
  const Problem rail = task("rail");
  EXPECT_THAT(rail.redundant, ElementsAre(2));
  EXPECT_EQ(rail.theta_r_default[0], 0.1);  // zero, moved to the nearer limit
}

TEST_F(LoaderTest, BaseIsMountedWhereTheFileSays) {
  const Robot robot = load(kTree, "base = { axes = ['yaw'], xyz = [1, 2, 3], rpy = [0, 0.5, 0] }");
  EXPECT_EQ(robot.mount.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(robot.mount.R(0, 2), std::sin(0.5), 1e-15);
  EXPECT_TRUE(load(kTree, "base = { axes = [] }").mount.R.isIdentity());
}

TEST_F(LoaderTest, WhatFollowsIsReadFromTheTask) {
  load(kTree, "base = { axes = ['x'] }\nend_effectors = { finger = { link = 'finger' } }");
  // x, turn and tip move the finger in three ways: nothing is redundant, both joints follow. With
  // x = 2, turn = 0.2 about y and tip = 0 the finger is at (2, 0, 0) + Ry(0.2) (1, 0, 2).
  const auto task = [&](const std::string& z) {
    write(folder_ / "task.toml",
          "type = 'static'\nrobot = 'robot.toml'\nlabel = 'test'\nsource = 'test'\n"
          "end_effector = 'finger'\nwrench = { c = [0, 0, 1, 0, 0, 0] }\n"
          "pose = { xyz = [3.377405239431364, 0, " +
              z +
              "], rpy = [0, 0.2, 0] }\n"
              "theta_r = { joints = [], guess = { tip = 0.1 }, guess_base = { x = 1 } }\n");
    return load_problem((folder_ / "task.toml").string());
  };
  const Problem problem = task("1.761463824887422");
  EXPECT_EQ(problem.redundancy(), 0);
  EXPECT_THAT(problem.dependent, ElementsAre(0, 1));
  EXPECT_EQ(problem.guess_q[1], 0.1);
  EXPECT_EQ(problem.guess_base, Eigen::Vector4d::Unit(0));
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(Eigen::VectorXd());
  EXPECT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
  EXPECT_NEAR(posture.q[0], 0.2, 1e-12);
  EXPECT_NEAR(posture.q[1], 0, 1e-12);
  EXPECT_NEAR(posture.base.p.x(), 2, 1e-12);
  EXPECT_THROW(task("1.77"), std::invalid_argument);
}

TEST_F(LoaderTest, ThrustersOverrideTheDefaults) {
  const Robot robot = load(solid("a"), R"(
    base = { axes = ["x", "y", "z", "roll", "pitch", "yaw"] }
    [thrusters]
    force_min = -4
    force_max = 5
    force_rate_max = 50
    [[thrusters.list]]
    name = "one"
    position = [0, 0, 0]
    direction = [0, 0, 2]
    [[thrusters.list]]
    name = "two"
    position = [0, 1, 0]
    direction = [1, 0, 0]
    force_max = 6.5
    source = "data sheet"
    status = "measured"
  )");
  ASSERT_EQ(robot.thrusters.size(), 2u);
  EXPECT_EQ(robot.thrusters[0].direction, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(robot.thrusters[0].force_max, 5);
  EXPECT_EQ(robot.thrusters[1].force_min, -4);
  EXPECT_EQ(robot.thrusters[1].force_max, 6.5);
  EXPECT_EQ(robot.u_rate_max[1], 50);
  EXPECT_THAT(robot.sources,
              ElementsAre(testing::Pair("thrusters.list[1]", "data sheet [measured]")));
  EXPECT_EQ(robot.gravity, 9.81);
  EXPECT_EQ(robot.water_density, 0);
}

}  // namespace
}  // namespace maxwrench
