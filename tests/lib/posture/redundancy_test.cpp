#include "lib/posture/redundancy.h"

#include <gtest/gtest.h>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

std::vector<Problem> examples() {
  Random random(1);
  std::vector<Problem> problems = {load_problem("uvms/valve"), load_problem("planar/force")};
  for (const int joints : {1, 4, 7}) problems.push_back(random_problem(random, joints));
  // An end effector in the middle: the joints beyond it stand still.
  problems.push_back(random_problem(random, 4));
  Problem& ik_solution = problems.back();
  ik_solution.robot.end_effectors[0].link = 2;
  ik_solution.redundant.resize(2);
  for (Eigen::VectorXd* bounds :
       {&ik_solution.theta_r_min, &ik_solution.theta_r_max, &ik_solution.theta_r_default}) {
    bounds->conservativeResize(2);
  }
  return problems;
}

TEST(Redundancy, NullMotionLeavesTheEndEffectorAndMovesThetaR) {
  Random random(2);
  for (const Problem& problem : examples()) {
    PostureEvaluator model(problem, false);
    Eigen::MatrixXd A_r;
    for (int sample = 0; sample < 100; ++sample) {
      const Posture& posture = model.evaluate(random_theta_r(problem, random));
      null_motion(problem, posture, A_r);
      EXPECT_LT((posture.J * A_r).norm(), 1e-12) << problem.name;
      const auto axes = static_cast<Eigen::Index>(problem.robot.base_axes.size());
      for (Eigen::Index k = 0; k < A_r.cols(); ++k) {
        EXPECT_EQ(A_r.col(k).tail(A_r.rows() - axes),
                  Eigen::VectorXd::Unit(A_r.rows() - axes, problem.redundant[k]));
      }
    }
  }
}

/// The twist of the base in its own axes, from two of its poses.
Vector6d base_twist(const Pose<double>& from, const Pose<double>& to, double step) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(from.R.transpose() * to.R));
  const Eigen::AngleAxisd half(turn.angle() / 2, turn.axis());
  Vector6d twist;
  twist << (from.R * half.matrix()).transpose() * (to.p - from.p), turn.angle() * turn.axis();
  return twist / step;
}

TEST(Redundancy, NullMotionIsTheDerivativeOfTheBasePose) {
  Random random(3);
  for (const Problem& problem : examples()) {
    PostureEvaluator model(problem, false);
    Eigen::MatrixXd A_r;
    for (int sample = 0; sample < 20; ++sample) {
      const Eigen::VectorXd theta_r = random_theta_r(problem, random);
      null_motion(problem, model.evaluate(theta_r), A_r);
      for (int k = 0; k < problem.redundancy(); ++k) {
        constexpr double kStep = 1e-6;
        const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(problem.redundancy(), k);
        const Pose<double> from = model.evaluate(theta_r - step).base;
        const Vector6d twist = base_twist(from, model.evaluate(theta_r + step).base, 2 * kStep);
        for (std::size_t i = 0; i < problem.robot.base_axes.size(); ++i) {
          EXPECT_NEAR(A_r(static_cast<Eigen::Index>(i), k), twist[problem.robot.base_axes[i]], 1e-8)
              << problem.name;
        }
      }
    }
  }
}

/// J_e n×6 of a chain that theta_r holds: the base follows a twist of the end effector, joints
/// rest.
Eigen::MatrixXd end_effector_motion(const Problem& problem, const Posture& posture) {
  const auto axes = static_cast<Eigen::Index>(problem.robot.base_axes.size());
  Eigen::MatrixXd J_e = Eigen::MatrixXd::Zero(posture.J.cols(), 6);
  const Eigen::MatrixXd J_d = posture.J.leftCols(axes);
  J_e.topRows(axes) = J_d.completeOrthogonalDecomposition().pseudoInverse();
  return J_e;
}

/// eq:redundantJacobian: any velocity is the sum of what the end effector asks for and what theta_r
/// does, if no joint lies beside the chain.
TEST(Redundancy, NullMotionCompletesTheMotionOfTheEndEffector) {
  Random random(4);
  for (const Problem& problem : examples()) {
    if (problem.redundancy() != static_cast<int>(problem.robot.joints.size())) continue;
    PostureEvaluator model(problem, false);
    Eigen::MatrixXd A_r;
    for (int sample = 0; sample < 100; ++sample) {
      const Posture& posture = model.evaluate(random_theta_r(problem, random));
      null_motion(problem, posture, A_r);
      const Eigen::VectorXd velocities =
          Eigen::VectorXd::NullaryExpr(posture.J.cols(), [&] { return random.normal(); });
      const Eigen::VectorXd sum = end_effector_motion(problem, posture) * (posture.J * velocities) +
                                  A_r * velocities.tail(problem.redundancy());
      EXPECT_LT((sum - velocities).norm(), 1e-11) << problem.name;
    }
  }
}

TEST(Redundancy, DependentJointsFollow) {
  // A base on {x, y} with two joints of which theta_r holds the first: the other must turn back by
  // as much.
  Problem problem = load_problem("planar/force");
  problem.robot.base_axes = {0, 1};
  complete_actuation(problem.robot);
  problem.redundant = {0};
  problem.theta_r_min = problem.theta_r_max = problem.theta_r_default = Eigen::VectorXd::Zero(1);
  Posture posture;
  posture.J = Matrix6Xd::Zero(6, 4);  // x, y, shoulder at (0, 0), elbow at (0.1, 0), tool (0.2, 0)
  posture.J(0, 0) = posture.J(1, 1) = posture.J(5, 2) = posture.J(5, 3) = 1;
  posture.J(1, 2) = 0.2;
  posture.J(1, 3) = 0.1;
  Eigen::MatrixXd A_r;
  null_motion(problem, posture, A_r);
  // The tool would be carried along y by 0.2 - 0.1 = 0.1, which the base takes back.
  EXPECT_LT((A_r - Eigen::Vector4d(0, -0.1, 1, -1)).norm(), 1e-14);
}

TEST(Redundancy, AllocatesNothingAfterTheFirstCall) {
  const Problem problem = load_problem("uvms/valve");
  PostureEvaluator model(problem, false);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  Eigen::MatrixXd A_r;
  null_motion(problem, posture, A_r);
  const long before = allocation_count();
  null_motion(problem, posture, A_r);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace maxwrench
