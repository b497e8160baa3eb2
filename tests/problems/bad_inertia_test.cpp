#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/bad_input.h"
#include "tests/support/edited_copy.h"

namespace maxwrench {
namespace {

constexpr const char* kHull =
    R"(<inertial>
      <mass value="10"/>
      <inertia ixx="0.15" ixy="0" ixz="0" iyy="0.32" iyz="0" izz="0.43333"/>
    </inertial>)";
constexpr const char* kLink1 =
    R"(<inertial>
      <origin xyz="0.05 0 0"/>
      <mass value="0.1"/>
      <inertia ixx="0.000005" ixy="0" ixz="0" iyy="0.0000875" iyz="0" izz="0.0000875"/>
    </inertial>)";

const std::vector<ChangedProblem> kBadInertia = {
    {"negative",
     "vehicle.urdf",
     "ixx=\"0.15\"",
     "ixx=\"-0.15\"",
     {"link[hull].inertial.inertia: got principal moments -0.15", "moments >= 0"}},
    {"triangle",
     "vehicle.urdf",
     "izz=\"0.43333\"",
     "izz=\"5\"",
     {"link[hull].inertial.inertia: got principal moments 0.15, 0.32, 5", "sum of the other two"}},
    {"moving_link_without_inertial",
     "vehicle.urdf",
     kLink1,
     "",
     {"link[link_1].inertial.mass: got 0", "a mass > 0", "because it moves"}},
    {"moving_link_of_zero_mass",
     "vehicle.urdf",
     kLink1,
     R"(<inertial><mass value="0"/>
        <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>)",
     {"link[link_1].inertial.mass: got 0", "a mass > 0"}},
    {"moving_base_without_inertial",
     "vehicle.urdf",
     kHull,
     "",
     {"link[hull].inertial.mass: got 0", "a mass > 0"}},
    {"moving_mass_point",
     "vehicle.urdf",
     R"(<inertia ixx="0.000005" ixy="0" ixz="0" iyy="0.0000875" iyz="0" izz="0.0000875"/>)",
     R"(<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>)",
     {"link[link_1].inertial.inertia: got principal moments 0, 0, 0", "moments > 0"}},
    {"moving_thin_rod",
     "vehicle.urdf",
     "ixx=\"0.000005\"",
     "ixx=\"0\"",
     {"link[link_1].inertial.inertia: got principal moments 0, 8.75e-05", "moments > 0"}},
    {"moments_without_mass",
     "vehicle.urdf",
     "<mass value=\"0.1\"/>",
     "<mass value=\"0\"/>",
     {"link[link_1].inertial.inertia: got principal moments 5e-06", "the mass is zero"}},
    {"inertia_not_positive",
     "vehicle.urdf",
     "ixy=\"0\"",
     "ixy=\"0.3\"",
     {"link[hull].inertial.inertia: got principal moments -0.07", "moments >= 0"}},
};

class BadInertiaTest : public testing::TestWithParam<ChangedProblem> {};

/// Only the equation of motion needs them.
TEST_P(BadInertiaTest, IsRejectedByATaskInTimeAlone) {
  expect_rejected(GetParam(), "planar/trajectory");
  const ChangedProblem& input = GetParam();
  EditedCopy copy;
  copy.replace(input.file, input.from, input.to);
  const Problem problem = load_problem((copy.path() / "force.toml").string());
  ASSERT_EQ(problem.robot.no_dynamics.size(), 1u);
  const DataFault& fault = problem.robot.no_dynamics[0];
  EXPECT_THAT(fault.key + ": got " + fault.got, testing::StartsWith(input.message[0]));
  EXPECT_EQ(PostureEvaluator(problem).evaluate(problem.theta_r_default).status, Status::kValid);
}

/// A plate whose moments 0.1437, 0.1437 and 0.2875 are of four digits: 0.28748 rounded up, and its
/// halves rounded down.
TEST(RoundedInertia, OfAThinPlateIsThatOfABody) {
  EditedCopy copy;
  copy.replace("vehicle.urdf",
               R"(<inertia ixx="0.15" ixy="0" ixz="0" iyy="0.32" iyz="0" izz="0.43333"/>)",
               R"(<inertia ixx="0.1437" ixy="0" ixz="0" iyy="0.1437" iyz="0" izz="0.2875"/>)");
  EXPECT_TRUE(load_problem((copy.path() / "trajectory.toml").string()).robot.no_dynamics.empty());
}

INSTANTIATE_TEST_SUITE_P(Loader, BadInertiaTest, testing::ValuesIn(kBadInertia),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace maxwrench
