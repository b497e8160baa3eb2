#include "lib/posture/ik/dependent_joints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/robot/chain.h"
#include "maxwrench/posture.h"
#include "tests/support/dependents.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Fourth-order differences of f along coordinate k.
template <class F>
double difference(const F& f, const Eigen::VectorXd& at, int k) {
  constexpr double kStep = 1e-5;
  const Eigen::VectorXd h = kStep * Eigen::VectorXd::Unit(at.size(), k);
  return (8 * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12 * kStep);
}

TEST(DependentJoints, MotionsOfTheEndEffector) {
  Random random(1);
  for (const auto& axes : kIntegrableAxes) {
    const Problem problem = problem_with_dependents(random, axes, 2);
    EXPECT_EQ(motions_of(problem.robot, 0), 6);
  }
  Problem problem = random_problem(random, 3);
  EXPECT_EQ(motions_of(problem.robot, 0), 6);
  problem.robot.base_axes = {5};
  EXPECT_EQ(motions_of(problem.robot, 0), 4);
  // Axes in parallel: a plane.
  for (Joint& joint : problem.robot.joints) {
    joint.type = JointType::kRevolute;
    joint.placement.R.setIdentity();
    joint.axis = Eigen::Vector3d::UnitZ();
  }
  EXPECT_EQ(motions_of(problem.robot, 0), 3);
  problem.robot.base_axes = {0, 1, 2, 5};
  EXPECT_EQ(motions_of(problem.robot, 0), 4);
}

/// At random postures over all sets of base axes the pose is met and the derivative of a
/// random function of tau_d and J is that of differences.
TEST(DependentJoints, PoseAndDerivativeAtRandomPostures) {
  Random random(2);
  int valid = 0;
  for (int sample = 0; sample < samples(280); ++sample) {
    const auto& axes = kIntegrableAxes[static_cast<std::size_t>(sample) % kIntegrableAxes.size()];
    const Problem problem = problem_with_dependents(random, axes, 1 + sample % 5);
    PostureEvaluator model(problem, false);
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const Posture& posture = model.evaluate(theta_r);
    if (posture.status != Status::kValid) continue;
    ASSERT_LT(pose_error(problem, posture), 1e-12);
    const Eigen::VectorXd q = posture.q;
    const int n = problem.robot.velocities();
    const Eigen::VectorXd tau_seed =
        Eigen::VectorXd::NullaryExpr(n, [&] { return random.normal(); });
    const Matrix6Xd J_seed =
        Matrix6Xd::NullaryExpr(6, n, [&](Eigen::Index, Eigen::Index) { return random.normal(); });
    bool reached = true;
    const auto value = [&](const Eigen::VectorXd& at) {
      const Posture& near = nearest_ik_solution(model, at, q);
      reached = reached && near.status == Status::kValid && (near.q - q).norm() < 0.01;
      return tau_seed.dot(near.tau_d) + J_seed.cwiseProduct(near.J).sum();
    };
    Eigen::VectorXd gradient;
    model.pull_back(theta_r, tau_seed, J_seed, gradient);  // of the first IK solution, as `q`
    Eigen::VectorXd differences(problem.redundancy());
    for (int k = 0; k < problem.redundancy(); ++k) differences[k] = difference(value, theta_r, k);
    if (!reached) continue;  // the end of the IK solution lies between the points of the difference
    ++valid;
    EXPECT_LT((gradient - differences).norm(), 1e-6 * (1 + differences.norm())) << sample;
  }
  EXPECT_GE(valid, samples(160));
}

/// Of a path: from the guess along the straight line.
TEST(DependentJoints, FollowDependsOnThetaRAlone) {
  Random random(3);
  const Problem problem = problem_with_dependents(random, {0, 1, 5}, 2);
  DependentJoints one(problem), other(problem);
  std::vector<Eigen::VectorXd> points;
  std::vector<Eigen::VectorXd> z;
  for (int i = 0; i < 20; ++i) {
    points.push_back(random_theta_r(problem, random));
    one.follow(points.back());
    z.push_back(one.z());
  }
  for (std::size_t i = points.size(); i-- > 0;) {
    other.follow(points[i]);
    EXPECT_EQ(other.z(), z[i]);
  }
}

