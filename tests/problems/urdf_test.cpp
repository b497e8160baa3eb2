#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "tests/support/written_urdf.h"

namespace maxwrench {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using urdf::joint, urdf::kLimit, urdf::link, urdf::UrdfTest;

TEST_F(UrdfTest, ShapesWithoutSizeOrOfOtherKindsAreLeftOut) {
  const auto with = [](const std::string& geometry) {
    return link("base", 1, "<collision><geometry>" + geometry + "</geometry></collision>");
  };
  for (const char* geometry : {"<box size='1 1 0'/>", "<sphere radius='0'/>", "<ellipsoid/>", "",
                               "<cylinder radius='1' length='-1'/>"}) {
    const Robot robot = load(with(geometry));
    EXPECT_THAT(robot.warnings, ElementsAre(HasSubstr("link[base].collision.geometry: ")));
    EXPECT_THAT(robot.convex_bodies, IsEmpty());
  }
  EXPECT_EQ(load(with("<capsule radius='0.1' length='1'/>")).convex_bodies.size(), 1u);
  EXPECT_EQ(load(with("<box size='1 1 1'/><origin/>")).convex_bodies.size(), 1u);
}

/// A cube of 0.1 m, written in millimetres.
TEST_F(UrdfTest, AMeshInMillimetresIsSuspected) {
  std::ofstream(folder_.path() / "cube.obj")
      << "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 100 100 0\nv 0 0 100\nv 100 0 100\nv 0 100 100\n"
         "v 100 100 100\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const auto with = [](const std::string& scale) {
    return link(
        "base", 1,
        "<collision><geometry><mesh filename='cube.obj' " + scale + "/></geometry></collision>");
  };
  for (const char* meshes : {"hull", "capsules"}) {
    const std::string toml = "collision.meshes = '" + std::string(meshes) + "'\n";
    const Robot robot = load(with(""), toml);
    EXPECT_THAT(robot.warnings,
                ElementsAre(testing::ContainsRegex("^link\\[base\\]\\.collision: a shape of "
                                                   "[12][0-9][0-9] m: millimetres\\?$")));
    EXPECT_THAT(load(with("scale='0.001 0.001 0.001'"), toml).warnings, IsEmpty());
  }
}

TEST_F(UrdfTest, OfTwoInertiasTheFirstCounts) {
  const auto tensor = [](double i) {
    return "<inertia ixx='" + std::to_string(i) + "' ixy='0' ixz='0' iyy='" + std::to_string(i) +
           "' iyz='0' izz='" + std::to_string(i) + "'/>";
  };
  const Robot robot = load("<link name='base'><inertial><mass value='1'/>" + tensor(2) + tensor(3) +
                           "</inertial></link>");
  EXPECT_NEAR(robot.links[0].inertia(0, 0), 2, 1e-12);
  EXPECT_THAT(robot.warnings,
              ElementsAre("link[base].inertial.inertia: 2 elements: the first one counts"));
}

TEST_F(UrdfTest, ElementsThatAreNotReadAreCountedOnce) {
  const Robot robot = load(link("base", 1, "<visual/><glow/><glow/>") + "<gazebo/><transmission/>");
  EXPECT_THAT(robot.warnings, IsEmpty());
  EXPECT_THAT(robot.notes, ElementsAre("not read: 2 of link.glow, 1 of robot.gazebo"));
}

TEST_F(UrdfTest, ARootThatIsNotDescribedHasNoMass) {
  const Robot robot = load(link("body") + joint("mast", "world", "body"));
  EXPECT_EQ(robot.links[0].name, "world");
  EXPECT_EQ(robot.links[0].mass, 0);
  EXPECT_THAT(robot.notes, Contains(HasSubstr("link[world]: not in the file")));
}

TEST_F(UrdfTest, PairsThatTouchAreFoundUnlessTheTomlListsThem) {
  const auto ball = [](const std::string& name, double radius) {
    return link(name, 1,
                "<collision><geometry><sphere radius='" + std::to_string(radius) +
                    "'/></geometry></collision>");
  };
  // Balls 1 m apart along a chain that bends: a and c touch only where the elbow folds.
  const std::string urdf =
      ball("a", 0.3) + ball("b", 0.3) + ball("c", 0.3) + joint("shoulder", "a", "b") +
      joint("elbow", "b", "c", "<limit lower='-3' upper='3' effort='1' velocity='1'/>");
  const Robot robot = load(urdf);
  ASSERT_NE(robot.collision, nullptr);
  EXPECT_EQ(robot.collision->pairs(), 1);
  EXPECT_EQ(robot.collision->pair_name(0), "a and c");
  EXPECT_THAT(robot.notes,
              ElementsAre("collisions left out, as a joint connects them: a and b; b and c"));
  EXPECT_EQ(load(urdf, "collision.ignore = []\n").collision->pairs(), 3);
  // 2 m away a ball of 1.8 m touches one of 0.3 m.
  const Robot large = load(ball("a", 0.3) + ball("b", 0.3) + ball("c", 1.8) +
                           joint("shoulder", "a", "b") + joint("elbow", "b", "c"));
  EXPECT_EQ(large.collision, nullptr);
  EXPECT_THAT(large.notes, Contains("collisions left out, as they touch at rest: a and c"));
}

