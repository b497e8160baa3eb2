#include "maxwrench/measure.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "benchmarks/suite/product.h"
#include "maxwrench/load.h"
#include "maxwrench/posture.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "solvers/wrench/makers.h"
#include "tests/lib/measure/measure_evaluator.h"
#include "tests/reference_models/vertices.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Every closed form, and every measure with every solver that supports the wrench.
std::vector<Case> all_cases(const std::string& problem) {
  std::vector<Case> cases = product(load_problem(problem), 1, 1);
  std::erase_if(cases, [](const Case& c) { return c.search != general_search(); });
  return cases;
}

class EveryMeasure : public testing::TestWithParam<Case> {};

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return fmt::format("{}_{}_{}", info.param.measure, to_string(info.param.wrench),
                     info.param.solver);
}

INSTANTIATE_TEST_SUITE_P(Planar, EveryMeasure, testing::ValuesIn(all_cases("planar/force")),
                         case_name);

/// The gradient against central differences of step h. A posture counts as a kink, and is left out,
/// if forward and backward difference differ by more than 1e-3 (1 + |gradient|): a smooth function
/// of curvature f'' differs by h f''.
void expect_gradients(const Problem& problem, const Case& c, int samples, double tolerance) {
  Random random(7);
  MeasureEvaluator evaluate(problem, c.measure, c.wrench, c.solver);
  const double h = c.solver == "ipopt" ? 1e-4 : 1e-5;
  int kinks = 0;
  for (int sample = 0; sample < samples; ++sample) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const Capability& capability = evaluate(theta_r);
    if (capability.status != Status::kOptimal) continue;
    const double beta = capability.beta;
    const Eigen::VectorXd gradient = evaluate.gradient(theta_r);
    Eigen::VectorXd central(theta_r.size());
    bool kink = false;
    for (Eigen::Index i = 0; i < theta_r.size(); ++i) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(theta_r.size(), i);
      const double forward = (evaluate(theta_r + step).beta - beta) / h;
      const double backward = (beta - evaluate(theta_r - step).beta) / h;
      kink = kink || std::abs(forward - backward) > 1e-3 * (1 + gradient.norm());
      central[i] = (forward + backward) / 2;
    }
    kinks += kink;
    if (!kink) {
      EXPECT_LT((gradient - central).norm(), tolerance * (1 + gradient.norm()))
          << theta_r.transpose();
    }
  }
  fmt::print("{} kinks among {} postures\n", kinks, samples);
  EXPECT_LT(kinks, 0.1 * samples + 1);
}

TEST_P(EveryMeasure, GradientEqualsCentralDifference) {
  const bool slow = GetParam().solver == "ipopt";
  // The interior point stops about 1e-10 short of the optimum: 1e-10 / h in a difference.
  expect_gradients(load_problem("planar/force"), GetParam(), samples(slow ? 20 : 1000), 1e-6);
}

TEST_P(EveryMeasure, GradientEqualsCentralDifferenceOfTheUnderwaterVehicle) {
  const bool slow = GetParam().solver == "ipopt";
  expect_gradients(load_problem("uvms/valve"), GetParam(), samples(slow ? 20 : 1000),
                   slow ? 1e-5 : 1e-6);
}

TEST_P(EveryMeasure, GradientEqualsCentralDifferenceInSpace) {
  Random random(11);
  const bool slow = GetParam().solver == "ipopt";
  Problem problem = random_problem(random, 4);
  if (GetParam().measure == "dynamic_capability") {  // of linear or angular accelerations
    problem.c.tail<3>().setZero();
    problem.c.normalize();
  }
  expect_gradients(problem, GetParam(), samples(slow ? 20 : 200), 1e-5);
}

/// Whether beta is the largest wrench along c beside the load tau_d, not a score of another kind.
bool bounded_by_load(const std::string& measure) {
  return measure == "ellipsoid" || measure == "l2_polytope" || measure == "linf_polytope" ||
         measure == "saturating_wrench";
}

TEST_P(EveryMeasure, SolversAgreeAndAnswersVerify) {
  const Case& c = GetParam();
  const Problem problem = load_problem("planar/force");
  Random random(5);
  MeasureEvaluator mine(problem, c.measure, c.wrench, c.solver);
  MeasureEvaluator reference(problem, c.measure, c.wrench);
  const bool slow = c.solver == "ipopt";
  for (int sample = 0; sample < samples(slow ? 100 : 2000); ++sample) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const Capability& capability = mine(theta_r, true);
    ASSERT_EQ(capability.status, Status::kOptimal) << capability.reason.c_str();
    const double tolerance = slow ? 1e-6 : 1e-9;
    EXPECT_NEAR(capability.beta, reference(theta_r).beta, tolerance);
    EXPECT_TRUE(capability.residual.within((slow ? 1e-6 : 1e-8) * (1 + std::abs(capability.beta))));
    // At a pure optimum beta is homogeneous in the load: lambda'J'c = -1.
    const WrenchProgram& program = mine.program();
    if (!bounded_by_load(c.measure)) continue;
    EXPECT_LT((program.JtW.transpose() * capability.lambda + program.c_w).norm(), tolerance);
  }
}

