#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"

namespace maxwrench {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// The shipped arm, whose task names joint_7: whichever joint is redundant, the set of postures is
/// the same, so the optimum is too.
TEST(RedundantJoints, ChosenByTheProgramReachTheSameOptimum) {
  Problem by_hand = load_problem("fixed/push");
  TaskSpec task;
  task.robot = by_hand.robot;
  task.end_effector = "tool";
  task.pose = by_hand.pose;
  task.c = by_hand.c;
  const Problem chosen = make_problem(task);
  EXPECT_THAT(chosen.robot.notes, Contains(HasSubstr("redundant joints, without which")));
  const double beta = solve(by_hand).beta();
  EXPECT_NEAR(solve(chosen).beta(), beta, 1e-4 * beta);
}

TEST(RedundantJoints, PoseFromAPosture) {
  const Problem problem = load_problem("fixed/push");
  TaskSpec task;
  task.robot = problem.robot;
  task.end_effector = "tool";
  task.posture = {{"joint_1", 0.3}, {"joint_2", 0.4}, {"joint_4", -1.5}, {"joint_6", 0.7}};
  task.c = problem.c;
  const Problem posed = make_problem(task);
  const Posture at = PostureEvaluator(posed).evaluate(posed.theta_r_default);
  EXPECT_EQ(at.status, Status::kValid);
  EXPECT_EQ(posed.guess_q[3], -1.5);
}

/// Proofs and their check have them at rest, so postures must.
TEST(RedundantJoints, JointsBesideTheChainRestWhateverThePostureSays) {
  const Problem problem = load_problem("fixed/push");
  TaskSpec task;
  task.robot = problem.robot;
  Joint side = task.robot.joints[3];
  side.name = "side";
  side.q_min = 0.25;
  side.q_max = 2;
  Link load = task.robot.links[4];
  load.name = "load";
  task.robot.joints.push_back(side);
  task.robot.links.push_back(load);
  task.robot.parts.clear();
  task.robot.collision = nullptr;
  complete_actuation(task.robot);
  task.end_effector = "tool";
  task.posture = {
      {"joint_1", 0.3}, {"joint_2", 0.4}, {"joint_4", -1.5}, {"joint_6", 0.7}, {"side", 1.5}};
  task.c = problem.c;
  const Problem posed = make_problem(task);
  const Posture at = PostureEvaluator(posed).evaluate(posed.theta_r_default);
  EXPECT_EQ(at.status, Status::kValid);
  EXPECT_EQ(at.q[7], 0.25);  // its limit nearest to zero
  EXPECT_EQ(posed.guess_q[3], -1.5);
}

}  // namespace
}  // namespace maxwrench
