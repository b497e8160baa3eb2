#include "lib/posture/free_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/posture/redundancy.h"
#include "maxwrench/load.h"
#include "maxwrench/objective.h"
#include "maxwrench/posture.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "tests/support/contacts.h"
#include "tests/support/dependents.h"
#include "tests/support/free_poses.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

Eigen::Matrix3d yawed(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// All robots: a base that follows alone, dependent joints, second contacts; the wrench rests or
/// turns.
std::vector<Problem> problems_with_free_poses() {
  Random random(61);
  std::vector<Problem> problems;
  std::vector<FreePose> ways = {{{0, 1, 2, 3, 4, 5}, false, false},
                                {{0, 2, 4, 5}, true, true},
                                {{5}, false, true},
                                {{1, 3}, true, false}};
  if (kSanitized) ways.resize(2);  // each kind of axes and of wrench once
  for (const FreePose& free : ways) {
    problems.push_back(with_free_pose(random_problem(random, 4), free));
    problems.push_back(with_free_pose(problem_with_dependents(random, {0, 1, 5}, 2, true), free));
    for (Problem& problem : problems)
      problem.robot.gravity = 1;  // so that most can hold themselves
    problems.push_back(with_free_pose(load_problem("dual_arm/bar_wall"), free));
    problems.push_back(with_free_pose(with_pipe(load_problem("dual_arm/two_arms")), free));
    problems.push_back(with_free_pose(with_firm_grasp(random), free));
  }
  problems.push_back(with_free_pose(load_problem("planar/two_arms"), {{0, 1, 5}, true, true}));
  return problems;
}

Eigen::VectorXd place_in(const Problem& problem, Random& random) {
  return problem.contact ? near_default(problem, random) : random_theta_r(problem, random);
}

/// X_0 at (1, 2, 3), turned by 90 degrees about z; x = 0.5 m and a further yaw of 90 degrees. Along
/// the axes of the pose, whose x points along the world's y, the origin moves to (1, 2.5, 3); along
/// the tool's own, whose x then points along the world's -x, to (0.5, 2, 3).
TEST(FreePose, AxesOfThePoseAndOfTheTool) {
  Problem problem;
  problem.pose = {yawed(kQuarter), {1, 2, 3}};
  problem.redundant = {7};
  problem.free.axes = {0, 5};
  const Eigen::Vector3d theta_r(9, 0.5, kQuarter);
  const Pose<double> along_pose = pose_at(problem, theta_r);
  EXPECT_LT((along_pose.p - Eigen::Vector3d(1, 2.5, 3)).norm(), 1e-15);
  EXPECT_LT((along_pose.R - yawed(2 * kQuarter)).norm(), 1e-15);
  problem.free.along_end_effector = true;
  const Pose<double> along_end_effector = pose_at(problem, theta_r);
  EXPECT_LT((along_end_effector.p - Eigen::Vector3d(0.5, 2, 3)).norm(), 1e-15);
  EXPECT_LT((along_end_effector.R - along_pose.R).norm(), 1e-15);
}

/// Ry(90 degrees) Rx(90 degrees) has the columns (0, 0, -1), (1, 0, 0) and (0, -1, 0).
TEST(FreePose, AnglesAreThoseOfRpy) {
  Problem problem;
  problem.free.axes = {3, 4};
  const Pose<double> pose = pose_at(problem, Eigen::Vector2d(kQuarter, kQuarter));
  Eigen::Matrix3d expected;
  expected << 0, 1, 0, 0, 0, -1, -1, 0, 0;
  EXPECT_LT((pose.R - expected).norm(), 1e-15);
}

TEST(FreePose, TwistIsTheDerivativeOfThePose) {
  constexpr double kStep = 1e-6;
  Random random(62);
  for (const bool along_end_effector : {false, true}) {
    Problem problem;
    problem.pose = {random_rotation(random), random_vector(random)};
    problem.free = {{0, 1, 2, 3, 4, 5}, along_end_effector, false};
    for (int sample = 0; sample < 20; ++sample) {
      const Eigen::VectorXd s = Eigen::VectorXd::NullaryExpr(6, [&] { return random.normal(); });
      for (int i = 0; i < 6; ++i) {
        const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(6, i);
        const Pose<double> after = pose_at(problem, s + step), before = pose_at(problem, s - step);
        Vector6d difference;
        difference << after.p - before.p, logarithm(after.R * before.R.transpose());
        EXPECT_LT((difference / (2 * kStep) - free_twist(problem, s, i)).norm(), 1e-8) << i;
      }
    }
  }
}

/// Every valid posture reaches X(s).
TEST(FreePose, PosturesReachIt) {
  Random random(63);
  for (const Problem& problem : problems_with_free_poses()) {
    PostureEvaluator model(problem, false);
    int seen = 0;
    for (int sample = 0; sample < 20; ++sample) {
      const Eigen::VectorXd theta_r = place_in(problem, random);
      if (model.evaluate(theta_r).status != Status::kValid) continue;
      const Problem held = held_at(problem, theta_r);
      for (int i = 0; i < model.ik_solutions(); ++i) {
        EXPECT_LT(pose_error(held, model.select(i)), 1e-11) << problem.name;
        ++seen;
      }
    }
    EXPECT_GT(seen, 5) << problem.name;
  }
}

/// The value is that of the same robot at a fixed pose, with a wrench that is given there.
TEST(FreePose, ValueIsThatOfTheFixedPose) {
  Random random(64);
  for (const Problem& problem : problems_with_free_poses()) {
    for (const char* measure : {"linf_polytope", "manipulability"}) {
      Case c;
      c.problem = problem.name;
      c.measure = measure;
      if (c.measure == "linf_polytope") c.wrench = Wrench::kAny;
      const auto value = [&](const Problem& p, const Eigen::VectorXd& theta_r) {
        const Method method = resolve(p, c);
        return make_capability_objective(p, c.wrench, method.make_measure, false)
            ->evaluate(theta_r, nullptr);
      };
      int compared = 0;
      for (int sample = 0; sample < 100 && compared < samples(4); ++sample) {
        const Eigen::VectorXd theta_r = place_in(problem, random);
        const double free = value(problem, theta_r);
        if (!std::isfinite(free)) continue;
        const double fixed = value(held_at(problem, theta_r), held_theta_r(problem, theta_r));
        EXPECT_NEAR(free, fixed, 1e-8 * (1 + std::abs(fixed))) << problem.name << " " << measure;
        ++compared;
      }
      EXPECT_GT(compared, 0) << problem.name;
    }
  }
}

/// Along all of theta_r; where the one-sided differences disagree there is a kink.
TEST(FreePose, GradientEqualsDifferences) {
  Random random(65);
  constexpr double kStep = 1e-6;
  for (const Problem& problem : problems_with_free_poses()) {
    for (const char* measure : {"linf_polytope", "manipulability"}) {
      Case c;
      c.problem = problem.name;
      c.measure = measure;
      const auto f =
          make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure, false);
      int compared = 0, kinks = 0;
      for (int sample = 0; sample < 100 && compared < samples(60); ++sample) {
        const Eigen::VectorXd theta_r = place_in(problem, random);
        Eigen::VectorXd gradient;
        const double value = f->evaluate(theta_r, &gradient);
        if (!std::isfinite(value)) continue;
        for (int k = 0; k < problem.redundancy(); ++k) {
          const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(theta_r.size(), k);
          const double after = f->evaluate(theta_r + step, nullptr);
          const double before = f->evaluate(theta_r - step, nullptr);
          const double jump = (after - value) - (value - before);
          const double difference = (after - before) / (2 * kStep);
          if (!(std::abs(jump) < 1e-3 * kStep * (1 + std::abs(difference)))) {
            ++kinks;
            continue;
          }
          EXPECT_NEAR(gradient[k], difference, 1e-4 * (1 + std::abs(difference)))
              << problem.name << " " << measure << " " << problem.theta_r_name(k);
          ++compared;
        }
      }
      EXPECT_GT(compared, kinks) << problem.name << " " << measure;
    }
  }
}