TEST(Measure, OrderAndBruteForceOnPlanarPostures) {
  // beta_ellipsoid <= beta_L2 <= beta_Linf(pure) <= beta_Linf(any): each set contains the one
  // before.
  const Problem problem = load_problem("planar/force");
  Random random(3);
  MeasureEvaluator ellipsoid(problem, "ellipsoid", Wrench::kPure);
  MeasureEvaluator l2(problem, "l2_polytope", Wrench::kPure);
  MeasureEvaluator pure(problem, "linf_polytope", Wrench::kPure);
  MeasureEvaluator any(problem, "linf_polytope", Wrench::kAny);
  constexpr double kSlack = 1e-12;
  for (int sample = 0; sample < samples(10000); ++sample) {
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    const double beta_pure = pure(theta_r).beta;
    const double beta_any = any(theta_r).beta;
    EXPECT_LE(ellipsoid(theta_r).beta, l2(theta_r).beta + kSlack);
    EXPECT_LE(l2(theta_r).beta, beta_pure + kSlack);
    EXPECT_LE(beta_pure, beta_any + kSlack);
    EXPECT_NEAR(beta_pure, brute_force(pure.program()).value_or(NAN), 1e-9);
    EXPECT_NEAR(beta_any, brute_force(any.program()).value_or(NAN), 1e-9);
  }
}

TEST(Measure, OrderUnderGravityAndAsymmetricLimits) {
  Random random(4);
  int compared = 0;
  for (int sample = 0; sample < samples(400); ++sample) {
    const Problem problem = random_problem(random, 4);
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    double last = -kInfinity;
    for (const auto& [measure, wrench] :
         std::vector<std::pair<std::string, Wrench>>{{"ellipsoid", Wrench::kPure},
                                                     {"l2_polytope", Wrench::kPure},
                                                     {"linf_polytope", Wrench::kPure},
                                                     {"linf_polytope", Wrench::kAny}}) {
      MeasureEvaluator evaluate(problem, measure, wrench);
      const Capability& capability = evaluate(theta_r, true);
      if (capability.status != Status::kOptimal) {
        // A larger set cannot be empty when a smaller one was not.
        EXPECT_EQ(last, -kInfinity) << capability.reason.c_str();
        continue;
      }
      EXPECT_GE(capability.beta, last - 1e-9 * (1 + std::abs(last)));
      EXPECT_TRUE(capability.residual.within(1e-8 * (1 + std::abs(capability.beta))));
      EXPECT_NEAR(capability.beta, problem.c.dot(capability.h),
                  1e-9 * (1 + std::abs(capability.beta)));
      last = capability.beta;
      ++compared;
    }
  }
  EXPECT_GT(compared, samples(200));
}

TEST(Measure, FacetsAndSimplexGiveTheSameVerdictOnRandomRobots) {
  Random random(6);
  int infeasible = 0;
  for (int sample = 0; sample < samples(400); ++sample) {
    Problem problem = random_problem(random, 4);
    problem.robot.gravity *= random.uniform(0, 6);  // many cannot hold their own weight
    const Eigen::VectorXd theta_r = random_theta_r(problem, random);
    MeasureEvaluator facets(problem, "linf_polytope", Wrench::kPure, "facets");
    MeasureEvaluator simplex(problem, "linf_polytope", Wrench::kPure, "simplex");
    const Capability& a = facets(theta_r);
    const Capability& b = simplex(theta_r);
    ASSERT_EQ(to_string(a.status), std::string(to_string(b.status))) << b.reason.c_str();
    infeasible += a.status == Status::kInfeasible;
    if (a.status == Status::kOptimal) {
      EXPECT_NEAR(a.beta, b.beta, 1e-9 * (1 + std::abs(a.beta)));
    }
  }
  EXPECT_GT(infeasible, samples(20));
}

