#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/posture.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

/// The result of a measure by its value, with derivatives, at the default posture.
template <class Value>
Capability differentiated(const Problem& problem, const Value& value) {
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  set_posture(posture, program);
  const auto measure = make_value_measure(value);
  Capability capability;
  measure->evaluate(posture, program, true, capability);
  if (capability.status == Status::kOptimal) {
    EXPECT_EQ(capability.beta, value(posture, program));
    EXPECT_TRUE(capability.residual.within(0));
    measure->differentiate(posture, program, capability);
  }
  return capability;
}

/// Of the sum of tau_i^3 + <A, J> + |J'c|^2 / 2 the derivatives are 3 tau_i^2 and A + c (J'c)'.
TEST(ValueMeasure, DifferentiatesByTauAndJ) {
  for (const char* name : {"planar/force", "uvms/lift", "fixed/push"}) {
    const Problem problem = load_problem(name);
    const Eigen::Index n = problem.robot.velocities();
    const Matrix6Xd A = Matrix6Xd::NullaryExpr(
        6, n, [](Eigen::Index i, Eigen::Index j) { return std::sin(double(1 + i + 6 * j)); });
    Posture at;
    const auto value = [&](const Posture& posture, const WrenchProgram& program) {
      return program.tau_d.array().cube().sum() + posture.J.cwiseProduct(A).sum() +
             program.JtW.squaredNorm() / 2;
    };
    const Capability capability = differentiated(problem, value);
    const Posture posture = PostureEvaluator(problem).evaluate(problem.theta_r_default);
    const double scale = 1 + std::abs(capability.beta);
    const Eigen::VectorXd lambda = 3 * posture.tau_d.array().square();
    const Matrix6Xd beta_J = A + problem.c * (posture.J.transpose() * problem.c).transpose();
    EXPECT_LT((capability.lambda - lambda).lpNorm<Eigen::Infinity>(), 1e-8 * scale) << name;
    EXPECT_LT((capability.beta_J - beta_J).lpNorm<Eigen::Infinity>(), 1e-8 * scale) << name;
  }
}