TEST_F(UrdfTest, FingersWhoseFacesMeetTouchAtRest) {
  // Cubes of 0.2 m around (1, 0, +-0.1): their faces meet in z = 0, whatever rounding says.
  const auto cube = [](const std::string& name, const std::string& z) {
    return link(name, 1,
                "<collision><origin xyz='0 0 " + z +
                    "'/><geometry><box size='0.2 0.2 0.2'/>"
                    "</geometry></collision>");
  };
  const Robot robot = load(link("hand") + cube("one", "0.1") + cube("two", "-0.1") +
                           joint("a", "hand", "one") + joint("b", "hand", "two"));
  EXPECT_EQ(robot.collision, nullptr);
  EXPECT_THAT(robot.notes, Contains("collisions left out, as they touch at rest: one and two"));
}

TEST_F(UrdfTest, SrdfGivesPairsAndNamedStates) {
  std::ofstream(folder_.path() / "r.srdf") << R"(<robot name='r'>
    <group name='arm'><joint name='arm'/></group>
    <group_state name='home' group='arm'><joint name='arm' value='0.5'/></group_state>
    <disable_collisions link1='base' link2='hand' reason='Never'/></robot>)";
  const Robot robot = load_finger(kLimit, "srdf = 'r.srdf'\n[states.fold]\nfinger = 1\n");
  EXPECT_EQ(robot.states.at("home").at("arm"), 0.5);
  EXPECT_EQ(robot.states.at("fold").at("finger"), 1);
}

