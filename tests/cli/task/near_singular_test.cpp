#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/support.h"

// Values of postures in which the structure bears the wrench, not the motors.

namespace maxwrench {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Two rods of 1 m without mass turn about z by 10 N m each: the tool is at (cos a + cos ab, sin a
/// + sin ab) with ab = a + b. A force F along x loads the joints by -F (sin a + sin ab) and -F sin
/// ab.
class StretchedArm : public testing::Test {
 protected:
  StretchedArm() {
    const auto hinge = [](const std::string& name, const std::string& parent,
                          const std::string& child, const std::string& at) {
      return fmt::format(
          "<joint name='{}' type='revolute'><origin xyz='{}'/><parent link='{}'/><child "
          "link='{}'/><axis xyz='0 0 1'/><limit lower='-3' upper='3' effort='10' "
          "velocity='1'/></joint>",
          name, at, parent, child);
    };
    std::ofstream(folder_.path() / "arm.urdf")
        << "<robot name='arm'><link name='base'/><link name='rod'/><link name='fore'/>"
           "<link name='tip'/>" +
               hinge("a", "base", "rod", "0 0 0") + hinge("b", "rod", "fore", "1 0 0") +
               "<joint name='end' type='fixed'><origin xyz='1 0 0'/><parent link='fore'/>"
               "<child link='tip'/></joint></robot>";
  }
  CommandResult eval(const std::string& words) const {
    return run_maxwrench("eval arm.urdf --tool tip " + words, folder_.path());
  }
  TemporaryFolder folder_;
};

/// At a = 0.001, b = 0 the levers are 2 sin 0.001 and sin 0.001, so that beta = 10 / 0.002. Of
/// errors of 0.01 rad, a + 0.01 makes the longest lever, 2 sin 0.011; b + 0.01 only sin 0.001 + sin
/// 0.011.
TEST_F(StretchedArm, ValueNamesTheJointWhoseErrorLeavesLeast) {
  const json answer = json::parse(eval("--wrench-along x --joints a=0.001 --json").out);
  EXPECT_NEAR(answer["beta"], 5 / std::sin(0.001), 1e-6);
  const json& off = answer["near_singular"];
  EXPECT_EQ(off["joint"], "a");
  EXPECT_EQ(off["off"], 0.01);
  EXPECT_NEAR(off["beta"], 5 / std::sin(0.011), 1e-9);
  EXPECT_THAT(eval("--wrench-along x --joints a=0.001").out,
              HasSubstr(fmt::format("near singular along c: {:.5f} N if a is off by 0.01 rad\n",
                                    5 / std::sin(0.011))));
}

/// With a = 0.02 an error of a changes the lever by half: 10 / (2 sin 0.03) is more than half of
/// the value. An arm that is bent, or pushes across, is far from it.
TEST_F(StretchedArm, LeversThatAnErrorHardlyChangesAreNotNamed) {
  for (const char* words : {"--wrench-along x --joints a=0.02", "--wrench-along y --joints a=0",
                            "--wrench-along x --joints a=0.3,b=0.9"}) {
    const CommandResult result = eval(words);
    ASSERT_EQ(result.exit_status, 0) << result.err;
    EXPECT_THAT(result.out, Not(HasSubstr("near singular"))) << words;
    EXPECT_TRUE(json::parse(eval(words + std::string(" --json")).out)["near_singular"].is_null());
  }
}

/// The brakes of a parked base hold 100 kN along each axis, so sqrt 2 times that between them. The
/// arm holds 10 N m: off by 0.01 rad at a, 5 / sin 0.01 N.
TEST_F(StretchedArm, BrakesOfAParkedBaseAreNoMotors) {
  const std::string words = "--base x,y,yaw --wrench-along '1 1 0 0 0 0' --joints a=0.785398163397";
  const json answer = json::parse(eval(words + " --json").out);
  EXPECT_NEAR(answer["beta"], 1e5 * std::sqrt(2), 1);
  EXPECT_EQ(answer["near_singular"]["joint"], "a");
  EXPECT_NEAR(answer["near_singular"]["beta"], 5 / std::sin(0.01), 1e-2);
}

/// What a thruster bears is no structure: a vehicle has no such line, although its arm is
/// stretched.
TEST(NearSingular, ThrustersBearTheWrench) {
  const json answer =
      json::parse(run_maxwrench("eval planar/force --theta-r -0.8436,1.047 --json").out);
  ASSERT_TRUE(answer.contains("near_singular"));
  EXPECT_TRUE(answer["near_singular"].is_null());
}

}  // namespace
}  // namespace maxwrench