/// Of <A, J_2> + <B, C_2> they are A and B.
TEST(ValueMeasure, DifferentiatesByTheSecondContact) {
  const Problem problem = load_problem("planar/two_arms");
  const auto slope = [](Eigen::Index i, Eigen::Index j) { return std::cos(double(i + 7 * j)); };
  const auto value = [&](const Posture& posture, const WrenchProgram& program) {
    const Matrix6Xd A = Matrix6Xd::NullaryExpr(6, posture.J_2.cols(), slope);
    const Matrix6Xd B = Matrix6Xd::NullaryExpr(6, program.C_2.cols(), slope);
    return posture.J_2.cwiseProduct(A).sum() + program.C_2.cwiseProduct(B).sum();
  };
  const Capability capability = differentiated(problem, value);
  ASSERT_EQ(capability.status, Status::kOptimal);
  ASSERT_GT(capability.beta_C2.cols(), 0);
  const Matrix6Xd A = Matrix6Xd::NullaryExpr(6, problem.robot.velocities(), slope);
  const Matrix6Xd B = Matrix6Xd::NullaryExpr(6, capability.beta_C2.cols(), slope);
  EXPECT_LT((capability.beta_J2 - A).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_LT((capability.beta_C2 - B).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_EQ(capability.beta_J.lpNorm<Eigen::Infinity>(), 0);
}

/// The value of a built-in measure has its gradient by theta_r, which is exact: with a base that
/// follows, with dependent joints, with a free coordinate of the pose and with a second contact.
TEST(ValueMeasure, HasTheGradientOfTheMeasureWithThisValue) {
  for (const char* built_in : {"ellipsoid", "linf_polytope"}) {
    add_measure({"value_of_built_in", "", false, false, nullptr,
                 [built_in](const Problem& problem, std::unique_ptr<WrenchSolver>) {
                   const MeasureEntry& entry = find_measure(built_in);
                   std::shared_ptr<Measure> measure =
                       entry.make(problem, find_wrench_solver("simplex").make());
                   return make_value_measure([measure](const Posture& posture,
                                                       const WrenchProgram& program) {
                     Capability capability;
                     measure->evaluate(posture, program, false, capability);
                     return capability.status == Status::kOptimal ? capability.beta : std::nan("");
                   });
                 }});
    for (const char* name : {"planar/force", "uvms/valve", "fixed/push", "mobile/push_any_height",
                             "planar/two_arms", "dual_arm/bar_wall"}) {
      const Problem problem = load_problem(name);
      Options options;
      options.measure = built_in;
      const Answer exact = evaluate(problem, problem.theta_r_default, options);
      options.measure = "value_of_built_in";
      const Answer answer = evaluate(problem, problem.theta_r_default, options);
      ASSERT_EQ(answer.status, exact.status) << name;
      ASSERT_EQ(answer.status, Status::kOptimal) << name << ": " << answer.reason.c_str();
      EXPECT_NEAR(answer.beta(), exact.beta(), 1e-9 * (1 + std::abs(exact.beta()))) << name;
      EXPECT_EQ(answer.unit, exact.unit);
      const double scale = 1 + exact.trajectory.gradient.lpNorm<Eigen::Infinity>();
      EXPECT_LT((answer.trajectory.gradient - exact.trajectory.gradient).lpNorm<Eigen::Infinity>(),
                1e-5 * scale)
          << name << " " << built_in;
    }
  }
}

/// NaN says so; an infinity is a mistake.
TEST(ValueMeasure, HasNoValueWhereTheFunctionIsNotFinite) {
  const Problem problem = load_problem("planar/force");
  for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
    const Capability capability =
        differentiated(problem, [&](const Posture&, const WrenchProgram&) { return value; });
    EXPECT_EQ(capability.status, std::isnan(value) ? Status::kInfeasible : Status::kNumericalError);
  }
}

/// The value sum i J_1i exists at and below the posture only for even i, above it only for i = 1
/// (mod 4), and otherwise nowhere else.
TEST(ValueMeasure, TakesOneSidedDifferencesAtTheEdgeOfItsDomain) {
  const Problem problem = load_problem("uvms/lift");
  const Posture at = PostureEvaluator(problem).evaluate(problem.theta_r_default);
  const Capability capability =
      differentiated(problem, [&](const Posture& posture, const WrenchProgram&) {
        double sum = 0;
        for (Eigen::Index i = 0; i < at.J.cols(); ++i) {
          const double moved = posture.J(1, i) - at.J(1, i);
          const bool exists = i % 2 == 0 ? moved <= 0 : i % 4 == 1 ? moved >= 0 : moved == 0;
          if (!exists) return std::nan("");
          sum += double(i) * posture.J(1, i);
        }
        return sum;
      });
  ASSERT_EQ(capability.status, Status::kOptimal);
  for (Eigen::Index i = 0; i < at.J.cols(); ++i) {
    EXPECT_NEAR(capability.beta_J(1, i), i % 4 == 3 ? 0 : double(i), 1e-8) << i;
  }
}

/// A robot whose forces are all a millionth: sin(tau / s) of such a small scale s has the
/// derivative cos(tau / s) / s.
TEST(ValueMeasure, StepsFitSmallTorques) {
  constexpr double kSmall = 1e-6;
  Problem problem = load_problem("fixed/push");
  for (Link& link : problem.robot.links) link.mass *= kSmall;
  for (Joint& joint : problem.robot.joints) joint.effort_max *= kSmall;
  complete_actuation(problem.robot);
  const Posture at = PostureEvaluator(problem).evaluate(problem.theta_r_default);
  ASSERT_GT(at.tau_d.lpNorm<Eigen::Infinity>(), 0);
  ASSERT_LT(at.tau_d.lpNorm<Eigen::Infinity>(), 1e-3);
  const double scale = kSmall * 10;
  const Capability capability =
      differentiated(problem, [&](const Posture& posture, const WrenchProgram&) {
        return (posture.tau_d.array() / scale).sin().sum();
      });
  const Eigen::VectorXd slopes = (at.tau_d.array() / scale).cos() / scale;
  EXPECT_LT((capability.lambda - slopes).lpNorm<Eigen::Infinity>(), 1e-4 / scale);
}

/// Searches without gradients call the function once for each posture.
TEST(ValueMeasure, IsNotDifferentiatedWithoutNeed) {
  const Problem problem = load_problem("planar/force");
  long calls = 0;
  const auto objective = make_capability_objective(problem, Wrench::kPure, [&] {
    return make_value_measure([&](const Posture& posture, const WrenchProgram&) {
      ++calls;
      return posture.tau_d.sum();
    });
  });
  EXPECT_GT(objective->evaluate(problem.theta_r_default), -kInfinity);
  EXPECT_EQ(calls, 1);
  Eigen::VectorXd gradient;
  objective->evaluate(problem.theta_r_default, &gradient);
  EXPECT_EQ(calls, 2 + 14 * problem.robot.velocities());
}

}  // namespace
}  // namespace maxwrench
