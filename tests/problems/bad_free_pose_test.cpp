#include <gtest/gtest.h>

#include "tests/support/bad_input.h"

namespace maxwrench {
namespace {

constexpr const char* kPose = "xyz = [0, 0, 0]";

/// planar/force, whose vehicle moves along x and y and about z.
const std::vector<ChangedProblem> kBadFreePoses = {
    {"free_unknown",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nfree = [\"yawn\"]",
     {"pose.free: got ['yawn']", "some of x, y, z, roll, pitch, yaw"}},
    {"free_twice",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nfree = [\"yaw\", \"yaw\"]",
     {"pose.free: got ['yaw', 'yaw']", "each once"}},
    {"free_not_a_list",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nfree = \"yaw\"",
     {"pose.free: got 'yaw'"}},
    {"translation_without_range",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nfree = [\"x\"]",
     {"pose.free: got ['x']", "pose.range.x = [min, max]"}},
    {"range_of_unknown_axis",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.u = [0, 1]",
     {"pose.range.u", "unknown key"}},
    {"range_of_the_largest_numbers",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.x = [-1e308, 1e308]",
     {"pose.range.x: got [-1e+308, 1e+308]", "at most 1e+06"}},
    {"range_of_a_number_beyond_53_bits",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.x = [0, 9007199254740993]",
     {"pose.range.x", "at most 1e+06"}},
    {"range_inverted",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.x = [1, 0]",
     {"pose.range.x: got [1, 0]", "min < max"}},
    {"range_empty",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.yaw = [1, 1]",
     {"pose.range.yaw: got [1, 1]", "min < max"}},
    {"range_of_three",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.x = [0, 1, 2]",
     {"pose.range.x: got [0, 1, 2]", "2 finite numbers"}},
    {"range_infinite",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.x = [0, inf]",
     {"pose.range.x", "finite"}},
    {"angle_beyond_a_turn",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.yaw = [-4, 4]",
     {"pose.range.yaw: got [-4, 4]", "2 pi"}},
    {"axes_unknown",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nfree = [\"yaw\"]\nframe = \"world\"",
     {"pose.frame: got 'world'", "'pose' or 'end_effector'"}},
    {"axes_of_nothing",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nframe = \"end_effector\"",
     {"pose.frame: got 'end_effector'", "without pose.free or pose.range"}},
    {"immovable_translation",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nrange.z = [-1, 1]",
     {"pose.range.z: got [-1, 1]", "the end effector can move (z is not one)"}},
    {"immovable_turn",
     "force.toml",
     kPose,
     "xyz = [0, 0, 0]\nfree = [\"roll\", \"yaw\"]",
     {"pose.free: got ['roll', 'yaw']", "the end effector can move (roll is not one)"}},
    {"frame",
     "force.toml",
     "[wrench]",
     "[wrench]\nframe = \"base\"",
     {"wrench.frame: got 'base'", "'world' or 'end_effector'"}},
};

class BadFreePose : public testing::TestWithParam<ChangedProblem> {};

INSTANTIATE_TEST_SUITE_P(All, BadFreePose, testing::ValuesIn(kBadFreePoses),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BadFreePose, IsRejected) { expect_rejected(GetParam()); }

}  // namespace
}  // namespace maxwrench
