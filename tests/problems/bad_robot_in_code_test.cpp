#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <ostream>

#include "tests/support/coded_tasks.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;

struct BadRobot {
  const char* name;
  std::function<void(Robot&, Collision&)> spoil;
  const char* message;
};

void PrintTo(const BadRobot& bad, std::ostream* out) { *out << bad.name; }

const std::vector<BadRobot> kBadRobots = {
    {"axes",
     [](Robot& r, Collision&) {
       r.base_axes = {1, 5};
     },
     "base.axes: got ['y', 'yaw'], expected one of [], [x]"},
    {"axis_unknown",
     [](Robot& r, Collision&) {
       r.base_axes = {0, 1, 7};
     },
     "base.axes: got ['x', 'y', 7], expected one of"},
    {"mount_no_rotation", [](Robot& r, Collision&) { r.mount.R *= 2; }, "base.rpy: got [2, 0, 0"},
    {"mount_reflected", [](Robot& r, Collision&) { r.mount.R *= -1; }, "base.rpy: got [-1, "},
    {"mount_nan", [](Robot& r, Collision&) { r.mount.p.x() = kNan; },
     "base.xyz: got [nan, 0, 0], expected a list of 3 finite numbers"},
    {"links_missing", [](Robot& r, Collision&) { r.links.pop_back(); },
     "link: got 2 links, expected 3: the base, and one for each joint"},
    {"link_twice", [](Robot& r, Collision&) { r.links[2].name = "hull"; },
     "link[hull]: got a duplicate name, expected unique names"},
    {"link_without_name", [](Robot& r, Collision&) { r.links[2].name = ""; },
     "link.name: got '', expected a name"},
    {"mass_nan", [](Robot& r, Collision&) { r.links[1].mass = kNan; },
     "link[link_1].inertial.mass: got nan, expected a mass >= 0"},
    {"mass_infinite", [](Robot& r, Collision&) { r.links[1].mass = kInfinity; },
     "link[link_1].inertial.mass: got inf, expected a mass >= 0"},
    {"mass_negative", [](Robot& r, Collision&) { r.links[1].mass = -1; },
     "link[link_1].inertial.mass: got -1, expected a mass >= 0"},
    {"inertia_nan", [](Robot& r, Collision&) { r.links[1].inertia(0, 0) = kNan; },
     "link[link_1].inertial.inertia: got [nan, "},
    {"inertia_skew", [](Robot& r, Collision&) { r.links[1].inertia(0, 1) = 1e-6; },
     "9 finite numbers of a symmetric matrix"},
    {"com_nan", [](Robot& r, Collision&) { r.links[1].com.z() = kNan; },
     "link[link_1].inertial.origin.xyz: got [0.05, 0, nan], expected a list of 3 finite numbers"},
    {"volume_negative", [](Robot& r, Collision&) { r.links[0].volume = -1; },
     "buoyancy.hull.volume: got -1, expected a number >= 0"},
    {"added_mass_negative",
     [](Robot& r, Collision&) {
       r.links[0].hydrodynamics.resize(1);
       r.links[0].hydrodynamics[0].added_mass[2] = -1;
     },
     "hydrodynamics.hull.added_mass: got [0, 0, -1, 0, 0, 0], expected 6 numbers >= 0"},
    {"drag_in_air", [](Robot& r, Collision&) { r.links[0].hydrodynamics.resize(1); },
     "environment.water_density: got 0, expected a density > 0: 'hull' has added mass"},
    {"added_mass_of_one_link_only",
     [](Robot& r, Collision&) {
       r.water_density = 1000;
       r.links[0].hydrodynamics.resize(1);
       r.links[1].volume = 0.001;
     },
     "hydrodynamics.link_1: got nothing, expected added mass and drag, perhaps zeros"},
    {"joint_twice", [](Robot& r, Collision&) { r.joints[1].name = "shoulder"; },
     "joint[shoulder]: got a duplicate name"},
    {"parent_of_itself", [](Robot& r, Collision&) { r.joints[1].parent = 2; },
     "joint[elbow].parent: got 2, expected an earlier link than the joint's own, which is 2"},
    {"parent_negative", [](Robot& r, Collision&) { r.joints[0].parent = -1; },
     "joint[shoulder].parent: got -1, expected an earlier link"},
    {"joint_axis_zero", [](Robot& r, Collision&) { r.joints[0].axis.setZero(); },
     "joint[shoulder].axis.xyz: got [0, 0, 0], expected a direction of nonzero length"},
    {"joint_frame", [](Robot& r, Collision&) { r.joints[0].placement.R(0, 0) = 2; },
     "joint[shoulder].origin.rpy: got [2, "},
    {"limits_crossed", [](Robot& r, Collision&) { r.joints[0].q_min = 2; },
     "joint[shoulder].limit.lower: got 2, expected at most upper = 1.04"},
    {"limits_missing", [](Robot& r, Collision&) { r.joints[0].q_max = kInfinity; },
     "joint[shoulder].limit.upper: got inf, expected a finite number"},
    {"effort_negative", [](Robot& r, Collision&) { r.joints[0].effort_max = -1; },
     "joint[shoulder].limit.effort: got -1, expected a number >= 0"},
    {"velocity_zero", [](Robot& r, Collision&) { r.joints[0].velocity_max = 0; },
     "joint[shoulder].limit.velocity: got 0, expected a number > 0"},
    {"thruster_as_joint", [](Robot& r, Collision&) { r.thrusters[1].name = "elbow"; },
     "thrusters.list[1].name: got 'elbow', expected a unique name"},
    {"thruster_without_direction", [](Robot& r, Collision&) { r.thrusters[0].direction.setZero(); },
     "thrusters.list[0].direction: got [0, 0, 0], expected a direction of nonzero length"},
    {"thruster_position_nan", [](Robot& r, Collision&) { r.thrusters[0].position.y() = kNan; },
     "thrusters.list[0].position: got [0.3, nan, 0], expected a list of 3 finite numbers"},
    {"thruster_limits_crossed", [](Robot& r, Collision&) { r.thrusters[2].force_max = -5; },
     "thrusters.list[2].force_max: got -5, expected at least force_min = -1"},
    {"thruster_limit_infinite", [](Robot& r, Collision&) { r.thrusters[2].force_max = kInfinity; },
     "thrusters.list[2].force_max: got inf, expected a finite number"},
    {"thruster_rate_zero", [](Robot& r, Collision&) { r.thrusters[2].force_rate_max = 0; },
     "thrusters.list[2].force_rate_max: got 0, expected a number > 0"},
    {"end_effector_link", [](Robot& r, Collision&) { r.end_effectors[0].link = 3; },
     "end_effectors.tool.link: got 3, expected a link: 0 to 2"},
    {"gravity_negative", [](Robot& r, Collision&) { r.gravity = -9.81; },
     "environment.gravity: got -9.81, expected a number >= 0"},
    {"trim_nan", [](Robot& r, Collision&) { r.trim.buoyancy_mass = kNan; },
     "trim.buoyancy_mass: got nan, expected a finite number"},
    {"shape_link", [](Robot&, Collision& c) { c.shapes[0].link = 3; },
     "collision.link: got 3, expected a link: 0 to 2"},
    {"shape_flat", [](Robot&, Collision& c) { c.shapes[0].half_sizes.z() = 0; },
     "link[hull].collision.geometry.box.size: got 0, expected a length > 0"},
    {"shape_thin", [](Robot&, Collision& c) { c.shapes[1].radius = 0; },
     "link[link_1].collision.geometry.capsule.radius: got 0, expected a length > 0"},
    {"shape_nan", [](Robot&, Collision& c) { c.shapes[1].half_length = kNan; },
     "link[link_1].collision.geometry.capsule.length: got nan, expected a finite number"},
    {"ignore_unknown", [](Robot&, Collision& c) { c.ignore[0].first = "arm"; },
     "collision.ignore: got 'arm', expected a link: hull, link_1, link_2"},
    {"margin_negative", [](Robot&, Collision& c) { c.margin = -1; },
     "collision.margin: got -1, expected a number >= 0"},
};

class BadRobotInCode : public testing::TestWithParam<BadRobot> {};

TEST_P(BadRobotInCode, IsRejected) {
  Robot robot = vehicle();
  Collision collision = vehicle_shapes();
  GetParam().spoil(robot, collision);
  EXPECT_THAT(rejection_of([&] { finalize(robot, collision); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(InCode, BadRobotInCode, testing::ValuesIn(kBadRobots),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace maxwrench