/// It would pass for the proof that an infeasible capability carries.
TEST(Measure, ClosedFormsLeaveNoMultiplierOfAnEarlierAnswer) {
  const Problem problem = load_problem("uvms/valve");
  PostureEvaluator model(problem, false);
  const Posture& posture = model.evaluate(problem.theta_r_default);
  for (const char* name : {"ellipsoid", "saturating_wrench"}) {
    const auto measure = find_measure(name).make(problem, nullptr);
    WrenchProgram program = make_wrench_program(problem, Wrench::kPure);
    set_posture(posture, program);
    Capability capability;
    measure->evaluate(posture, program, false, capability);
    ASSERT_EQ(capability.status, Status::kOptimal) << name;
    ASSERT_GT(capability.lambda.norm(), 0) << name;
    program.tau_d *= 1e6;  // far more than all actuators exert
    measure->evaluate(posture, program, false, capability);
    EXPECT_EQ(capability.status, Status::kInfeasible) << name;
    EXPECT_TRUE(capability.lambda.isZero(0)) << name;
  }
}

TEST(Measure, RejectsDeficientActuation) {
  Random random(9);
  Problem problem = random_problem(random, 2);
  problem.robot.thrusters.resize(3);
  complete_actuation(problem.robot);
  EXPECT_THROW(make_ellipsoid(problem.robot), std::invalid_argument);
  EXPECT_THROW(make_l2_polytope(problem.robot, make_facets()), std::invalid_argument);
}

TEST(Measure, UnloadedWrenchIsUnboundedAndDeadRobotInfeasible) {
  // A wrench that no velocity works against is the environment's own: here the torque about x of a
  // planar robot.
  Problem problem = load_problem("planar/force");
  problem.c = Vector6d::Unit(3);
  for (const char* lp : {"facets", "simplex"}) {
    MeasureEvaluator evaluate(problem, "linf_polytope", Wrench::kPure, lp);
    EXPECT_EQ(evaluate(Eigen::Vector2d::Zero()).status, Status::kUnbounded) << lp;
  }
  Random random(10);
  Problem heavy = random_problem(random, 2);
  for (Thruster& thruster : heavy.robot.thrusters) thruster.force_min = thruster.force_max = 0;
  complete_actuation(heavy.robot);
  for (const char* lp : {"facets", "simplex"}) {
    MeasureEvaluator evaluate(heavy, "linf_polytope", Wrench::kPure, lp);
    EXPECT_EQ(evaluate(Eigen::Vector2d::Zero()).status, Status::kInfeasible) << lp;
  }
}

/// Gives up on every second posture.
class GivesUp : public Measure {
 public:
  void evaluate_well_formed(const Posture& /*posture*/, const WrenchProgram& program,
                            bool /*efforts*/, Capability& capability) override {
    capability.w.setZero(program.columns());
    capability.status = ++calls_ % 2 == 0 ? Status::kNumericalError : Status::kInfeasible;
    capability.reason = "made up";
  }

 private:
  int calls_ = 0;
};

TEST(Measure, EvaluationsWithoutAVerdictAreCounted) {
  // Two objects with five postures each: the second and the fourth have no verdict.
  const Problem problem = load_problem("planar/force");
  const auto tally = std::make_shared<Tally>();
  const auto objective = make_capability_objective(
      problem, Wrench::kPure, [] { return std::make_unique<GivesUp>(); }, false, tally);
  const auto other = objective->clone();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(objective->evaluate(problem.theta_r_default), -kInfinity);
    EXPECT_EQ(other->evaluate(problem.theta_r_default), -kInfinity);
  }
  EXPECT_EQ(tally->undecided(), 4);
}

TEST(Measure, ValueAndGradientAllocateNothingAfterTheFirstCall) {
  for (const char* name : {"planar/force", "uvms/valve"}) {
    const Problem problem = load_problem(name);
    for (const Case& c : all_cases(name)) {
      if (c.solver != kNoSolver && c.solver != "facets" && c.solver != "simplex") continue;
      const auto objective =
          make_capability_objective(problem, c.wrench, resolve(problem, c).make_measure);
      Random random(12);
      std::vector<Eigen::VectorXd> postures;
      for (int i = 0; i < 1000; ++i) postures.push_back(random_theta_r(problem, random));
      Eigen::VectorXd gradient;
      double sum = objective->evaluate(problem.theta_r_default, &gradient);
      const long before = allocation_count();
      EXPECT_TRUE(before > 0 || !kAllocationsAreCounted) << "the counter does not count";
      for (const Eigen::VectorXd& theta_r : postures) {
        const double value = objective->evaluate(theta_r, &gradient);
        if (std::isfinite(value)) sum += value;
      }
      EXPECT_EQ(allocation_count(), before) << name << " " << c.measure << " " << c.solver;
      EXPECT_TRUE(std::isfinite(sum));
    }
  }
}

}  // namespace
}  // namespace maxwrench