/// J A_r is the twist of each coordinate, and a contact is kept.
TEST(FreePose, NullMotionMovesTheEndEffectorByItsTwist) {
  Random random(66);
  for (const Problem& problem : problems_with_free_poses()) {
    PostureEvaluator model(problem, false);
    int compared = 0;
    for (int sample = 0; sample < 40; ++sample) {
      const Eigen::VectorXd theta_r = place_in(problem, random);
      const Posture& posture = model.evaluate(theta_r);
      if (posture.status != Status::kValid) continue;
      Eigen::MatrixXd A_r, expected = Eigen::MatrixXd::Zero(6, problem.redundancy());
      null_motion(problem, posture, A_r);
      const auto joints = static_cast<Eigen::Index>(problem.redundant.size());
      for (int i = 0; i < problem.free.count(); ++i) {
        expected.col(joints + i) = free_twist(problem, theta_r, i);
      }
      EXPECT_LT((posture.J * A_r - expected).norm(), 1e-9) << problem.name;
      if (problem.contact) {
        const Eigen::MatrixXd moved = posture.J_2 * A_r.leftCols(joints + problem.free.count());
        EXPECT_LT(moved.topRows<3>().norm(), 1e-9) << problem.name;
      }
      ++compared;
    }
    EXPECT_GT(compared, 2) << problem.name;
  }
}

