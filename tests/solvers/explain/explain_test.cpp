#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/changed_limits.h"
#include "tests/support/contacts.h"
#include "tests/support/refusals.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Explain, OfMeasuresWithoutBindingLimitsSaysWhy) {
  const Problem task = load_problem("uvms/lift");
  for (const char* measure : {"manipulability", "transmission_ratio", "least_effort",
                              "saturating_wrench", "ellipsoid_trace"}) {
    Options options;
    options.measure = measure;
    const Explanation explanation =
        explain(evaluate(task, task.theta_r_default.transpose(), options));
    EXPECT_NE(explanation.missing.find(measure), std::string::npos);
    EXPECT_TRUE(explanation.limits.empty());
    EXPECT_FALSE(explanation.best.missing.empty());
  }
}

TEST(Explain, WithoutAValueSaysWhy) {
  // Its pose is out of reach there, or it collides.
  const Problem task = load_problem("uvms/valve");
  const Answer invalid = evaluate(task, Eigen::RowVector4d::Zero());
  ASSERT_FALSE(invalid.has_value());
  // A motor that must push with 2 N or more along x, and a push along y.
  Problem gantry = make_problem(cartesian_push(Vector6d::Unit(1)));
  gantry = with_limit(with_limit(gantry, 0, LimitSide::kUpper, 3), 0, LimitSide::kLower, 2);
  const Answer infeasible = evaluate_posture(gantry, Eigen::Vector2d::Zero());
  ASSERT_EQ(infeasible.status, Status::kInfeasible);
  gantry = make_problem(cartesian_push(Vector6d::Unit(1)));
  gantry = with_limit(gantry, 1, LimitSide::kUpper, kInfinity);
  const Answer unbounded = evaluate_posture(gantry, Eigen::Vector2d::Zero());
  ASSERT_EQ(unbounded.status, Status::kUnbounded);
  for (const Answer* answer : {&invalid, &infeasible, &unbounded}) {
    const Explanation explanation = explain(*answer);
    EXPECT_EQ(explanation.missing.find("there is no value"), 0U) << explanation.missing;
    EXPECT_TRUE(std::isnan(explanation.beta));
    EXPECT_TRUE(explanation.limits.empty());
    EXPECT_FALSE(explanation.efforts.missing.empty());
    const std::string text = summary(explanation);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
}

/// Multipliers that are not those of the value are not reported.
TEST(Explain, OfAnAnswerThatDoesNotAddUpSaysSo) {
  const Problem task = load_problem("uvms/lift");
  for (const double factor : {0.9, std::numeric_limits<double>::quiet_NaN()}) {
    Answer answer = evaluate(task, task.theta_r_default.transpose());
    answer.capability.lambda *= factor;
    const Explanation explanation = explain(answer);
    EXPECT_NE(explanation.missing.find("miss the value"), std::string::npos);
    EXPECT_TRUE(explanation.limits.empty());
  }
}

TEST(Explain, RejectsBadArguments) {
  expect_rejected("answer", [] { explain(Answer()); });
  const Problem task = load_problem("planar/force");
  const Answer answer = evaluate(task, task.theta_r_default.transpose());
  for (const double share : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    expect_rejected("share", [&] { explain(answer, {share}); });
  }
}

}  // namespace
}  // namespace maxwrench
