#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/task.h"
#include "tests/support/coded_tasks.h"

// Robots and tasks that are built in code, beside those of the files that say the same.

namespace maxwrench {
namespace {

using testing::HasSubstr;

/// The two problems have equal values and gradients, for both kinds of wrench, at their default and
/// near it.
void expect_same(const Problem& coded, const Problem& loaded) {
  ASSERT_EQ(coded.redundancy(), loaded.redundancy());
  EXPECT_EQ(coded.theta_r_min, loaded.theta_r_min);
  EXPECT_EQ(coded.theta_r_max, loaded.theta_r_max);
  EXPECT_EQ(coded.theta_r_default, loaded.theta_r_default);
  EXPECT_EQ(coded.dependent, loaded.dependent);
  EXPECT_EQ(coded.guess_q, loaded.guess_q);
  EXPECT_EQ(coded.W_any, loaded.W_any);
  EXPECT_EQ(coded.digest, "");
  for (const double step : {0.0, 0.01, 0.02}) {
    const Eigen::VectorXd theta_r =
        loaded.theta_r_default + step * (loaded.theta_r_max - loaded.theta_r_default);
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      Options options;
      options.wrench = wrench;
      const Answer a = evaluate(coded, theta_r.transpose(), options);
      const Answer b = evaluate(loaded, theta_r.transpose(), options);
      ASSERT_EQ(a.status, b.status) << a.reason.c_str() << b.reason.c_str();
      EXPECT_EQ(a.status, Status::kOptimal);
      EXPECT_EQ(a.beta(), b.beta());
      EXPECT_EQ(a.trajectory.gradient, b.trajectory.gradient);
    }
  }
}

TEST(InCode, RobotAndTaskAreThoseOfTheFile) {
  Problem loaded = load_problem("planar/force");
  const Problem coded = make_problem(push());
  EXPECT_EQ(coded.robot.actuation.B, loaded.robot.actuation.B);
  EXPECT_EQ(coded.robot.u_rate_max, loaded.robot.u_rate_max);
  ASSERT_EQ(coded.robot.collision->pairs(), 1);
  EXPECT_EQ(coded.robot.collision->pair_name(0), loaded.robot.collision->pair_name(0));
  EXPECT_EQ(coded.robot.convex_bodies.size(), 3u);
  expect_same(coded, loaded);
}

/// With wider limits, so that the arm can fold into the hull.
TEST(InCode, ShapesCollideAsThoseOfTheFile) {
  Robot robot = vehicle();
  for (Joint& joint : robot.joints) joint.q_min = -3, joint.q_max = 3;
  const Problem problem = make_problem(push(finalize(robot, vehicle_shapes())));
  const Eigen::RowVector2d folded(3, 0);  // link_2 is inside the hull
  EXPECT_EQ(evaluate(problem, folded).status, Status::kInvalidPosture);
  EXPECT_THAT(std::string(evaluate(problem, folded).reason.c_str()), HasSubstr("link_2"));
  const Problem without = make_problem(push(finalize(robot)));
  EXPECT_EQ(without.robot.collision, nullptr);
  EXPECT_EQ(evaluate(without, folded).status, Status::kOptimal);
}

/// The file turns by roll, pitch and yaw, one after the other, which leaves another rounding.
TEST(InCode, JointsThatFollow) {
  const Problem loaded = load_problem("mobile/push");
  TaskSpec task{.robot = load_robot(problems_folder() / "mobile/rover.toml"),
                .end_effector = "tool"};
  task.pose = yaw_turn(0.7);
  task.pose.p = {0, 0, 0.9};
  EXPECT_LT((task.pose.R - loaded.pose.R).norm(), 1e-15);
  task.pose.R = loaded.pose.R;
  task.c = along(0);
  task.joints = {"shoulder_yaw", "shoulder_pitch"};
  task.theta_r_default = Eigen::Vector2d(0, -1);
  task.guess = {{"elbow", 1}, {"wrist_pitch", 0}, {"wrist_roll", 0}};
  expect_same(make_problem(task), loaded);
}

TEST(InCode, FreePose) {
  const Problem loaded = load_problem("mobile/push_any_height");
  TaskSpec task{.robot = loaded.robot, .end_effector = "tool"};
  task.pose = loaded.pose;
  task.c = loaded.c;
  task.joints = {"shoulder_yaw", "shoulder_pitch"};
  for (int i = 0; i < loaded.free.count(); ++i) {
    const auto at = static_cast<Eigen::Index>(loaded.redundant.size()) + i;
    const auto axis = static_cast<std::size_t>(loaded.free.axes[static_cast<std::size_t>(i)]);
    task.range[kTwistAxes[axis]] = {loaded.theta_r_min[at], loaded.theta_r_max[at]};
  }
  const Problem coded = make_problem(task);
  EXPECT_EQ(coded.free.axes, loaded.free.axes);
  EXPECT_EQ(coded.theta_r_max.tail(1), loaded.theta_r_max.tail(1));
  const Eigen::MatrixXd theta_r = loaded.theta_r_default.transpose();
  EXPECT_EQ(evaluate(coded, theta_r).beta(), evaluate(loaded, theta_r).beta());
}

/// The file turns the frame by roll and yaw of 90 degrees, which leaves a rounding of 6e-17.
TEST(InCode, SecondContact) {
  const Problem loaded = load_problem("planar/two_arms");
  TaskSpec task = push_on_wall();
  EXPECT_LT((task.contact->frame.R - loaded.contact->frame.R).norm(), 1e-15);
  task.contact->frame.R = loaded.contact->frame.R;
  const Problem coded = make_problem(task);
  ASSERT_TRUE(coded.contact.has_value());
  EXPECT_EQ(coded.contact->C, loaded.contact->C);
  EXPECT_EQ(coded.contact->w_min, loaded.contact->w_min);
  EXPECT_EQ(coded.contact->rank, loaded.contact->rank);
  EXPECT_EQ(coded.contact->follow, loaded.contact->follow);
  expect_same(coded, loaded);
}

TEST(InCode, OdeSolution) {
  const Problem coded = make_problem(push_on_the_way());
  EXPECT_EQ(coded.motion->T, 10);
  expect_same(coded, load_problem("planar/trajectory"));
}

TEST(InCode, Impulse) {
  const Problem coded = make_problem(impulse()), loaded = load_problem("uvms/valve_impulse");
  const Eigen::MatrixXd theta_r = coded.theta_r_default.transpose();
  const Answer a = evaluate(coded, theta_r), b = evaluate(loaded, theta_r);
  EXPECT_EQ(a.status, Status::kOptimal);
  EXPECT_EQ(a.beta(), b.beta());
  EXPECT_EQ(a.trajectory.gradient, b.trajectory.gradient);
}

/// Directions have any length; what was derived before counts for nothing.
TEST(InCode, FinalizeDerivesAnew) {
  const Robot robot = finalize(vehicle(), vehicle_shapes());
  Robot weaker = robot;
  weaker.thrusters[0].direction *= 7;
  weaker.thrusters[0].force_max = 0.5;
  weaker = finalize(weaker);
  EXPECT_EQ(weaker.collision, nullptr);
  EXPECT_TRUE(weaker.convex_bodies.empty());
  EXPECT_EQ(weaker.actuation.u_max[0], 0.5);
  EXPECT_LT((weaker.actuation.B - robot.actuation.B).norm(), 1e-15);
}

}  // namespace
}  // namespace maxwrench
