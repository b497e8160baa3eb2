#include "lib/posture/pull_back.h"

#include <gtest/gtest.h>

#include "lib/math/dual.h"
#include "maxwrench/capability.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// The value t'tau_d + <J_seed, J> in scalar T while the end effector keeps its pose.
template <class T>
T value(const Problem& problem, const VectorX<T>& q, const Eigen::VectorXd& t,
        const Matrix6Xd& J_seed) {
  Kinematics<T> kinematics(problem.robot);
  kinematics.set_joints(q);
  const EndEffector& e = problem.robot.end_effectors[0];
  const Pose<T> base = problem.pose * kinematics.end_effector(e).inverse();
  Matrix6X<T> J(6, t.size());
  VectorX<T> tau_d(t.size());
  kinematics.jacobian(e, base.R, J);
  kinematics.gravity_and_buoyancy(base.R, tau_d);
  T sum(0.0);
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    sum += t[i] * tau_d[i];
    for (int r = 0; r < 6; ++r) sum += J_seed(r, i) * J(r, i);
  }
  return sum;
}

void expect_dual_derivatives(const Problem& problem, Random& random) {
  const Robot& robot = problem.robot;
  const auto joints = static_cast<Eigen::Index>(robot.joints.size());
  const int n = robot.velocities();
  const auto normal = [&] { return random.normal(); };
  const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(joints, normal);
  const Eigen::VectorXd t = Eigen::VectorXd::NullaryExpr(n, normal);
  const Matrix6Xd J_seed = Matrix6Xd::NullaryExpr(6, n, normal);

  Kinematics<double> kinematics(robot);
  kinematics.set_joints(q);
  const Pose<double> base =
      problem.pose * kinematics.end_effector(robot.end_effectors[0]).inverse();
  Matrix6Xd J(6, n);
  Eigen::VectorXd tau_d(n), gradient;
  kinematics.jacobian(robot.end_effectors[0], base.R, J);
  kinematics.gravity_and_buoyancy(base.R, tau_d);
  PullBack(robot, 0).evaluate(kinematics, base.R, J, t, J_seed, gradient);

  for (Eigen::Index k = 0; k < joints; ++k) {
    VectorX<Dual<4>> dual_q = q.cast<Dual<4>>();
    dual_q[k].d[0] = 1;
    const double exact = value(problem, dual_q, t, J_seed).d[0];
    EXPECT_NEAR(gradient[k], exact, 1e-12 * (1 + gradient.norm())) << robot.name << " " << k;
  }
}

TEST(PullBack, EqualsDualNumbers) {
  Random random(1);
  for (int sample = 0; sample < 20; ++sample) {
    for (const int joints : {1, 4, 7}) {
      expect_dual_derivatives(random_problem(random, joints), random);
    }
  }
  expect_dual_derivatives(load_problem("uvms/lift"), random);
  expect_dual_derivatives(load_problem("planar/force"), random);
}

/// Chain 0 - 1 - 2 to the end effector; joints 3 and 4 on link 1, joint 5 on the base, joint 6
/// behind the end effector: each of these moves masses, none moves the end effector.
TEST(PullBack, EqualsDualNumbersWithJointsBesideTheChain) {
  Random random(2);
  for (int sample = 0; sample < 20; ++sample) {
    Problem problem = random_problem(random, 7);
    problem.robot.joints[3].parent = 1;
    problem.robot.joints[5].parent = 0;
    problem.robot.joints[6].parent = 3;
    problem.robot.end_effectors[0].link = 3;
    expect_dual_derivatives(problem, random);
  }
}

/// Derivatives of another size would be read beyond their end.
TEST(PullBack, RejectsDerivativesOfAnotherSize) {
  const Problem problem = load_problem("dual_arm/bar_wall");
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  ASSERT_EQ(posture.status, Status::kValid);
  const Eigen::Index n = posture.J.cols(), l = problem.contact_columns();
  ASSERT_GT(l, 0);
  Capability filled;
  filled.lambda.setOnes(n);
  filled.beta_J = Matrix6Xd::Ones(6, n);
  filled.beta_J2 = Matrix6Xd::Ones(6, n);
  filled.beta_C2 = Matrix6Xd::Ones(6, l);
  Eigen::VectorXd gradient;
  EXPECT_NO_THROW(model.pull_back(problem.theta_r_default, filled, gradient));
  Capability empty = filled;  // of a measure that does not depend on J_2 and C_2
  empty.beta_J2.resize(6, 0);
  empty.beta_C2.resize(6, 0);
  EXPECT_NO_THROW(model.pull_back(problem.theta_r_default, empty, gradient));
  for (Matrix6Xd Capability::*part :
       {&Capability::beta_J, &Capability::beta_J2, &Capability::beta_C2}) {
    for (const Eigen::Index more : {-1, 1}) {
      Capability wrong = filled;
      (wrong.*part).setOnes(6, (filled.*part).cols() + more);
      if ((wrong.*part).cols() == 0) continue;
      EXPECT_THROW(model.pull_back(problem.theta_r_default, wrong, gradient),
                   std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace maxwrench
