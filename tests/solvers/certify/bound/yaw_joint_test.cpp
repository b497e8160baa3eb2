#include <gtest/gtest.h>

#include <cmath>

#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/strategies.h"
#include "problems/loader/drives.h"
#include "solvers/certify/bound/loop_model.h"
#include "solvers/solve/method.h"
#include "tests/support/loops.h"

namespace maxwrench {
namespace {

Problem parked() {
  Random random(5);
  return parked_problem(random);
}

TEST(YawJoint, IsTheFirstOneAboutTheYawOfAParkedBase) {
  EXPECT_EQ(coordinate_about_yaw(parked()), 0);
  const auto none_after = [](const auto& change) {
    Problem problem = parked();
    change(problem);
    return !coordinate_about_yaw(problem).has_value();
  };
  EXPECT_TRUE(none_after([](Problem& p) { p.robot.joints[0].axis = {1e-9, 0, 1}; }));
  EXPECT_TRUE(none_after([](Problem& p) { p.robot.joints[0].type = JointType::kPrismatic; }));
  EXPECT_TRUE(none_after([](Problem& p) { p.robot.thrusters[1].force_max = 1000; }));
  EXPECT_TRUE(none_after([](Problem& p) {  // it is dependent
    p.redundant = {3, 4};
    p.dependent = {0, 1, 2};
  }));
  EXPECT_TRUE(none_after([](Problem& p) {  // nothing makes up for the shift along y
    p.robot.base_axes = {0, 5};
    p.robot.thrusters.clear();
    add_brakes(p.robot);
  }));
  EXPECT_TRUE(
      none_after([](Problem& p) {  // on the tilted floor, its yaw changes the load of a joint
        Joint side = p.robot.joints[0];
        side.name = "side";
        p.robot.joints.push_back(side);
        p.robot.links.push_back(p.robot.links[1]);
        complete_actuation(p.robot);
      }));
  EXPECT_FALSE(coordinate_about_yaw(load_problem("mobile/push")).has_value());  // wheels
  EXPECT_FALSE(coordinate_about_yaw(load_problem("uvms/valve")).has_value());
}

TEST(YawJoint, IsLeftOutForASingleWrenchOfThePolytope) {
  const Problem problem = parked();
  EXPECT_EQ(left_out_coordinate(problem, "linf_polytope", Wrench::kPure), 0);
  EXPECT_FALSE(left_out_coordinate(problem, "linf_polytope", Wrench::kAny).has_value());
  EXPECT_FALSE(left_out_coordinate(problem, "ellipsoid", Wrench::kPure).has_value());
  EXPECT_FALSE(left_out_coordinate(problem, "l2_polytope", Wrench::kPure).has_value());
}

/// The base turns in its place, so the value is the same, by the evaluator that knows nothing of
/// it.
TEST(YawJoint, ChangesNoValue) {
  const Problem problem = parked();
  const auto objective =
      make_capability_objective(problem, Wrench::kPure, resolve(problem, {}).make_measure);
  Random random(1);
  int compared = 0;
  for (int sample = 0; sample < 40; ++sample) {
    Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const double value = objective->evaluate(theta_r, nullptr);
    theta_r[0] = random.uniform(problem.theta_r_min[0], problem.theta_r_max[0]);
    const double other = objective->evaluate(theta_r, nullptr);
    EXPECT_EQ(std::isfinite(value), std::isfinite(other));
    if (!std::isfinite(value)) continue;
    EXPECT_NEAR(value, other, 1e-8 * (1 + std::abs(value)));
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

/// Four coordinates and the yaw are left of six, and the rows of the chain's five joints.
TEST(YawJoint, LeavesTheRowsOfTheChain) {
  const Problem problem = parked();
  const LoopModel all(problem), model(problem, ContactForces::kShares, 0);
  EXPECT_EQ(all.size, 729);
  EXPECT_EQ(model.size, 243);
  EXPECT_EQ(model.coordinates.chain.count(), 5);
  EXPECT_EQ(model.dropped, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(model.coordinates.left_out, 0);
}

}  // namespace
}  // namespace maxwrench
