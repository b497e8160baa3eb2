#include <gtest/gtest.h>

#include "maxwrench/solve.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/written_proof.h"

namespace maxwrench {
namespace {

/// uvms/valve with a hand of two fingers on its last link. One finger, of 0.3 kg, follows the other
/// by a gear, so it rests at the gear's offset.
Problem with_fingers(double offset) {
  TaskSpec task = valve();
  Robot& robot = task.robot;
  robot.collision = nullptr;
  robot.parts.clear();
  const int wrist = static_cast<int>(robot.links.size()) - 1;
  const int leader = static_cast<int>(robot.joints.size());
  for (const char* name : {"lead", "follow"}) {
    const bool follows = name == std::string("follow");
    Link finger;
    finger.name = name;
    finger.mass = follows ? 0.3 : 0.1;
    finger.com = {0.2, 0, 0};
    finger.inertia = 0.01 * Eigen::Matrix3d::Identity();
    robot.links.push_back(finger);
    Joint joint;
    joint.name = std::string(name) + "_joint";
    joint.parent = wrist;
    joint.q_min = -3;
    joint.q_max = 3;
    joint.effort_max = 10;
    if (follows) joint.gear = Gear{leader, 1, offset};
    robot.joints.push_back(joint);
  }
  robot = finalize(robot);
  return make_problem(task);
}

/// The offset moves the centre of mass, and with it the value: a proof of one hand says nothing
/// about another.
TEST(VerifyGears, RestWhereTheirLeaderPutsThem) {
  const Problem straight = with_fingers(0), bent = with_fingers(1.2);
  const Eigen::Vector4d theta_r(3, 0.7, 0.45, -3);  // near the optimum without fingers
  EXPECT_GT(std::abs(evaluate(straight, theta_r).beta() - evaluate(bent, theta_r).beta()), 1e-3);
  const WrittenProof of_straight(straight, "valve", "linf_polytope", Wrench::kPure, 5e-2);
  const WrittenProof of_bent(bent, "valve", "linf_polytope", Wrench::kPure, 5e-2);
  EXPECT_EQ(of_straight.rejection(of_straight.proof), "");
  EXPECT_EQ(of_bent.rejection(of_bent.proof), "");
  EXPECT_NE(of_bent.rejection(of_straight.proof), "");
  EXPECT_NE(of_straight.rejection(of_bent.proof), "");
}

}  // namespace
}  // namespace maxwrench
