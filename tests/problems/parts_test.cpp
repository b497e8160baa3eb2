#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <ostream>

#include "maxwrench/load.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/written_urdf.h"

namespace maxwrench {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using urdf::joint, urdf::link, urdf::UrdfTest;

std::vector<std::string> names_of_parts(const Robot& robot) {
  std::vector<std::string> names;
  for (const BodyPart& part : robot.parts) names.push_back(part.name);
  return names;
}

TEST(Parts, OfTheUvms) {
  const Robot robot = load_robot(problems_folder() / "uvms/bluerov2_alpha5.toml");
  EXPECT_THAT(names_of_parts(robot),
              ElementsAre("vehicle", "base", "link_1", "link_2", "link_3", "link_4"));
  const BodyPart& base = robot.parts[1];
  EXPECT_EQ(base.link, 0);
  EXPECT_EQ(base.mass, 0.23);
  EXPECT_EQ(base.com, Vector3d(-0.065, 0, 0));
  EXPECT_EQ(base.volume, 0.00016);
  EXPECT_EQ(base.cob, Vector3d(-0.065, 0, 0));
  EXPECT_EQ(base.frame.p, Vector3d(0.203, 0, -0.1317));
  const Vector3d turned(1, -1, -1);  // half a turn about x
  EXPECT_LT((base.frame.R - Eigen::Matrix3d(turned.asDiagonal())).norm(), 1e-15);
  EXPECT_EQ(robot.parts[0].mass, 14.5);
  EXPECT_EQ(robot.parts[0].cob, Vector3d(0.006, 0, 0.031));
  EXPECT_NEAR(robot.links[0].mass, 14.73, 1e-14);
  EXPECT_NEAR(robot.links[0].volume, 0.01447896 + 0.00016, 1e-17);
  for (std::size_t i = 2; i < 6; ++i) {
    EXPECT_EQ(robot.parts[i].link, static_cast<int>(i) - 1);
    EXPECT_EQ(robot.parts[i].mass, robot.links[i - 1].mass);
    EXPECT_EQ(robot.parts[i].com, robot.links[i - 1].com);
  }
}

/// A chain of two fixed joints, each 1 m along x, the second one turned by a quarter about z, and a
/// body that a joint moves.
TEST_F(UrdfTest, PartsOnFixedJointsKeepTheirAxes) {
  const auto body = [](const std::string& name, const std::string& mass, const std::string& at) {
    return "<link name='" + name + "'><inertial><origin xyz='" + at +
           "' rpy='0.3 0 0'/><mass value='" + mass + "'/></inertial></link>";
  };
  const Robot robot = load(
      body("hull", "4", "0 0 1") + body("deck", "2", "0.5 0 0") + body("mast", "1", "0 0.25 0") +
          body("arm", "3", "0 0 -2") + joint("f", "hull", "deck", "", "fixed") +
          "<joint name='g' type='fixed'><origin xyz='1 0 0' rpy='0 0 1.5707963267948966'/>"
          "<parent link='deck'/><child link='mast'/></joint>" +
          joint("j", "deck", "arm"),
      "buoyancy.mast = { volume = 0.001, cob = [0, 0, 0.5] }\n"
      "links.deck = { mass = 2.5, com = [0.5, 0, 0.1] }\n");
  ASSERT_THAT(names_of_parts(robot), ElementsAre("hull", "deck", "mast", "arm"));
  EXPECT_EQ(robot.parts[1].mass, 2.5);
  EXPECT_EQ(robot.parts[1].com, Vector3d(0.5, 0, 0.1));
  EXPECT_EQ(robot.parts[1].frame.p, Vector3d(1, 0, 0));
  EXPECT_EQ(robot.parts[2].com, Vector3d(0, 0.25, 0));
  EXPECT_EQ(robot.parts[2].cob, Vector3d(0, 0, 0.5));
  EXPECT_EQ(robot.parts[2].volume, 0.001);
  EXPECT_EQ(robot.parts[2].frame.p, Vector3d(2, 0, 0));
  EXPECT_LT((robot.parts[2].frame.R - yaw_turn(std::numbers::pi / 2).R).norm(), 1e-15);
  EXPECT_EQ(robot.parts[3].link, 1);
  EXPECT_LT(robot.parts[3].frame.p.norm(), 1e-15);
  EXPECT_EQ(robot.links[0].mass, 7.5);
  // 4 (0, 0, 1) + 2.5 (1.5, 0, 0.1) + 1 (1.75, 0, 0): the mast's y is -x of the hull.
  EXPECT_LT((7.5 * robot.links[0].com - Vector3d(5.5, 0, 4.25)).norm(), 1e-14);
  EXPECT_LT((robot.links[0].cob - Vector3d(2, 0, 0.5)).norm(), 1e-15);
}

/// A body changed in the file loads its link as the change of the part says: two ways to the same
/// wet mass and moment.
TEST_F(UrdfTest, AChangedPartIsAChangedLink) {
  const std::string urdf = link("hull", 4) + link("deck", 2) +
                           joint("f", "hull", "deck", "", "fixed") + link("arm", 1) +
                           joint("j", "deck", "arm");
  const std::string toml =
      "end_effectors.tool = { link = 'arm', xyz = [0, 0, 1] }\nbuoyancy.deck = { volume = 0.001, "
      "cob = [0,0.1,0] }\n"
      "environment = { water_density = 1000 }\n";
  const Robot known = load(urdf, toml + "links.deck = { com = [0.2, 0, 0] }\n");
  const Robot changed = load(urdf, toml + "links.deck = { mass = 2.3, com = [0.25, 0, 0] }\n");
  TaskSpec task{.robot = known, .end_effector = "tool"};
  task.c = along(0);
  task.posture.emplace();
  task.uncertainty.emplace().mass = {{"deck", 0.3}};
  task.uncertainty->com = {{"deck", {0.05, 0, 0}}};
  const LinkLoad load = make_problem(task).scenarios.loads.at(0).at(0).loads.at(0);
  const Link &before = known.links[0], &after = changed.links[0];
  EXPECT_EQ(load.link, 0);
  EXPECT_NEAR(load.mass, after.mass - before.mass, 1e-14);
  EXPECT_LT((load.moment - (after.mass * after.com - before.mass * before.com)).norm(), 1e-14);
}

TEST(Parts, OfARobotInCodeAreItsLinks) {
  const Robot robot = finalize(vehicle());
  EXPECT_THAT(names_of_parts(robot), ElementsAre("hull", "link_1", "link_2"));
  EXPECT_EQ(robot.parts[2].link, 2);
  EXPECT_EQ(robot.parts[2].mass, 0.1);
  EXPECT_EQ(robot.parts[2].com, Vector3d(0.05, 0, 0));
  EXPECT_TRUE(robot.parts[2].frame.R.isIdentity(0));
  EXPECT_EQ(finalize(robot).parts.size(), 3u);
}

struct BadParts {
  const char* name;
  std::function<void(std::vector<BodyPart>&)> spoil;
  const char* message;
};

void PrintTo(const BadParts& bad, std::ostream* out) { *out << bad.name; }

const std::vector<BadParts> kBadParts = {
    {"mass", [](auto& p) { p[1].mass = 0.2; },
     "part.mass: got 0.2 on 'link_1', expected that of the link, 0.1, or no parts at all"},
    {"missing", [](auto& p) { p.pop_back(); }, "part.mass: got 0 on 'link_2', expected that of"},
    {"centre", [](auto& p) { p[1].com.x() = 0.06; }, "part.mass x com: got 0.006 on 'link_1'"},
    {"volume", [](auto& p) { p[1].volume = 1; }, "part.volume: got 1 on 'link_1'"},
    {"negative", [](auto& p) { p[1].mass = -1; },
     "part[link_1].mass: got -1, expected a number >="},
    {"com_nan", [](auto& p) { p[1].com.x() = kNan; }, "part[link_1].com: got [nan, 0, 0]"},
    {"cob_nan", [](auto& p) { p[1].cob.x() = kNan; }, "part[link_1].cob: got [nan, 0, 0]"},
    {"volume_nan", [](auto& p) { p[1].volume = kNan; }, "part[link_1].volume: got nan"},
    {"frame", [](auto& p) { p[1].frame.R(0, 0) = 2; }, "part[link_1].rpy: got ["},
    {"link", [](auto& p) { p[1].link = 3; }, "part[link_1].link: got 3, expected a link: 0 to 2"},
    {"unnamed", [](auto& p) { p[1].name = ""; }, "part.name: got '', expected a name"},
    {"named_twice", [](auto& p) { p[1].name = "hull"; }, "part[hull]: got a duplicate name"},
};

class BadPartsInCode : public testing::TestWithParam<BadParts> {};

TEST_P(BadPartsInCode, AreRejected) {
  Robot robot = finalize(vehicle());
  GetParam().spoil(robot.parts);
  EXPECT_THAT(rejection_of([&] { finalize(robot); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(All, BadPartsInCode, testing::ValuesIn(kBadParts),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace maxwrench
