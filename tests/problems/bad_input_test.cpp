#include "tests/support/bad_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "tests/support/edited_copy.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

const std::vector<ChangedProblem> kBadInputs = {
    // Robot TOML.
    {"syntax", "vehicle.toml", "[base]", "[base", {"line 6", "'[base'", "valid TOML"}},
    {"unknown_key", "vehicle.toml", "margin", "margn", {"collision.margn", "margin, ignore"}},
    {"unknown_root_key", "vehicle.toml", "name = \"pl", "nam = \"pl", {": nam:", "name, urdf"}},
    {"unknown_thruster_key", "vehicle.toml", "direction", "dir", {"thrusters.list[0].dir"}},
    {"unknown_end_effector_key", "vehicle.toml", "xyz", "xy", {"end_effectors.tool.xy", "xyz"}},
    {"missing_name", "vehicle.toml", "name = \"planar vehicle\"", "", {": name: got nothing"}},
    {"empty_name", "vehicle.toml", "\"planar vehicle\"", "\"\"", {": name: got ''"}},
    {"number_for_text", "vehicle.toml", "\"planar vehicle\"", "3", {": name: got 3", "a string"}},
    {"source_is_a_list",
     "vehicle.toml",
     "source = \"hull as a box, thin links\"",
     "source = [\"a\"]",
     {"collision.source", "a string"}},
    {"missing_urdf", "vehicle.toml", "vehicle.urdf", "boat.urdf", {": urdf: got", "boat.urdf"}},
    {"rejected_axes", "vehicle.toml", "\"y\", \"yaw\"", "\"yaw\"", {"base.axes", "[x,y,yaw]"}},
    {"unknown_axis", "vehicle.toml", "\"yaw\"", "\"heading\"", {"base.axes", "heading", "yaw"}},
    {"axis_twice", "vehicle.toml", "\"x\", \"y\"", "\"x\", \"x\"", {"base.axes", "x"}},
    {"axes_not_a_list",
     "vehicle.toml",
     "[\"x\", \"y\", \"yaw\"]",
     "\"x\"",
     {"base.axes: got 'x'", "a list of strings"}},
    {"base_not_a_table", "vehicle.toml", "[base]", "[[base]]", {": base: got", "a table"}},
    {"base_not_the_root",
     "vehicle.toml",
     "[base]",
     "[base]\nlink = \"link_1\"",
     {"base.link: got 'link_1'", "'hull'"}},
    {"negative_gravity",
     "vehicle.toml",
     "9.81",
     "-9.81",
     {"environment.gravity: got -9.81, expected"}},
    {"thruster_nan",
     "vehicle.toml",
     "force_max = 1.0",
     "force_max = nan",
     {"thrusters.force_max: got nan", "a finite number"}},
    {"thruster_infinite",
     "vehicle.toml",
     "force_max = 1.0",
     "force_max = inf",
     {"thrusters.force_max: got inf"}},
    {"thruster_min_above_max",
     "vehicle.toml",
     "force_min = -1.0",
     "force_min = 2",
     {"thrusters.force_max: got 1", "at least force_min = 2"}},
    {"thruster_own_max_below_min",
     "vehicle.toml",
     "direction = [4, 1, 0]",
     "direction = [4, 1, 0]\nforce_max = -5",
     {"thrusters.list[1].force_max: got -5", "at least force_min = -1"}},
    {"thruster_named_as_a_joint",
     "vehicle.toml",
     "\"front_left\"",
     "\"elbow\"",
     {"thrusters.list[0].name: got 'elbow'", "a unique name"}},
    {"thruster_without_limit",
     "vehicle.toml",
     "force_max = 1.0",
     "",
     {"thrusters.force_max: got nothing"}},
    {"thruster_rate_zero",
     "vehicle.toml",
     "force_max = 1.0",
     "force_max = 1.0\nforce_rate_max = 0",
     {"thrusters.force_rate_max: got 0"}},
    {"thruster_zero_direction",
     "vehicle.toml",
     "[4, -1, 0]",
     "[0, 0, 0]",
     {"thrusters.list[0].direction: got [0, 0, 0]", "nonzero length"}},
    {"thruster_short_position",
     "vehicle.toml",
     "[0.3, 0.2, 0]",
     "[0.3, 0.2]",
     {"thrusters.list[0].position: got [0.3, ", "3 finite numbers"}},
    {"thruster_text_in_numbers",
     "vehicle.toml",
     "[0.3, 0.2, 0]",
     "[0.3, \"a\", 0]",
     {"thrusters.list[0].position: got [0.3, ", "3 finite numbers"}},
    {"thruster_twice",
     "vehicle.toml",
     "\"front_right\"",
     "\"front_left\"",
     {"thrusters.list[1].name: got 'front_left'"}},
    {"end_effector_on_unknown_link",
     "vehicle.toml",
     "link = \"link_2\"\nxyz",
     "link = \"hand\"\nxyz",
     {"end_effectors.tool.link: got 'hand'", "hull, link_1, link_2"}},
    {"buoyancy_of_unknown_link",
     "vehicle.toml",
     "[collision]",
     "[buoyancy.float]\nvolume = 1\ncob = [0, 0, 0]\n[collision]",
     {"buoyancy.float", "link_1"}},
    {"negative_volume",
     "vehicle.toml",
     "[collision]",
     "[buoyancy.hull]\nvolume = -1\ncob = [0, 0, 0]\n[collision]",
     {"buoyancy.hull.volume: got -1"}},
    {"negative_margin",
     "vehicle.toml",
     "margin = 0.005",
     "margin = -1",
     {"collision.margin: got -1"}},
    {"ignore_unknown_link",
     "vehicle.toml",
     "[\"hull\", \"link_1\"]",
     "[\"hull\", \"arm\"]",
     {"collision.ignore: got 'arm'", "link_1"}},
    {"ignore_of_three",
     "vehicle.toml",
     "[\"hull\", \"link_1\"]",
     "[\"hull\", \"link_1\", \"a\"]",
     {"collision.ignore", "pairs"}},
    {"capsule_radius",
     "vehicle.toml",
     "radius = 0.01",
     "radius = 0",
     {"collision.capsules[0].radius: got 0"}},
    // URDF.
    {"xml_syntax",
     "vehicle.urdf",
     "<link name=\"link_2\">",
     "<link name=\"link_2\"",
     {"line", "valid XML"}},
    {"robot_of_a_later_version",
     "vehicle.urdf",
     "<robot name=\"planar_vehicle\">",
     "<robot name=\"planar_vehicle\" version=\"1.2\">",
     {"robot.version: got '1.2', expected 1.0"}},
    {"attribute_twice",
     "vehicle.urdf",
     "effort=\"1\"",
     "effort=\"1\" effort=\"2\"",
     {"line 20", "valid XML"}},
    {"joint_without_type",
     "vehicle.urdf",
     "\"shoulder\" type=\"revolute\"",
     "\"shoulder\"",
     {"joint[shoulder].type: got nothing, expected revolute"}},
    {"unknown_joint_type",
     "vehicle.urdf",
     "\"shoulder\" type=\"revolute\"",
     "\"shoulder\" type=\"rubber\"",
     {"joint[shoulder].type: got 'rubber', expected revolute"}},
    {"joint_effort_nan",
     "vehicle.urdf",
     "effort=\"1\"",
     "effort=\"nan\"",
     {"joint[shoulder].limit.effort: got 'nan'"}},
    {"joint_short_axis",
     "vehicle.urdf",
     "<axis xyz=\"0 0 1\"/>",
     "<axis xyz=\"0 1\"/>",
     {"joint[shoulder].axis.xyz: got '0 1'", "3 finite numbers"}},
    {"mass_negative",
     "vehicle.urdf",
     "<mass value=\"10\"/>",
     "<mass value=\"-10\"/>",
     {"link[hull].inertial.mass: got -10"}},
    {"mass_infinite",
     "vehicle.urdf",
     "<mass value=\"10\"/>",
     "<mass value=\"inf\"/>",
     {"link[hull].inertial.mass.value: got 'inf'"}},
    // Task.
    {"task_as_robot", "force.toml", "\"vehicle.toml\"", "\"force.toml\"", {"unknown key", "urdf"}},
    {"robot_in_place_of_task",
     "force.toml",
     "robot = \"vehicle.toml\"",
     "",
     {": robot: got nothing"}},
    {"missing_robot", "force.toml", "vehicle.toml", "boat.toml", {": robot: got 'boat.toml'"}},
    {"unknown_task_key", "force.toml", "label", "lable", {": lable:", "label"}},
    {"unknown_type",
     "force.toml",
     "\"static\"",
     "\"dynamic\"",
     {": type: got 'dynamic'", "static"}},
    {"unknown_end_effector",
     "force.toml",
     "\"tool\"",
     "\"hand\"",
     {": end_effector: got 'hand'", "tool"}},
    {"short_pose", "force.toml", "xyz = [0, 0, 0]", "xyz = [0, 0]", {"pose.xyz", "3 finite"}},
    {"short_c", "force.toml", "[1, 0, 0, 0, 0, 0]", "[1, 0, 0]", {"wrench.c", "6 finite numbers"}},
    {"zero_c",
     "force.toml",
     "[1, 0, 0, 0, 0, 0]",
     "[0, 0, 0, 0, 0, 0]",
     {"wrench.c: got [0, 0, 0, 0, 0, 0]", "nonzero length"}},
    {"c_outside_any",
     "force.toml",
     "[1, 0, 0, 0, 0, 0]",
     "[1, 0, 1, 0, 0, 0]",
     {"wrench.c: got", "any = fx, fy, tz"}},
    {"unknown_wrench_axis",
     "force.toml",
     "\"tz\"",
     "\"mz\"",
     {"wrench.any: got", "mz", "fx, fy, fz"}},
    {"wrench_axis_twice", "force.toml", "\"tz\"", "\"fx\"", {"wrench.any: got", "each once"}},
    {"joints_not_the_chain",
     "force.toml",
     "[\"shoulder\", \"elbow\"]",
     "[\"elbow\"]",
     {"theta_r.joints: got", "shoulder, elbow"}},
    {"short_default",
     "force.toml",
     "default = [0, 0]",
     "default = [0]",
     {"theta_r.default: got [0]", "2 finite numbers"}},
    {"default_beyond_limits",
     "force.toml",
     "default = [0, 0]",
     "default = [0, 2]",
     {"theta_r.default: got [0, 2]", "elbow within -1.047"}},
};