/// Along random ways of theta_r and the pose, there and back: the pose is met at the end, and y is
/// what it was at the start.
TEST(DependentJoints, GoesOnAlongAMotion) {
  Random random(7);
  int arrived = 0;
  for (int sample = 0; sample < samples(400); ++sample) {
    const auto& axes = kIntegrableAxes[static_cast<std::size_t>(sample) % kIntegrableAxes.size()];
    Problem problem = problem_with_dependents(random, axes, 1 + sample % 5);
    const Pose<double> start = problem.pose;
    const Eigen::VectorXd before = problem.theta_r_default;
    const Eigen::VectorXd after = random_theta_r(problem, random);
    const Eigen::Vector3d turn = random_vector(random, 0.2);
    const Eigen::Vector3d way = random_vector(random, 0.1);
    const auto pose_at = [&](double s) -> Pose<double> {
      return {Eigen::AngleAxisd(s * turn.norm(), turn.normalized()) * start.R, start.p + s * way};
    };
    DependentJoints ik_solution(problem);
    if (ik_solution.follow(before)) continue;  // singular
    const Eigen::VectorXd z = ik_solution.z();
    bool reached = true;
    const auto go = [&](double s) {
      reached = reached && !ik_solution.go_on(before + s * (after - before), pose_at(s));
    };
    for (int i = 1; i <= 10; ++i) go(i / 10.0);
    if (!reached) continue;
    ++arrived;
    Posture posture;
    posture.base = base_pose(problem.robot, ik_solution.z().head<4>());
    Kinematics<double> kinematics(problem.robot);
    kinematics.set_joints(ik_solution.z().tail(before.size() + problem.dependent.size()));
    posture.links = kinematics.links();
    problem.pose = pose_at(1);
    EXPECT_LT(pose_error(problem, posture), 1e-12);
    problem.pose = start;
    for (int i = 9; i >= 0; --i) go(i / 10.0);
    EXPECT_TRUE(reached);
    EXPECT_LT((ik_solution.z() - z).norm(), 1e-8 * (1 + z.norm()));
  }
  EXPECT_GT(arrived, samples(200));
}

/// About the axis of the base's yaw, in one call and by almost half a turn: the base follows in its
/// plane and the joints rest. Nothing is allocated on the way.
TEST(DependentJoints, GoesOnByALargeTurn) {
  Random random(8);
  const Problem problem = problem_with_dependents(random, {0, 1, 5}, 2);
  const Eigen::VectorXd& theta_r = problem.theta_r_default;
  DependentJoints ik_solution(problem);
  ASSERT_EQ(ik_solution.follow(theta_r), nullptr);
  Eigen::VectorXd z = ik_solution.z();
  const double turn = 3;
  Pose<double> turned = problem.pose;
  turned.R = Eigen::AngleAxisd(turn, problem.robot.mount.R.col(2)) * problem.pose.R;
  const long before = allocation_count();
  ASSERT_EQ(ik_solution.go_on(theta_r, turned), nullptr);
  EXPECT_EQ(allocation_count(), before);
  const Pose<double> from = base_pose(problem.robot, z.head<4>());
  const Pose<double> to = base_pose(problem.robot, ik_solution.z().head<4>());
  const Eigen::Vector3d lever = from.R.transpose() * (problem.pose.p - from.p);
  EXPECT_LT((to.p + to.R * lever - problem.pose.p).norm(), 1e-11);
  z[3] += turn;
  EXPECT_LT((ik_solution.z() - z).tail(z.size() - 3).norm(), 1e-11);
}

TEST(DependentJoints, AllocatesNothingAfterTheFirstCall) {
  Random random(4);
  const Problem problem = problem_with_dependents(random, {5}, 3);
  PostureEvaluator model(problem, false);
  std::vector<Eigen::VectorXd> points;
  for (int i = 0; i < 20; ++i) points.push_back(random_theta_r(problem, random));
  const Eigen::VectorXd tau_seed = Eigen::VectorXd::Ones(problem.robot.velocities());
  const Matrix6Xd J_seed = Matrix6Xd::Ones(6, problem.robot.velocities());
  Eigen::VectorXd gradient;
  // Places of the start system are computed when they are needed first.
  for (const Eigen::VectorXd& theta_r : points) model.evaluate(theta_r);
  model.pull_back(points.back(), tau_seed, J_seed, gradient);
  const long before = allocation_count();
  for (const Eigen::VectorXd& theta_r : points) {
    model.evaluate(theta_r);
    model.pull_back(theta_r, tau_seed, J_seed, gradient);
  }
  EXPECT_EQ(allocation_count(), before);
}

