#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

/// A value of an independent model, at the default posture.
struct ReferenceValue {
  const char* name;
  std::string wrench, tables;
  double pure, any;  ///< NaN: not known
};
void PrintTo(const ReferenceValue& reference, std::ostream* out) { *out << reference.name; }

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
const std::string kSet = "set = [[0,0,-10, 0,0,5], [0,0,-10, 0,0,-5], [10,0,0, 0,0,0]]";

const ReferenceValue kReferences[] = {
    {"both_senses", "set = [[0,0,0,0,0,1], [0,0,0,0,0,-1]]", "", 9.00000, 34.82481},
    {"four_directions", "set = [[1,0,0,0,0,0], [-1,0,0,0,0,0], [0,1,0,0,0,0], [0,-1,0,0,0,0]]", "",
     30.67224, 88.01163},
    {"disc", "ball = { axes = ['fx', 'fy'], radius = 1 }", "", 30.67224, kUnknown},
    {"cone", "c = [1,0,0,0,0,0]\nball = { axes = ['fy', 'fz'], radius = 0.36397023426620234 }", "",
     40.64043, kUnknown},
    {"loads", kSet, "", 1.80000, 6.96496},
    {"turn_with_parameters", kTurn, kParameters, 9.0000, kUnknown},
    {"lift_with_parameters", kLift, kParameters, 26.95465, kUnknown},
    {"turn_with_weak_thrusters", kTurn, std::string(kParameters) + "thrust = 0.1\n", 9.0000,
     kUnknown},
    {"lift_with_weak_thrusters", kLift, std::string(kParameters) + "thrust = 0.1\n", 23.88186,
     kUnknown},
    {"turn_in_a_current", kTurn, "[uncertainty]\ncurrent = { speed = 0.3, directions = 72 }\n",
     8.94623, kUnknown},
    {"lift_in_a_current", kLift, "[uncertainty]\ncurrent = { speed = 0.3, directions = 72 }\n",
     29.81347, kUnknown},
    {"turn_with_a_dead_thruster", kTurn, "[loss]\nany = 1\n", 9.0000, kUnknown},
    {"lift_with_a_dead_thruster", kLift, "[loss]\nany = 1\n", 14.55665, kUnknown},
    {"payload", "", "[payload]\ncom = [0.05, 0, 0.02]\nvolume_per_kg = 1.2738853503184714e-4\n",
     3.010312, kUnknown},
    {"payload_in_air", "", "[payload]\ncom = [0, 0, 0]\n", 3.050011, kUnknown},
};

class ScenarioValues : public testing::TestWithParam<ReferenceValue> {};

TEST_P(ScenarioValues, AreThoseOfTheIndependentModel) {
  const ReferenceValue& reference = GetParam();
  const Problem task = scenario_task(reference.wrench, reference.tables);
  ASSERT_FALSE(task.scenarios.empty());
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    const double expected = wrench == Wrench::kPure ? reference.pure : reference.any;
    if (std::isnan(expected)) continue;
    Options options;
    options.wrench = wrench;
    const Answer answer = evaluate(task, task.theta_r_default, options);
    ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.str();
    EXPECT_NEAR(answer.beta(), expected, 5.5e-6);
    EXPECT_TRUE(answer.residual().within(1e-9 * (1 + expected)));
    EXPECT_NEAR(answer.beta_linf, answer.beta(), 1e-9 * (1 + expected));
  }
}

INSTANTIATE_TEST_SUITE_P(All, ScenarioValues, testing::ValuesIn(kReferences),
                         [](const auto& test) { return test.param.name; });

/// The upper end of the scenario of the lost joint alone.
double end_of_loss(const std::string& wrench, const std::string& loss) {
  const Problem task = scenario_task(wrench, "[loss]\ncases = [['q1_shoulder_yaw']]\n" + loss);
  const std::vector<ScenarioEnds> ends = scenario_ends(evaluate(task, task.theta_r_default));
  EXPECT_EQ(ends.size(), 2u);
  return ends.back().high;
}

TEST(ScenarioEnds, OfALostJointAreThoseOfTheIndependentModel) {
  for (const auto& [loss, turn] :
       {std::pair("joints = 'locked'\n", 30.16518), std::pair("joints = 'limp'\n", 0.0),
        std::pair("joints = 'limp'\nfriction = 0.5\n", 0.5)}) {
    EXPECT_NEAR(end_of_loss(kTurn, loss), turn, 5.5e-6) << loss;
    EXPECT_NEAR(end_of_loss(kLift, loss), 29.92061, 5.5e-6) << loss;
  }
}

TEST(ScenarioEnds, ListIsTheValueOfItsLeastAndLargest) {
  for (const ReferenceValue& reference : kReferences) {
    const Problem task = scenario_task(reference.wrench, reference.tables);
    if (task.scenarios.count() > 100) continue;
    const Answer answer = evaluate(task, task.theta_r_default);
    double high = kInfinity, low = -kInfinity;
    for (const ScenarioEnds& each : scenario_ends(answer)) {
      EXPECT_TRUE(each.held) << each.name;
      high = std::min(high, each.high);
      low = std::max(low, each.low);
    }
    EXPECT_NEAR(answer.beta(), high, 1e-9 * (1 + high)) << reference.name;
    EXPECT_LE(low, high) << reference.name;
  }
}

/// The best values of the independent model, found by its own searches with collision.
struct Best {
  const char* name;
  std::string wrench, tables;
  double beta;
};
void PrintTo(const Best& best, std::ostream* out) { *out << best.name; }

const Best kBest[] = {
    {"both_senses", kReferences[0].wrench, "", 32.06824},
    {"four_directions", kReferences[1].wrench, "", 75.84785},
    {"disc", kReferences[2].wrench, "", 75.47647},
    {"loads", kSet, "", 5.15737},
    {"turn_with_parameters", kTurn, kParameters, 35.0743},
    {"lift_with_parameters", kLift, kParameters, 104.3809},
    {"turn_with_a_dead_thruster", kTurn, "[loss]\nany = 1\n", 19.0175},
    {"lift_with_a_dead_thruster", kLift, "[loss]\nany = 1\n", 67.6647},
    {"payload", "", kReferences[13].tables, 11.85426},
};

class SLOW_ScenarioBest : public testing::TestWithParam<Best> {};

TEST_P(SLOW_ScenarioBest, IsFoundByDefault) {
  const Best& best = GetParam();
  const Problem task = scenario_task(best.wrench, best.tables);
  const Answer answer = solve(task);
  ASSERT_EQ(answer.status, Status::kBestFound) << answer.reason.str();
  EXPECT_GT(answer.beta(), best.beta * (1 - 1e-3));
}

INSTANTIATE_TEST_SUITE_P(All, SLOW_ScenarioBest, testing::ValuesIn(kBest),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace maxwrench
