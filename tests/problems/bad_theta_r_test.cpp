#include <gtest/gtest.h>

#include "tests/support/bad_input.h"

namespace maxwrench {
namespace {

constexpr const char* kRedundant = "joints = [\"shoulder_yaw\", \"shoulder_pitch\"]";
constexpr const char* kGuess = "guess = { elbow = 1, wrist_pitch = 0, wrist_roll = 0 }";

/// The wheeled base with an arm, whose task names two redundant joints.
const std::vector<ChangedProblem> kBadThetaRs = {
    {"joint_unknown",
     "push.toml",
     kRedundant,
     "joints = [\"shoulder_yaw\", \"sholder_pitch\"]",
     {"theta_r.joints: got ['shoulder_yaw', 'sholder_pitch']", "2 of the joints"}},
    {"joint_twice",
     "push.toml",
     kRedundant,
     "joints = [\"elbow\", \"elbow\"]",
     {"theta_r.joints: got ['elbow', 'elbow']", "each once"}},
    {"joints_too_few",
     "push.toml",
     kRedundant,
     "joints = [\"shoulder_yaw\"]",
     {"theta_r.joints: got ['shoulder_yaw']", "2 of the joints", "the other 3"}},
    {"joints_too_many",
     "push.toml",
     kRedundant,
     "joints = [\"shoulder_yaw\", \"shoulder_pitch\", \"elbow\"]",
     {"theta_r.joints: got", "2 of the joints"}},
    {"joints_are_a_number", "push.toml", kRedundant, "joints = 2", {"theta_r.joints: got 2"}},
    {"joints_do_not_fix_the_posture",
     "push.toml",
     "joints = [\"shoulder_yaw\", \"shoulder_pitch\"]\ndefault = [0, -1]\n"
     "guess = { elbow = 1, wrist_pitch = 0, wrist_roll = 0 }",
     "joints = [\"shoulder_yaw\", \"wrist_roll\"]\nguess = { shoulder_pitch = -1, elbow = 1 }",
     {"theta_r.joints: got ['shoulder_yaw', 'wrist_roll']", "singular"}},
    {"default_size",
     "push.toml",
     "default = [0, -1]",
     "default = [0]",
     {"theta_r.default: got [0]", "2 finite numbers"}},
    {"default_beyond_limits",
     "push.toml",
     "default = [0, -1]",
     "default = [0, -4]",
     {"theta_r.default: got [0, -4]", "shoulder_pitch within -2 .. 2"}},
    {"guess_not_a_table", "push.toml", kGuess, "guess = 1", {"theta_r.guess: got 1", "a table"}},
    {"guess_of_unknown_joint",
     "push.toml",
     kGuess,
     "guess = { elbw = 1 }",
     {"theta_r.guess.elbw", "elbow, wrist_pitch, wrist_roll"}},
    {"guess_of_redundant_joint",
     "push.toml",
     kGuess,
     "guess = { shoulder_yaw = 1 }",
     {"theta_r.guess.shoulder_yaw", "elbow, wrist_pitch, wrist_roll"}},
    {"guess_nan",
     "push.toml",
     kGuess,
     "guess = { elbow = nan }",
     {"theta_r.guess.elbow: got nan", "a finite number"}},
    {"guess_is_text",
     "push.toml",
     kGuess,
     "guess = { elbow = \"up\" }",
     {"theta_r.guess.elbow: got 'up'", "a finite number"}},
    {"guess_beyond_limits",
     "push.toml",
     kGuess,
     "guess = { elbow = 4 }",
     {"theta_r.guess.elbow: got 4", "within -2.6 .. 2.6"}},
    {"guess_of_an_axis_that_is_not_free",
     "push.toml",
     kGuess,
     "guess = { elbow = 1 }\nguess_base = { z = 1 }",
     {"theta_r.guess_base.z", "x, y, yaw"}},
    {"guess_of_the_base_infinite",
     "push.toml",
     kGuess,
     "guess = { elbow = 1 }\nguess_base = { yaw = inf }",
     {"theta_r.guess_base.yaw: got inf", "a finite number"}},
    {"pose_out_of_reach",
     "push.toml",
     "xyz = [0, 0, 0.9]",
     "xyz = [0, 0, 2.9]",
     {"pose.xyz: got [0, 0, 2.9]", "wrist_roll and the base reach",
      "1.6 m away along the world's z"}},
    {"joints_that_never_fix_the_rest",
     "push.toml",
     "joints = [\"shoulder_yaw\", \"shoulder_pitch\"]\ndefault = [0, -1]\nguess = { elbow = 1, "
     "wrist_pitch = 0, wrist_roll = 0 }",
     "joints = [\"elbow\", \"wrist_roll\"]",
     {"theta_r.joints", "in no posture: singular"}},
    {"base_on_short_position",
     "rover.toml",
     "axes = [\"x\", \"y\", \"yaw\"]",
     "axes = [\"x\", \"y\", \"yaw\"]\nxyz = [0, 0]",
     {"base.xyz: got [0, 0]", "3 finite numbers"}},
    {"base_on_infinite_position",
     "rover.toml",
     "axes = [\"x\", \"y\", \"yaw\"]",
     "axes = [\"x\", \"y\", \"yaw\"]\nrpy = [0, inf, 0]",
     {"base.rpy: got [0, inf, 0]", "3 finite numbers"}},
};

class BadThetaR : public testing::TestWithParam<ChangedProblem> {};

TEST_P(BadThetaR, IsRejectedInOneLineThatNamesFileKeyAndValue) {
  expect_rejected(GetParam(), "mobile/push");
}

INSTANTIATE_TEST_SUITE_P(Loader, BadThetaR, testing::ValuesIn(kBadThetaRs),
                         [](const auto& test) { return std::string(test.param.name); });

/// Where the base pose follows in closed form there is nothing to guess, and a base on all six axes
/// has no place to start from.
const std::vector<ChangedProblem> kBadClosedForm = {
    {"guess", "force.toml", "default = [0, 0]", "guess = { elbow = 1 }", {"theta_r.guess: got"}},
    {"guess_base",
     "force.toml",
     "default = [0, 0]",
     "guess_base = { x = 1 }",
     {"theta_r.guess_base: got"}},
    {"mount_of_a_free_base",
     "vehicle.toml",
     "axes = [\"x\", \"y\", \"yaw\"]",
     "axes = [\"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\"]\nxyz = [0, 0, 1]",
     {"base.xyz: got [0, 0, 1]", "all six axes"}},
};

class BadClosedForm : public testing::TestWithParam<ChangedProblem> {};

TEST_P(BadClosedForm, IsRejectedInOneLineThatNamesFileKeyAndValue) { expect_rejected(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Loader, BadClosedForm, testing::ValuesIn(kBadClosedForm),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace maxwrench