/// Without weight only the pose relative to the mount counts.
TEST(DependentJoints, MovesWithTheMount) {
  Random random(5);
  Problem problem = problem_with_dependents(random, {0, 1}, 2);
  const Eigen::VectorXd theta_r = random_theta_r(problem, random);
  const Eigen::VectorXd q = PostureEvaluator(problem, false).evaluate(theta_r).q;
  const Pose<double> motion{random_rotation(random), random_vector(random)};
  problem.robot.mount = motion * problem.robot.mount;
  problem.pose = motion * problem.pose;
  EXPECT_LT((PostureEvaluator(problem, false).evaluate(theta_r).q - q).norm(), 1e-10);
}

TEST(DependentJoints, PlanarArmEqualsTheLawOfCosines) {
  const Problem problem = four_bars();
  EXPECT_EQ(motions_of(problem.robot, 0), 3);
  PostureEvaluator model(problem);
  for (double q0 = -0.6; q0 < 1.2; q0 += 0.05) {
    model.evaluate(Eigen::VectorXd::Constant(1, q0));
    const Eigen::Vector2d rest(1.5 - std::cos(q0), 0.5 - std::sin(q0));
    if (rest.norm() > 1.999) {
      EXPECT_EQ(model.ik_solutions(), 0);
      continue;
    }
    const double bend = std::acos((rest.squaredNorm() - 2) / 2);
    int listed = 0;
    for (const double q2 : {bend, -bend}) {
      const double q1 = std::atan2(rest.y(), rest.x()) - q2 / 2 - q0;
      const Eigen::Vector4d q(q0, q1, q2, -q0 - q1 - q2);
      if (q.cwiseAbs().maxCoeff() > 3) continue;  // beyond the limits
      ++listed;
      const Posture& posture = nearest_ik_solution(model, Eigen::VectorXd::Constant(1, q0), q);
      EXPECT_LT((posture.q - q).norm(), 1e-11) << q0;
    }
    EXPECT_EQ(model.ik_solutions(), listed) << q0;
  }
}

TEST(DependentJoints, SaysWhyThereIsNoPosture) {
  Problem problem = four_bars();
  // At q0 = 3 the second joint is at (-1, 0.14), 2.5 m away from the tool; two links reach 2 m.
  const Eigen::VectorXd far = Eigen::VectorXd::Constant(1, 3);
  EXPECT_EQ(PostureEvaluator(problem).evaluate(far).status, Status::kInvalidPosture);
  EXPECT_EQ(PostureEvaluator(problem).evaluate(far).reason.str().find("unreachable pose"), 0u);
  problem.robot.joints[2].q_min = -0.4;
  problem.robot.joints[2].q_max = 0.4;
  EXPECT_STREQ(PostureEvaluator(problem).evaluate(problem.theta_r_default).reason.c_str(),
               "joint limit of a dependent joint");
  // Out of the plane.
  problem.pose.p.z() = 0.1;
  EXPECT_FALSE(DependentJoints(problem).has_start());
  EXPECT_NEAR(DependentJoints(problem).start_error(), 0.1, 1e-6);
  EXPECT_EQ(PostureEvaluator(problem)
                .evaluate(problem.theta_r_default)
                .reason.str()
                .find("unreachable pose"),
            0u);
  // Stretched: elbow and shoulder are no longer independent.
  problem = four_bars();
  problem.pose.p = {3, 0, 0};
  problem.theta_r_default.setZero();
  problem.guess_q.setZero();
  EXPECT_TRUE(DependentJoints(problem).has_start());
  EXPECT_TRUE(DependentJoints(problem).start_is_singular());
  EXPECT_EQ(PostureEvaluator(problem).evaluate(problem.theta_r_default).status,
            Status::kInvalidPosture);
}

/// Whole turns bring a joint into its limits.
TEST(DependentJoints, TurnsIntoTheLimits) {
  Problem problem = four_bars();
  const Eigen::VectorXd q = PostureEvaluator(problem).evaluate(problem.theta_r_default).q;
  problem.robot.joints[3].q_min += 4 * M_PI;
  problem.robot.joints[3].q_max += 4 * M_PI;
  const Posture posture = PostureEvaluator(problem).evaluate(problem.theta_r_default);
  EXPECT_EQ(posture.status, Status::kValid) << posture.reason.c_str();
  EXPECT_LT((posture.q - q - 4 * M_PI * Eigen::Vector4d::Unit(3)).norm(), 1e-11);
}

}  // namespace
}  // namespace maxwrench
