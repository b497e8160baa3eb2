#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maxwrench/sensitivity.h"
#include "maxwrench/solve.h"
#include "tests/solvers/scenario/gradients.h"
#include "tests/support/scenario_task.h"

namespace maxwrench {
namespace {

Options with_any(const char* solver = "") {
  Options options;
  options.wrench = Wrench::kAny;
  options.solver = solver;
  options.check_collision = false;
  return options;
}

constexpr const char* kHorizontal = "ball = { axes = ['fx', 'fy'], radius = 1 }";

/// The reference value of the default posture, by an independent model: 88.01163 N.
TEST(BallAcross, HasTheReferenceValueByAllSolvers) {
  const Problem task = scenario_task(kHorizontal, "");
  for (const char* solver : {"condensed", "simplex", "clp", "glpk", "ipopt"}) {
    const Answer answer = evaluate(task, task.theta_r_default, with_any(solver));
    ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.str();
    EXPECT_NEAR(answer.beta(), 88.01163, 6e-6) << solver;
    const std::vector<ScenarioEnds> ends = scenario_ends(answer);
    ASSERT_EQ(ends.size(), 1u);
    EXPECT_NEAR(ends[0].high, answer.beta(), 1e-6);
    EXPECT_EQ(ends[0].low, 0);
    EXPECT_TRUE(ends[0].held);
  }
}

/// No direction of the ball has less, with the same components free, and the critical one has the
/// value.
TEST(BallAcross, IsTheWorstOfItsWrenches) {
  const std::string tables =
      "[uncertainty]\ntrim = 0.2\ncurrent = { speed = 0.2, directions = 3 }\n"
      "[loss]\ncases = [['front_left_vertical'], ['q2_shoulder_pitch']]\n"
      "friction = 0.3\n";
  struct Ball {
    const char* wrench;
    double radius;
    int first, second;
  };
  const Ball balls[] = {
      {"ball = { axes = ['fx', 'fy'], radius = 2 }\nhold = true", 2, 0, 1},
      {"ball = { axes = ['tx', 'tz'], radius = 0.5 }\nany = ['fx', 'tx', 'tz']", 0.5, 3, 5},
      {"ball = { axes = ['fz'], radius = 3 }", 3, 2, 2}};
  for (const auto& [wrench, radius, first, second] : balls) {
    const Problem task = scenario_task(wrench, tables);
    Random random(4);
    int values = 0;
    for (int i = 0; values < samples(10); ++i) {
      ASSERT_LT(i, 300);
      const Eigen::VectorXd theta_r = random_theta_r(task, random);
      const Answer answer = evaluate(task, theta_r, with_any());
      ASSERT_TRUE(answer.status == Status::kOptimal || answer.status == Status::kInfeasible)
          << answer.reason.str();
      if (answer.status != Status::kOptimal) continue;
      ++values;
      const double beta = answer.beta(), slack = 1e-8 * (1 + beta);
      EXPECT_NEAR(answer.capability.decides.c.norm(), radius, 1e-12);
      Problem one = task;
      one.scenarios.ball.reset();
      one.scenarios.non_negative = false;
      const auto value_along = [&](const Vector6d& c) {
        one.scenarios.wrenches[0].c = c;
        return evaluate(one, theta_r, with_any()).beta();
      };
      EXPECT_NEAR(value_along(answer.capability.decides.c), beta, slack);
      for (int k = 0; k < 16; ++k) {
        const double angle = 2 * std::numbers::pi * k / 16;
        Vector6d c = Vector6d::Zero();
        c[first] = radius * std::cos(angle);
        if (second != first) c[second] = radius * std::sin(angle);
        if (c.norm() < 1e-6) continue;
        EXPECT_GE(value_along(c), beta - slack) << wrench;
      }
    }
  }
}

/// Without a horizontal force the vehicle does not hold 60 kg.
TEST(BallAcross, IsInfeasibleIfZeroIsNotHeld) {
  const Problem task = scenario_task(std::string(kHorizontal) + "\nany = ['fx', 'fy', 'tz']",
                                     "[uncertainty]\npayload = { mass = 60 }\n");
  const Answer answer = evaluate(task, task.theta_r_default, with_any());
  EXPECT_EQ(answer.status, Status::kInfeasible);
  EXPECT_NE(answer.reason.str().find("payload"), std::string::npos) << answer.reason.str();
}

/// The direction that decides changes with the posture.
TEST(BallAcross, HasExactGradients) {
  const Problem task = scenario_task(kHorizontal, "[loss]\ncases = [['rear_left_vertical']]\n");
  Random random(8);
  expect_gradients(task, with_any(), random);
}

TEST(BallAcross, RejectsOtherBalls) {
  for (const char* wrench : {"ball = { axes = ['fx', 'fy', 'fz'], radius = 1 }",
                             "c = [1,0,0,0,0,0]\nball = { axes = ['fy', 'fz'], radius = 0.3 }"}) {
    const Problem task = scenario_task(wrench, "");
    EXPECT_THROW(evaluate(task, task.theta_r_default, with_any()), std::invalid_argument) << wrench;
  }
}

}  // namespace
}  // namespace maxwrench
