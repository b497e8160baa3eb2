#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

State load(const std::string& problem, const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "state.toml") << text;
  return load_state(folder.path() / "state.toml", load_problem(problem).robot);
}

TEST(State, IsRead) {
  const State state = load("planar/force",
                           "velocity = [1, 2, 3, 4, 5]\n[theta]\nelbow = 0.25\nshoulder = 9\n"
                           "position = [0.5, -1, 0]\nrpy = [0, 0, 1.5707963267948966]\n");
  EXPECT_EQ(state.base.p, Eigen::Vector3d(0.5, -1, 0));
  EXPECT_TRUE(state.base.R.col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_EQ(state.q, Eigen::Vector2d(9, 0.25));  // limits bound postures, not mechanics
  EXPECT_EQ(state.velocity[4], 5);
  EXPECT_EQ(state.acceleration, Eigen::VectorXd::Zero(5));
}

/// A base on a mount stands there and nowhere else; one that moves does so along the mount's axes.
TEST(State, BaseStartsAtItsMount) {
  Robot robot = load_problem("planar/force").robot;  // x, y, yaw
  robot.mount.p = {0, 0, 0.3};
  robot.mount.R = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const TemporaryFolder folder;
  const auto read = [&](const Eigen::Vector3d& p, const char* rpy) {
    std::ofstream(folder.path() / "state.toml")
        << "[theta]\nshoulder = 0\nelbow = 0\nposition = [" << p.x() << ", " << p.y() << ", "
        << p.z() << "]\nrpy = " << rpy << "\n";
    return load_state(folder.path() / "state.toml", robot);
  };
  EXPECT_EQ(read({2, 0, 0.3}, "[0.5, 0, 0]").base.p, Eigen::Vector3d(2, 0, 0.3));
  EXPECT_THROW(read({0, 1, 0.3}, "[0.5, 0, 0]"), std::invalid_argument);  // y is tilted
  EXPECT_THROW(read({0, 0, 0}, "[0.5, 0, 0]"), std::invalid_argument);
  EXPECT_THROW(read({0, 0, 0.3}, "[0, 0, 0]"), std::invalid_argument);
}

struct BadState {
  const char* name;
  const char* from;  ///< in a good state of planar/force
  const char* to;
  std::vector<std::string> message;
};

constexpr const char* kGood =
    "velocity = [1, 2, 3, 4, 5]\nacceleration = [0, 0, 0, 0, 0]\n[theta]\n"
    "position = [0.5, -1, 0]\nrpy = [0, 0, 1]\nshoulder = 0.5\nelbow = 0.25\n";

const std::vector<BadState> kBadStates = {
    {"syntax", "[theta]", "[theta", {"line 3", "valid TOML"}},
    {"unknown_key", "velocity", "velocities", {": velocities: got", "velocity, acceleration"}},
    {"short_velocity", ", 5]", "]", {": velocity: got [1, 2, 3, 4]", "5 finite numbers"}},
    {"infinite_velocity", ", 5]", ", inf]", {": velocity: got [1, 2, 3, 4, inf]"}},
    {"long_acceleration", "[0, 0, 0, 0, 0]", "[0, 0, 0, 0, 0, 0]", {": acceleration: got"}},
    {"text_for_numbers", "[0, 0, 0, 0, 0]", "\"none\"", {": acceleration: got 'none'"}},
    {"no_theta", "[theta]", "[posture]", {": posture: got", "theta"}},
    {"no_position", "position = [0.5, -1, 0]", "", {"theta.position: got nothing"}},
    {"no_rpy", "rpy = [0, 0, 1]", "", {"theta.rpy: got nothing", "3 finite numbers"}},
    {"missing_joint", "elbow = 0.25", "", {"theta.elbow: got nothing", "a finite number"}},
    {"unknown_joint", "elbow", "wrist", {"theta.wrist", "shoulder, elbow"}},
    {"joint_nan", "0.25", "nan", {"theta.elbow: got nan", "a finite number"}},
    {"joint_text", "0.25", "\"up\"", {"theta.elbow: got 'up'", "a finite number"}},
    {"off_its_plane", "-1, 0]", "-1, 0.5]", {"theta.position: got [0.5, -1, 0.5]", "z = 0"}},
    {"rolled", "rpy = [0,", "rpy = [0.1,", {"theta.rpy: got [0.1, 0, 1]", "roll = 0"}},
};

class BadStateTest : public testing::TestWithParam<BadState> {};

TEST_P(BadStateTest, IsRejectedInOneLineThatNamesFileKeyAndValue) {
  std::string text = kGood;
  const std::size_t at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(GetParam().from).size(), GetParam().to);
  try {
    load("planar/force", text);
    ADD_FAILURE() << "was accepted";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, testing::HasSubstr("state.toml: "));
    EXPECT_THAT(message, testing::HasSubstr("expected"));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string& part : GetParam().message) {
      EXPECT_THAT(message, testing::HasSubstr(part));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Loader, BadStateTest, testing::ValuesIn(kBadStates),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(State, MissingFileIsRejected) {
  const Robot robot = load_problem("planar/force").robot;
  EXPECT_THROW(load_state("no/such/state.toml", robot), std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
