// Derivatives of the measures of accelerations, against differences, and what they reject.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/objective.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "tests/lib/measure/planar_arm.h"
#include "tests/support/coded_tasks.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using testing::HasSubstr;
using Vector = Eigen::VectorXd;

/// For dependent joints, free poses and fixed bases, too. A kink is left out, where the differences
/// to both sides disagree.
void expect_gradient(const Problem& problem, const std::string& measure, int wanted) {
  const auto f = make_capability_objective(
      problem, Wrench::kPure, resolve(problem, {problem.name, measure}).make_measure, false);
  Random random(24);
  constexpr double kChange = 1e-6;
  int compared = 0;
  for (int sample = 0; sample < 400 && compared < wanted; ++sample) {
    const Vector theta_r = random_theta_r(problem, random);
    Vector gradient;
    const double value = f->evaluate(theta_r, &gradient);
    if (!std::isfinite(value)) continue;
    for (int k = 0; k < problem.redundancy(); ++k) {
      const Vector step = kChange * Vector::Unit(theta_r.size(), k);
      const double after = f->evaluate(theta_r + step, nullptr);
      const double before = f->evaluate(theta_r - step, nullptr);
      const double difference = (after - before) / (2 * kChange);
      const double scale = 1 + std::abs(value) + std::abs(difference);
      if (!(std::abs(after - 2 * value + before) < 1e-3 * kChange * scale)) continue;
      EXPECT_NEAR(gradient[k], difference, 1e-5 * scale)
          << problem.name << " " << measure << " " << problem.theta_r_name(k);
      ++compared;
    }
  }
  EXPECT_GE(compared, wanted) << problem.name << " " << measure;
}

TEST(DynamicDerivatives, GradientsEqualDifferences) {
  for (const char* name : {"planar/force", "uvms/valve", "uvms/lift", "mobile/push",
                           "mobile/push_any_height", "fixed/push", "gallery/gen3/push"}) {
    const Problem problem = load_problem(name);
    for (const char* measure : kDynamicMeasures) expect_gradient(problem, measure, samples(40));
  }
}

TEST(DynamicDerivatives, DerivativesByTheJointsAreLeftToTheirMeasure) {
  const Problem problem = load_problem("uvms/valve");
  PostureEvaluator model(problem);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  Capability capability = value_at(problem, kDynamicMeasures[0], posture);
  ASSERT_EQ(capability.status, Status::kOptimal);
  EXPECT_GT(capability.beta_q.norm(), 0);
  Vector alone, after;
  capability.beta_q.conservativeResize(2);
  EXPECT_THAT(rejection_of([&] { model.pull_back(problem.theta_r_default, capability, after); }),
              HasSubstr("got 2 columns by q"));
  WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
  set_posture(posture, program);
  for (const char* measure : {"linf_polytope", "manipulability"}) {
    const auto other = resolve(problem, {problem.name, measure}).make_measure();
    Capability used = value_at(problem, kDynamicMeasures[0], posture), fresh;
    other->evaluate(posture, program, false, used);
    other->evaluate(posture, program, false, fresh);
    model.pull_back(problem.theta_r_default, used, after);
    model.pull_back(problem.theta_r_default, fresh, alone);
    EXPECT_EQ(after, alone) << measure;
    EXPECT_EQ(fresh.beta_q.size(), 0) << measure;
  }
}

TEST(DynamicDerivatives, SaysWhyThereIsNoValue) {
  PlanarArm arm;
  const auto why = [&](const char* measure, const Posture& posture) {
    const Capability found = value_at(arm.problem, measure, posture);
    EXPECT_EQ(found.status, Status::kNumericalError) << measure;
    EXPECT_TRUE(found.lambda.isZero(0));
    return found.reason.str();
  };
  Posture unknown = arm.posture(0.3, 0.7);
  unknown.q.resize(0);
  Posture spoiled = arm.posture(0.3, 0.7);
  spoiled.q[1] = kNan;
  for (const char* measure : kDynamicMeasures) {
    EXPECT_EQ(value_at(arm.problem, measure, arm.posture(0.3, 0.7)).status, Status::kOptimal);
    EXPECT_THAT(why(measure, arm.posture(0.3, 0)), HasSubstr("singular"));  // stretched
    EXPECT_THAT(why(measure, spoiled), HasSubstr("M is singular"));
    EXPECT_THAT(why(measure, unknown), HasSubstr("no joint positions"));
  }
  arm.problem.robot.links[2].mass = 0;
  arm.problem.robot.links[2].inertia.setZero();
  for (const char* measure : kDynamicMeasures) {
    EXPECT_THAT(why(measure, arm.posture(0.3, 0.7)), HasSubstr("M is singular"));
  }
}

TEST(DynamicDerivatives, TasksAndRobotsWithoutAccelerationsAreRejected) {
  const Problem contact = load_problem("planar/two_arms");
  Problem lacking = load_problem("planar/force");
  lacking.robot.no_dynamics = {{"link[tip].inertial.mass", "0", "a mass > 0"}};
  Problem geared = load_problem("planar/force");
  geared.robot.joints[1].gear = Gear{0, 1, 0};
  for (const char* measure : kDynamicMeasures) {
    const auto rejection = [&](const Problem& problem) {
      const Method method = resolve(problem, {problem.name, measure});
      return rejection_of([&] { method.make_measure(); });
    };
    const std::string measure_key = std::string("measure ") + measure + ": ";
    EXPECT_THAT(rejection(contact),
                HasSubstr(measure_key + "planar/two_arms has a second contact"));
    EXPECT_THAT(rejection(lacking), HasSubstr(measure_key + "link[tip].inertial.mass: got 0"));
    EXPECT_THAT(rejection(geared), HasSubstr(measure_key + "joint elbow of planar vehicle has a"));
    for (const Problem& problem : {contact, lacking, geared}) {
      EXPECT_TRUE(supported_solvers(problem, measure, Wrench::kPure).empty());
    }
    EXPECT_FALSE(supported_solvers(load_problem("planar/force"), measure, Wrench::kPure).empty());
    EXPECT_THAT(rejection_of([&] {
                  resolve(lacking, {lacking.name, measure, Wrench::kAny});
                }),
                HasSubstr("does not support, expected pure"));
  }
  Problem mixed = load_problem("planar/force");
  mixed.c << 0.6, 0, 0, 0, 0, 0.8;
  EXPECT_THAT(rejection_of([&] { make_dynamic_capability(mixed); }),
              HasSubstr("c of planar/force has both force and torque"));
  EXPECT_NO_THROW(make_dynamic_manipulability(mixed));
  EXPECT_STREQ(resolve(mixed, {mixed.name, kDynamicMeasures[0]}).unit, "mixed");
  const Problem force = load_problem("planar/force"), torque = load_problem("uvms/valve");
  EXPECT_STREQ(resolve(force, {force.name, kDynamicMeasures[0]}).unit, "m/s^2");
  EXPECT_STREQ(resolve(torque, {torque.name, kDynamicMeasures[1]}).unit, "rad/s^2");
}

}  // namespace
}  // namespace maxwrench