TEST_F(UrdfTest, WheelsAreForcesOfTheirKinds) {
  EXPECT_THAT(load(link("base")).thrusters, IsEmpty());
  const Robot cart = load_toml(R"(
    name = "cart"
    base = { axes = ["x", "y", "yaw"] }
    [wheels]
    force = 100
    mu = 0.5
    load = 150
    [[wheels.list]]
    name = "m"
    kind = "mecanum"
    roller = 0.7853981633974483
    position = [1, 2, 0]
    [[wheels.list]]
    name = "o"
    kind = "omni"
    heading = 1.5707963267948966
    force = 60
    [[wheels.list]]
    name = "p"
    kind = "plain"
  )");
  ASSERT_EQ(cart.thrusters.size(), 4u);
  // Mecanum: the motor could press 100 / cos 45 deg = 141 N along the roller's axis; friction holds
  // 75 N. Omni: the motor's 60 N, to the side. Plain: friction again, and sideways too.
  const double s = std::sqrt(0.5);
  EXPECT_DOUBLE_EQ(cart.thrusters[0].force_max, 75);
  EXPECT_TRUE(cart.thrusters[0].direction.isApprox(Eigen::Vector3d(s, s, 0), 1e-12));
  EXPECT_DOUBLE_EQ(cart.thrusters[1].force_max, 60);
  EXPECT_TRUE(cart.thrusters[1].direction.isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_DOUBLE_EQ(cart.thrusters[2].force_max, 75);
  EXPECT_EQ(cart.thrusters[3].name, "p_side");
  EXPECT_TRUE(cart.thrusters[3].direction.isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  // The moment of the first about z: 1 s - 2 s.
  EXPECT_NEAR(cart.actuation.B(2, 0), -s, 1e-12);
}

TEST_F(UrdfTest, ThrusterStandsAtItsLink) {
  const Robot robot =
      load(link("base") + link("pod") + joint("weld", "base", "pod", "", "fixed"), "");
  (void)robot;
  const Robot boat = load_toml(R"(
    name = "boat"
    base = { axes = ["x"] }
    [thrusters]
    force_min = -1
    force_max = 2
    [[thrusters.list]]
    name = "t"
    link = "pod"
  )");
  EXPECT_EQ(boat.thrusters[0].position, Eigen::Vector3d::UnitX());
  EXPECT_EQ(boat.thrusters[0].direction, Eigen::Vector3d::UnitX());
}

/// A tetrahedron as an STL text.
std::string tetrahedron(const std::string& size) {
  std::string text = "solid t\n";
  for (const char* face :
       {"0 0 0/0 S 0/S 0 0", "0 0 0/S 0 0/0 0 S", "0 0 0/0 0 S/0 S 0", "S 0 0/0 S 0/0 0 S"}) {
    std::istringstream corners(face);
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::string corner; std::getline(corners, corner, '/');) {
      for (std::size_t at; (at = corner.find('S')) != std::string::npos;) {
        corner.replace(at, 1, size);
      }
      text += "vertex " + corner + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

constexpr const char* kMesh =
    "<collision><geometry><mesh filename='t.stl'/></geometry></collision>";

TEST_F(UrdfTest, AMeshMayBeMirrored) {
  std::ofstream(folder_.path() / "t.stl") << tetrahedron("1");
  const Robot robot =
      load(link("a", 1,
                "<collision><geometry><mesh filename='t.stl' scale='1 1 -2'/></geometry>"
                "</collision>") +
           link("b") + joint("j", "a", "b"));
  ASSERT_EQ(robot.convex_bodies.size(), 1u);
  double lowest = 0, highest = 0;
  for (const Eigen::Vector3d& x : robot.convex_bodies[0].points) {
    lowest = std::min(lowest, x.z());
    highest = std::max(highest, x.z());
  }
  EXPECT_EQ(lowest, -2);
  EXPECT_EQ(highest, 0);
  EXPECT_THAT(robot.notes, Contains(HasSubstr("hull of 4 vertices, mirrored by its scale")));
}

TEST_F(UrdfTest, MeshesBecomeWhatTheTomlSays) {
  std::ofstream(folder_.path() / "t.stl") << tetrahedron("1");
  const std::string two = link("a", 1, kMesh) + link("b", 1, kMesh) + joint("j", "a", "b");
  const Robot hulls = load(two);
  ASSERT_EQ(hulls.convex_bodies.size(), 2u);
  EXPECT_EQ(hulls.convex_bodies[0].points.size(), 4u);
  EXPECT_THAT(hulls.notes, Contains(HasSubstr("t.stl: hull of 4 vertices")));
  // Each mesh is a file of the robot once.
  EXPECT_THAT(hulls.files,
              ElementsAre(testing::EndsWith("robot.toml"), testing::EndsWith("robot.urdf"),
                          testing::EndsWith("t.stl")));
  const Robot capsules = load(two, "collision.meshes = 'capsules'\n");
  EXPECT_EQ(capsules.convex_bodies[0].points.size(), 2u);
  EXPECT_EQ(load(two, "links.a.meshes = 'ignore'\n").convex_bodies.size(), 1u);
  EXPECT_THAT(rejection(two, "collision.meshes = 'ball'\n"), HasSubstr("'hull', 'capsules'"));
}

TEST_F(UrdfTest, AMeshThatIsMissingIsAWarningThatNamesThePathsTried) {
  const Robot robot = load(link("a", 1, kMesh));
  EXPECT_THAT(robot.convex_bodies, IsEmpty());
  EXPECT_THAT(robot.warnings, ElementsAre(testing::AllOf(
                                  HasSubstr("link[a].collision.geometry: t.stl: not found; tried "),
                                  HasSubstr((folder_.path() / "t.stl").string()))));
}

TEST_F(UrdfTest, TheDigestOfATaskIsOfItsMeshesSrdfAndWordsToo) {
  std::ofstream(folder_.path() / "t.stl") << tetrahedron("1");
  std::ofstream(folder_.path() / "r.srdf") << "<robot name='r'/>";
  load(link("a", 1, kMesh) + link("b") + joint("j", "a", "b"));
  const auto digest = [&](const std::string& srdf, double z, int axis) {
    TaskSpec task;
    task.posture = {{"j", z}};
    task.c = Vector6d::Unit(axis);
    const UrdfOptions options{.tool = "b", .srdf = srdf};
    return make_urdf_problem(folder_.path() / "robot.urdf", options, task).digest;
  };
  const std::string srdf = (folder_.path() / "r.srdf").string();
  std::set<std::string> seen = {digest("", 0.1, 4)};
  EXPECT_EQ(digest("", 0.1, 4), *seen.begin());
  const auto is_new = [&](const std::string& each) { return seen.insert(each).second; };
  EXPECT_TRUE(is_new(digest("", 0.2, 4)));
  EXPECT_TRUE(is_new(digest(srdf, 0.1, 4)));
  std::ofstream(srdf) << "<robot name='s'/>";
  EXPECT_TRUE(is_new(digest(srdf, 0.1, 4)));
  std::ofstream(folder_.path() / "t.stl") << tetrahedron("2");
  EXPECT_TRUE(is_new(digest("", 0.1, 4)));
}

TEST_F(UrdfTest, NamedLimitsAreOfMotorsOnly) {
  const std::string arms = link("base") + link("t") + link("a") + link("b") +
                           joint("arm", "base", "t") + joint("lead", "base", "a") +
                           joint("follow", "base", "b", "<mimic joint='lead'/>");
  load(arms);
  const std::string parked = "name = 'r'\nbase = { axes = ['x'], parked = true }\n";
  std::ofstream(folder_.path() / "robot.toml")
      << "urdf = 'robot.urdf'\n" + parked + "limits.low = { arm = 1 }\n";
  const Robot low = load_robot(folder_.path() / "robot.toml", {"low"});
  EXPECT_EQ(low.joints[0].effort_max, 1);
  EXPECT_EQ(low.joints[1].effort_max, 5);
  // Brakes are no thrusters that a number limits.
  EXPECT_THAT(rejection(arms, "limits.low.thrusters = 1\n"), HasSubstr("limits.low.thrusters"));
  EXPECT_THAT(rejection(arms, "limits.low.follow = 1\n"),
              HasSubstr("expected a thruster or a joint with a motor: arm, lead"));
}

}  // namespace
}  // namespace maxwrench
