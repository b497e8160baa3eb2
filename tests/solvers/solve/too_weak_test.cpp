#include "solvers/solve/too_weak.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "solvers/solve/method.h"

// A search for a robot that is far too weak ends at once, and no other one does.

namespace maxwrench {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A shipped task whose motors have this share of their efforts.
Problem weakened(const std::string& name, double share) {
  Problem task = load_problem(name);
  for (Joint& joint : task.robot.joints) joint.effort_max *= share;
  complete_actuation(task.robot);
  return task;
}

TooWeak too_weak(const Problem& task) {
  return find_too_weak(task, resolve(task, with_search(task, {})));
}

/// Whether a posture of a robot with one motor for each joint bears the share s of its load with
/// some wrench x c: |s tau_d,i + x a_i| <= e_i with a = J'c is an interval of x for each joint.
bool bears(const Problem& task, const Posture& posture, double s) {
  const Eigen::VectorXd a = posture.J.transpose() * task.c;
  double low = -kInfinity, high = kInfinity;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double e = task.robot.joints[static_cast<std::size_t>(i)].effort_max;
    const double load = s * posture.tau_d[i];
    if (std::abs(a[i]) < 1e-12) {
      if (std::abs(load) > e) return false;
      continue;
    }
    const auto [from, to] = std::minmax({(-e - load) / a[i], (e - load) / a[i]});
    low = std::max(low, from);
    high = std::min(high, to);
  }
  return low <= high;
}

TEST(TooWeak, ARobotThatHoldsItselfIsSearched) {
  for (const char* name : {"fixed/push", "uvms/valve", "planar/force", "mobile/push"}) {
    const TooWeak found = too_weak(load_problem(name));
    EXPECT_THAT(found.why, IsEmpty()) << name;
  }
}

TEST(TooWeak, WithAThousandthOfItsEffortsItIsNot) {
  const Problem task = weakened("fixed/push", 1e-3);
  PostureEvaluator model(task);
  const Posture& posture = model.evaluate(task.theta_r_default);
  ASSERT_EQ(posture.status, Status::kValid);
  EXPECT_TRUE(bears(load_problem("fixed/push"), posture, 1));
  EXPECT_FALSE(bears(task, posture, 1.0 / 3));
  const Answer answer = solve(task);
  EXPECT_EQ(answer.status, Status::kNoneFound);
  EXPECT_FALSE(answer.has_value());
  EXPECT_FALSE(answer.has_posture());
  EXPECT_LE(answer.evaluations, 400);
  EXPECT_GE(answer.ik_solutions.valid(), 100);
  EXPECT_THAT(answer.reason.str(), HasSubstr("sampled postures the efforts bear at most "));
  EXPECT_THAT(answer.reason.str(), testing::ContainsRegex("; too weak is joint_[1-7]$"));
  EXPECT_EQ(answer.stopped, "the robot is far too weak");
  // The command fills in the usual search before it solves.
  Options filled;
  static_cast<Case&>(filled) = with_search(task, {});
  EXPECT_EQ(solve(task, filled).reason.str(), answer.reason.str());
}

/// What is asked for is done.
TEST(TooWeak, ABudgetOrASearchIsCarriedOut) {
  const Problem task = weakened("fixed/push", 1e-3);
  Options options;
  options.budget = 600;
  const Answer with_budget = solve(task, options);
  EXPECT_EQ(with_budget.status, Status::kNoneFound);
  EXPECT_GT(with_budget.evaluations, 400);
  EXPECT_THAT(with_budget.reason.str(), HasSubstr("no actuator efforts balance the posture"));
  options.search = "sample";
  EXPECT_EQ(solve(task, options).evaluations, 600);
}

/// Half of what is needed is no reason to give up: s is far above a third somewhere.
TEST(TooWeak, ARobotThatIsALittleTooWeakIsSearched) {
  double share = 1;
  const Problem whole = load_problem("fixed/push");
  PostureEvaluator at(whole);
  const Posture posture = at.evaluate(whole.theta_r_default);
  while (bears(weakened("fixed/push", share), posture, 1)) share *= 0.8;
  const Problem task = weakened("fixed/push", share);
  ASSERT_TRUE(bears(task, posture, 0.5));
  EXPECT_THAT(too_weak(task).why, IsEmpty());
}

TEST(TooWeak, TasksInTimeAndListsAreNeverCalledSo) {
  EXPECT_THAT(too_weak(weakened("planar/trajectory", 1e-6)).why, IsEmpty());
  EXPECT_THAT(too_weak(weakened("dual_arm/two_arms", 1e-6)).why, IsEmpty());
}

}  // namespace
}  // namespace maxwrench