/// Gravity does not tell a robot from one that has turned about the vertical: with a wrench that
/// turns along, or is a torque about the vertical, the yaw changes nothing.
TEST(FreePose, YawOfAllIsASymmetry) {
  Random random(67);
  for (const bool turns : {false, true}) {
    Problem fixed = random_problem(random, 4);
    fixed.pose.R = Eigen::Matrix3d::Identity();
    if (!turns) fixed.c = Vector6d::Unit(5);
    const Problem problem = with_free_pose(fixed, {{5}, false, turns});
    const Case c{"random", "linf_polytope"};
    const auto f =
        make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure, false);
    for (int sample = 0; sample < 20; ++sample) {
      Eigen::VectorXd theta_r = random_theta_r(problem, random), gradient;
      const double value = f->evaluate(theta_r, &gradient);
      if (!std::isfinite(value)) continue;
      EXPECT_NEAR(gradient[4], 0, 1e-11 * (1 + std::abs(value)));
      theta_r[4] = 0;
      EXPECT_NEAR(f->evaluate(theta_r, nullptr), value, 1e-11 * (1 + std::abs(value)));
    }
  }
}

/// The tool of the planar vehicle at any yaw: its best is that of the best of many fixed yaws,
/// whose searches know nothing of free poses. They are 1 degree apart; thrusters of 4 N in all
/// change beta by about 4 N times half a degree between them.
TEST(FreePose, SLOW_BestIsThatOfAGridOfFixedPoses) {
  const Problem fixed = load_problem("planar/force");
  const auto best = [](const Problem& problem) {
    Case c;
    c.problem = problem.name;
    c.search = "crs2";
    c.budget = 4000;
    return solve(problem, {c, 1}).capability.beta;
  };
  const double found = best(with_free_pose(fixed, {{5}, false, false}));
  double most = 0;
  for (int degrees = -17; degrees <= 17; ++degrees) {
    Problem turned = fixed;
    turned.pose.R = turned.pose.R * yawed(degrees * std::numbers::pi / 180);
    most = std::max(most, best(turned));
  }
  EXPECT_GT(found, best(fixed) + 0.1);
  EXPECT_GT(found, most - 1e-4);
  EXPECT_LT(found, most + 0.05);
}

TEST(FreePose, AllocatesNothingAfterTheFirstCall) {
  Random random(68);
  const Problem problem =
      with_free_pose(random_problem(random, 4), {{0, 1, 2, 3, 4, 5}, true, true});
  const Case c{"random", "linf_polytope"};
  const auto f = make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure);
  const Eigen::VectorXd first = random_theta_r(problem, random),
                        next = random_theta_r(problem, random);
  Eigen::VectorXd gradient;
  f->evaluate(first, &gradient);
  const long before = allocation_count();
  f->evaluate(next, &gradient);
  EXPECT_EQ(allocation_count(), before);
}

TEST(FreePose, NamesAndUnitsStandBetweenJointsAndRegraspCoordinates) {
  const Problem problem = with_free_pose(load_problem("dual_arm/bar_wall"), {{1, 5}, false, false});
  const int joints = static_cast<int>(problem.redundant.size());
  EXPECT_EQ(problem.theta_r_name(joints), "pose_y");
  EXPECT_STREQ(problem.theta_r_unit(joints), "m");
  EXPECT_EQ(problem.theta_r_name(joints + 1), "pose_yaw");
  EXPECT_STREQ(problem.theta_r_unit(joints + 1), "rad");
  EXPECT_EQ(problem.theta_r_name(joints + 2), "regrasp_1");
}

}  // namespace
}  // namespace maxwrench
