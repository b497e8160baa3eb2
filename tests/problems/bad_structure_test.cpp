#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "tests/support/bad_input.h"
#include "tests/support/edited_copy.h"

namespace maxwrench {
namespace {

constexpr const char* kUrdf = "vehicle.urdf";
constexpr const char* kBox = "<box size=\"0.6 0.4 0.2\"/>";
constexpr const char* kFirstLink = "<link name=\"link_1\">";
constexpr const char* kToFirstLink = "<child link=\"link_1\"/>";
constexpr const char* kFromHull = "<parent link=\"hull\"/>";

/// What is XML, and no tree of links with one of each part.
const std::vector<ChangedProblem> kBadStructures = {
    {"entities_that_stand_for_others",
     kUrdf,
     "<robot name=\"planar_vehicle\">",
     "<!DOCTYPE robot [<!ENTITY a \"ten\"><!ENTITY b \"&a;&a;\">]><robot name=\"planar_vehicle\">",
     {"got entities that it defines itself", "a URDF without them"}},
    {"second_parent",
     kUrdf,
     kFirstLink,
     "<joint name=\"rod\" type=\"fixed\"><parent link=\"hull\"/><child link=\"link_2\"/></joint>"
     "<link name=\"link_1\">",
     {"joint[rod].child.link: got 'link_2'", "'elbow' does"}},
    {"loop_through_the_root",
     kUrdf,
     kFirstLink,
     "<joint name=\"rod\" type=\"fixed\"><parent link=\"link_2\"/><child link=\"hull\"/></joint>"
     "<link name=\"link_1\">",
     {"link: got a joint to every link", "one root"}},
    {"loop_off_the_root",
     kUrdf,
     kFromHull,
     "<parent link=\"link_2\"/>",
     {"link[link_1]: got a loop of joints", "from the root 'hull'"}},
    {"joint_from_a_link_to_itself",
     kUrdf,
     kFirstLink,
     "<link name=\"ring\"/><joint name=\"rod\" type=\"fixed\"><parent link=\"ring\"/>"
     "<child link=\"ring\"/></joint><link name=\"link_1\">",
     {"link[ring]: got a loop of joints"}},
    {"two_roots",
     kUrdf,
     kFirstLink,
     "<link name=\"buoy\"/><link name=\"link_1\">",
     {"link: got roots buoy, hull", "one root"}},
    {"no_links",
     kUrdf,
     "<robot name=\"planar_vehicle\">",
     "<robot name=\"none\"/><robot name=\"planar_vehicle\">",
     {"robot: got two", "one robot"}},
    {"link_twice",
     kUrdf,
     kFirstLink,
     "<link name=\"hull\"/><link name=\"link_1\">",
     {"link[hull]: got a duplicate name"}},
    {"joint_twice",
     kUrdf,
     "<joint name=\"elbow\"",
     "<joint name=\"shoulder\"",
     {"joint[shoulder]: got a duplicate name"}},
    {"link_without_name",
     kUrdf,
     kFirstLink,
     "<link/><link name=\"link_1\">",
     {"link.name: got nothi"}},
    {"link_of_empty_name",
     kUrdf,
     kFirstLink,
     "<link name=\"\"/><link name=\"link_1\">",
     {"line 22: link.name: got ''"}},
    {"joint_of_empty_name", kUrdf, "name=\"elbow\"", "name=\"\"", {"joint.name: got ''"}},
    {"parent_unknown",
     kUrdf,
     kFromHull,
     "<parent link=\"leg\"/>",
     {"joint[shoulder].parent.link: got 'leg', expected a link of this file"}},
    {"child_unknown",
     kUrdf,
     kToFirstLink,
     "<child link=\"leg\"/>",
     {"joint[shoulder].child.link: got 'leg', expected a link of this file"}},
    {"parent_without_link",
     kUrdf,
     kFromHull,
     "<parent/>",
     {"joint[shoulder].parent.link: got nothing"}},
    {"parent_missing", kUrdf, kFromHull, "", {"joint[shoulder].parent: got nothing"}},
    {"children_two",
     kUrdf,
     kToFirstLink,
     "<child link=\"link_1\"/><child link=\"link_2\"/>",
     {"joint[shoulder].child: got 2 elements, expected one <child>"}},
    {"axes_two",
     kUrdf,
     "<axis xyz=\"0 0 1\"/>",
     "<axis xyz=\"0 0 1\"/><axis xyz=\"0 1 0\"/>",
     {"joint[shoulder].axis: got 2 elements, expected one <axis> at most"}},
    {"masses_two",
     kUrdf,
     "<mass value=\"10\"/>",
     "<mass value=\"10\"/><mass value=\"1\"/>",
     {"link[hull].inertial.mass: got 2 elements"}},
    {"inertials_two",
     kUrdf,
     "<collision>",
     "<inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
     "izz=\"1\"/></inertial><collision>",
     {"link[hull].inertial: got 2 elements"}},
    {"geometry_of_two_shapes",
     kUrdf,
     kBox,
     "<box size=\"0.6 0.4 0.2\"/><sphere radius=\"1\"/>",
     {"link[hull].collision.geometry: got <box> and <sphere>"}},
};

class BadStructure : public testing::TestWithParam<ChangedProblem> {};

TEST_P(BadStructure, IsRejectedInOneLineThatNamesFileKeyAndValue) { expect_rejected(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Loader, BadStructure, testing::ValuesIn(kBadStructures),
                         [](const auto& test) { return std::string(test.param.name); });

std::string rejection(const std::string& urdf) {
  const EditedCopy copy;
  std::ofstream(copy.path() / "vehicle.urdf") << urdf;
  try {
    load_robot(copy.path() / "vehicle.toml");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// We call ourselves for every link of a chain.
TEST(BadStructure, ChainOfTooManyLinks) {
  std::string urdf = "<robot name='chain'><link name='0'/>";
  for (int i = 1; i < 20000; ++i) {
    const std::string name = std::to_string(i);
    urdf += "<link name='" + name + "'/><joint type='fixed' name='" + name + "'><parent link='" +
            std::to_string(i - 1) + "'/><child link='" + name + "'/></joint>";
  }
  EXPECT_THAT(rejection(urdf + "</robot>"),
              testing::EndsWith("vehicle.urdf: link: got 20000 links, expected at most 1000"));
}

TEST(BadStructure, XmlThatIsNoRobot) {
  EXPECT_THAT(rejection("<model/>"),
              testing::EndsWith("vehicle.urdf: robot: got nothing, expected an element <robot>"));
}

/// As the parser of XML does for every element within an element. Comments do not count.
TEST(BadStructure, ElementsNestedTooDeep) {
  std::string urdf = "<robot name='nest'>\n<!-- <a> '-->";
  for (int i = 0; i < 300000; ++i) urdf += "<a b='>'>";
  EXPECT_THAT(rejection(urdf),
              testing::HasSubstr("vehicle.urdf: line 2: got an element within 100"));
}

}  // namespace
}  // namespace maxwrench
