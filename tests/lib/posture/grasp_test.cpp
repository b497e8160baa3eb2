#include <gtest/gtest.h>

#include <cmath>

#include "lib/posture/redundancy.h"
#include "lib/robot/kinematics.h"
#include "maxwrench/measure.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "tests/support/contacts.h"

namespace maxwrench {
namespace {

/// The value with the second contact's first `columns` columns.
double value(Problem problem, const Posture& posture, int columns) {
  problem.contact->C = problem.contact->C.leftCols(columns).eval();
  problem.contact->w_min.conservativeResize(columns);
  problem.contact->w_max.conservativeResize(columns);
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  Posture same = posture;
  same.C_2 = posture.C_2.leftCols(columns);
  set_posture(same, program);
  Capability capability;
  find_wrench_solver("simplex").make()->solve(program, false, capability);
  return capability.status == Status::kOptimal ? capability.beta : -kInfinity;
}

/// Six joints hold position and axes; Newton's method finds them.
TEST(Grasp, EveryIkSolutionHoldsPositionAndAxes) {
  Random random(21);
  int found = 0;
  for (int sample = 0; sample < 5; ++sample) {
    const Problem problem = with_firm_grasp(random);
    EXPECT_EQ(problem.contact->rank, 12);
    PostureEvaluator model(problem, false);
    model.evaluate(near_default(problem, random));
    for (int ik_solution = 0; ik_solution < model.ik_solutions(); ++ik_solution, ++found) {
      const Posture& posture = model.select(ik_solution);
      const Pose<double> hand =
          posture.base * posture.links[10] * problem.robot.end_effectors[1].placement;
      EXPECT_LT((hand.p - posture.contact.p).norm(), 1e-11);
      EXPECT_LT((hand.R - posture.contact.R).norm(), 1e-11);
    }
  }
  EXPECT_GE(found, 5);
}

/// No force <= any force without torque <= any wrench.
TEST(Grasp, HoldingFirmlyHelpsMost) {
  Random random(22);
  int helped = 0;
  for (int sample = 0; sample < 20; ++sample) {
    const Problem problem = with_firm_grasp(random);
    PostureEvaluator model(problem, false);
    const Posture& posture = model.evaluate(problem.theta_r_default);
    if (posture.status != Status::kValid) continue;
    const double none = value(problem, posture, 0), point = value(problem, posture, 3),
                 firm = value(problem, posture, 6);
    EXPECT_GE(point, none - 1e-9 * (1 + std::abs(none)));
    EXPECT_GE(firm, point - 1e-9 * (1 + std::abs(point)));
    helped += firm > none + 1e-3 && firm > -kInfinity;
  }
  EXPECT_GE(helped, 5);
}

/// Of random linear functions of tau_d, J, J_2 and C_2, where Newton stays on its IK solution.
TEST(Grasp, GradientAndNullMotionEqualDifferences) {
  Random random(23);
  constexpr double kStep = 1e-6;
  int compared = 0;
  for (int sample = 0; sample < 4; ++sample) {
    const Problem problem = with_firm_grasp(random);
    PostureEvaluator model(problem, false);
    const Eigen::VectorXd theta_r = problem.theta_r_default;
    const Posture posture = model.evaluate(theta_r);
    if (posture.status != Status::kValid) continue;
    const auto noise = [&](Eigen::Index, Eigen::Index) { return random.normal(); };
    Capability seeds;
    seeds.lambda = Eigen::VectorXd::NullaryExpr(16, [&] { return random.normal(); });
    seeds.beta_J = Matrix6Xd::NullaryExpr(6, 16, noise);
    seeds.beta_J2 = Matrix6Xd::NullaryExpr(6, 16, noise);
    seeds.beta_C2 = Matrix6Xd::NullaryExpr(6, 6, noise);
    Eigen::VectorXd gradient;
    model.pull_back(theta_r, seeds, gradient);
    Eigen::MatrixXd A_r;
    null_motion(problem, posture, A_r);
    EXPECT_LT((posture.J * A_r).norm(), 1e-10);
    const auto at = [&](const Eigen::VectorXd& other, Eigen::VectorXd& q) {
      Posture p = model.evaluate(other);
      for (int b = 1; b < model.ik_solutions(); ++b) {
        if ((model.select(b).q - posture.q).norm() < (p.q - posture.q).norm()) p = model.select(b);
      }
      q = p.q;
      return seeds.lambda.dot(p.tau_d) + seeds.beta_J.cwiseProduct(p.J).sum() +
             seeds.beta_J2.cwiseProduct(p.J_2).sum() + seeds.beta_C2.cwiseProduct(p.C_2).sum();
    };
    for (int k = 0; k < problem.redundancy(); ++k) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(5, k);
      Eigen::VectorXd after, before;
      const double difference =
          (at(theta_r + step, after) - at(theta_r - step, before)) / (2 * kStep);
      if ((after - before).norm() > 1e-3) continue;  // another IK solution
      EXPECT_NEAR(gradient[k], difference, 1e-5 * (1 + std::abs(difference)));
      EXPECT_LT(((after - before) / (2 * kStep) - A_r.col(k).tail(10)).norm(),
                1e-5 * (1 + A_r.col(k).norm()));
      ++compared;
    }
  }
  EXPECT_GE(compared, 10);
}

}  // namespace
}  // namespace maxwrench