class BadInputTest : public testing::TestWithParam<ChangedProblem> {};

TEST_P(BadInputTest, IsRejectedInOneLineThatNamesFileKeyAndValue) { expect_rejected(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Loader, BadInputTest, testing::ValuesIn(kBadInputs),
                         [](const auto& test) { return std::string(test.param.name); });

std::string message_of(const std::string& problem) {
  try {
    load_problem(problem);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadProblem, UnknownNameListsTheShippedOnes) {
  EXPECT_THAT(message_of("planar/forc"), testing::StartsWith("planar/forc: problem: got"));
  EXPECT_THAT(message_of("planar/forc"), testing::HasSubstr("planar/force"));
}

TEST(BadProblem, KeyOfTooManyParts) {
  const EditedCopy copy;
  std::ofstream(copy.path() / "force.toml") << "type = 'static'\n"
                                            <<
      [] {
        std::string key = "a";
        for (int i = 0; i < 200000; ++i) key += ".a";
        return key;
      }() << " = 1\n";
  EXPECT_THAT(message_of((copy.path() / "force.toml").string()),
              testing::HasSubstr("force.toml: file: got a key of more than 1000 parts, expected"));
}

TEST(BadProblem, MissingRobotFile) {
  EXPECT_THROW(load_robot("no/such/robot.toml"), std::invalid_argument);
  EXPECT_THROW(load_robot("/"), std::invalid_argument);
}

}  // namespace

}  // namespace maxwrench
