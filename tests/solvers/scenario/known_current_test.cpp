#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maxwrench/certify.h"
#include "maxwrench/solve.h"
#include "tests/support/bad_input.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

Problem in_current(const std::string& wrench, double x, double y) {
  return scenario_task(wrench, fmt::format("[environment]\ncurrent = [{}, {}, 0]\n", x, y));
}

/// The least value over the directions of a current that may come from anywhere is that of the list
/// of all of them: the reference value of 0.3 m/s and 72 directions at the default posture.
TEST(KnownCurrent, LeastOfAllDirectionsIsThatOfTheList) {
  double least = kInfinity;
  for (int k = 0; k < 72; ++k) {
    const double angle = 2 * std::numbers::pi * k / 72;
    const Problem task = in_current(kTurn, 0.3 * std::cos(angle), 0.3 * std::sin(angle));
    const Answer answer = evaluate(task, task.theta_r_default);
    EXPECT_EQ(answer.status, Status::kOptimal);
    EXPECT_TRUE(answer.residual().within(1e-9));
    least = std::min(least, answer.beta());
  }
  EXPECT_NEAR(least, 8.94623, 5e-6);
}

/// It is the case of a list with this current alone, and still water is no current at all.
TEST(KnownCurrent, IsAListOfOneCurrent) {
  const Problem task = in_current(kLift, 0.2, -0.4);
  const Problem list = scenario_task(kLift, "[uncertainty]\ncurrent.vectors = [[0.2, -0.4, 0]]\n");
  EXPECT_EQ(evaluate(task, task.theta_r_default).beta(),
            evaluate(list, list.theta_r_default).beta());
  EXPECT_TRUE(in_current(kLift, 0, 0).scenarios.empty());
}

/// The nominal task leaves out what is not known; the current is known.
TEST(KnownCurrent, StaysInTheNominalTask) {
  const Problem alone = in_current(kLift, 0.3, 0);
  const Problem unsure =
      scenario_task(kLift, std::string(kParameters) + "[environment]\ncurrent = [0.3, 0, 0]\n");
  const Problem known = nominal(unsure);
  EXPECT_EQ(known.scenarios.loads.size(), 1u);
  EXPECT_EQ(evaluate(known, known.theta_r_default).beta(),
            evaluate(alone, alone.theta_r_default).beta());
  EXPECT_LT(evaluate(unsure, unsure.theta_r_default).beta(),
            evaluate(known, known.theta_r_default).beta());
}

TEST(KnownCurrent, OfARobotIsThatOfItsTasks) {
  Problem still = load_problem("uvms/valve");
  TaskSpec spec;
  spec.robot = still.robot;
  spec.robot.current = {0.3, 0, 0};
  spec.end_effector = still.robot.end_effectors.front().name;
  spec.pose = still.pose;
  spec.c << 0, 0, 0, 0, 0, 1;
  const Problem task = make_problem(spec);
  ASSERT_EQ(task.scenarios.loads.size(), 1u);
  EXPECT_EQ(task.scenarios.loads[0][0].current, Eigen::Vector3d(0.3, 0, 0));
  spec.current = Eigen::Vector3d::Zero();  // the water of this task is still
  EXPECT_TRUE(make_problem(spec).scenarios.empty());
  spec.current = {0, 0, std::nan("")};
  EXPECT_NE(rejection_of([&] { make_problem(spec); }).find("environment.current"),
            std::string::npos);
  spec.current.reset();
  spec.motion = load_problem("uvms/valve_trajectory").motion;
  const Problem moving = make_problem(spec);
  EXPECT_TRUE(moving.scenarios.empty());
  EXPECT_EQ(moving.robot.current, Eigen::Vector3d(0.3, 0, 0));
  spec.current = Eigen::Vector3d(0, 0.1, 0);
  EXPECT_EQ(make_problem(spec).robot.current, *spec.current);
}

const std::vector<ChangedProblem> kBadCurrents = {
    {"too_fast",
     "valve.toml",
     "[theta_r]",
     "[environment]\ncurrent = [1e300, 0, 0]\n\n[theta_r]",
     {"environment.current: got [1e+300, 0, 0]", "at most 100 m/s"}},
    {"beside_another",
     "valve.toml",
     "[theta_r]",
     "[environment]\ncurrent = [0.1, 0, 0]\n[uncertainty]\ncurrent.speed = 0.1\n\n[theta_r]",
     {"environment.current: got [0.1, 0, 0]", "zero beside uncertainty.current"}},
    {"of_two",
     "valve.toml",
     "[theta_r]",
     "[environment]\ncurrent = [1, 0]\n\n[theta_r]",
     {"environment.current: got [1, 0]"}},
    {"gravity_of_a_task",
     "valve.toml",
     "[theta_r]",
     "[environment]\ngravity = 9\n\n[theta_r]",
     {"environment.gravity: got an unknown key"}},
};

const ChangedProblem kMomentOfPayload = {
    "moment_of_payload",
    "lift.toml",
    "[wrench]\nc = [0, 0, 1, 0, 0, 0]",
    "[payload]\ncom = [0, 0, 0]\nadded_mass_per_kg = [0, 0, 0.1, 0, 0, 0]\n[environment]\ncurrent "
    "= [0.1, 0, 0]\n",
    {"payload.added_mass_per_kg: got [0, 0, 0.1, 0, 0, 0]", "the same along all axes"}};

TEST(KnownCurrent, RejectsThatItTurnsAPayloadAtRest) {
  expect_rejected(kMomentOfPayload, "uvms/lift");
}

class BadCurrents : public testing::TestWithParam<ChangedProblem> {};
INSTANTIATE_TEST_SUITE_P(All, BadCurrents, testing::ValuesIn(kBadCurrents),
                         [](const auto& each) { return std::string(each.param.name); });
TEST_P(BadCurrents, IsRejected) { expect_rejected(GetParam(), "uvms/valve"); }

TEST(KnownCurrent, IsRejectedInAir) {
  expect_rejected({"in_air",
                   "arm.toml",
                   "[environment]",
                   "[environment]\ncurrent = [0.1, 0, 0]",
                   {"environment.current: got [0.1, 0, 0]", "unless the robot has hydrodynamics"}},
                  "fixed/push");
}

}  // namespace
}  // namespace maxwrench
