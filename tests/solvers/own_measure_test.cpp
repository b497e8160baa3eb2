#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/method.h"
#include "tests/support/own_strategies.h"
#include "tests/support/refusals.h"

namespace maxwrench {
namespace {

/// The best posture by a grid of the only coordinate.
TEST(OwnMeasure, IsSolvedByItsName) {
  add_measure(ease_entry("own_ease"));
  const Problem problem = load_problem("fixed/push");
  ASSERT_EQ(problem.redundancy(), 1);
  PostureEvaluator model(problem);
  double best = -kInfinity;
  for (int i = 0; i <= 2000; ++i) {
    const Posture& posture = model.evaluate(
        problem.theta_r_min + i / 2000.0 * (problem.theta_r_max - problem.theta_r_min));
    if (posture.status != Status::kValid) continue;
    for (int k = 0; k < model.ik_solutions(); ++k) {
      best = std::max(best, -model.select(k).tau_d.squaredNorm());
    }
  }
  const Answer answer = solve(problem, of_measure("own_ease", "", 3000));
  EXPECT_EQ(answer.status, Status::kBestFound);
  EXPECT_EQ(answer.choice.measure, "own_ease");
  EXPECT_EQ(answer.choice.solver, kNoSolver);
  EXPECT_EQ(answer.choice.search, general_search());
  EXPECT_EQ(answer.unit, "N^2");
  EXPECT_GE(answer.beta(), best - 1e-9 * std::abs(best));
  EXPECT_NEAR(answer.beta(), best, 1e-4 * std::abs(best));
  EXPECT_TRUE(answer.residual().within(0));
  EXPECT_NEAR(answer.beta_linf, evaluate(problem, answer.posture.theta_r).beta(), 1e-6);
  EXPECT_NE(summary(answer).find("own_ease"), std::string::npos);
  EXPECT_NE(to_json(answer).find("\"measure\":\"own_ease\""), std::string::npos);
}

TEST(OwnMeasure, IsEvaluatedInAPostureByItsName) {
  add_measure(ease_entry("own_ease"));
  const Problem problem = load_problem("planar/force");
  const Posture posture = PostureEvaluator(problem).evaluate(problem.theta_r_default);
  const Answer answer = evaluate_posture(problem, posture.q, of_measure("own_ease"));
  EXPECT_EQ(answer.status, Status::kOptimal);
  EXPECT_NEAR(answer.beta(), -posture.tau_d.squaredNorm(), 1e-9);
}

/// With a solver it is the built-in measure, with every one of them.
TEST(OwnMeasure, GetsTheChosenSolver) {
  add_measure({"own_linf", "the same again", true, true, nullptr,
               [](const Problem& problem, std::unique_ptr<WrenchSolver> solver) {
                 return make_linf_polytope(problem.robot, std::move(solver));
               }});
  const Problem problem = load_problem("planar/force");
  for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
    for (const std::string& solver : supported_solvers(problem, "linf_polytope", wrench)) {
      Options options;
      options.wrench = wrench;
      options.solver = solver;
      const Answer built_in = evaluate(problem, problem.theta_r_default, options);
      options.measure = "own_linf";
      const Answer own = evaluate(problem, problem.theta_r_default, options);
      EXPECT_EQ(own.beta(), built_in.beta()) << solver;
      EXPECT_EQ(own.unit, problem.unit());
      EXPECT_EQ(own.choice.solver, solver);
    }
  }
  Options options = of_measure("own_linf");
  options.solver = kNoSolver;
  expect_rejected("solver", [&] { evaluate(problem, problem.theta_r_default, options); });
}

TEST(OwnMeasure, RejectsWhatItDoesNotSupport) {
  add_measure(ease_entry("own_ease"));
  const Problem problem = load_problem("planar/force");
  Options options = of_measure("own_ease");
  options.wrench = Wrench::kAny;
  expect_rejected("wrench", [&] { solve(problem, options); });
  options = of_measure("own_ease");
  options.solver = "simplex";
  expect_rejected("solver", [&] { solve(problem, options); });
  for (const auto& table : {trajectory_searches(), facet_searches()}) {
    for (const SearchEntry& search : table) {
      EXPECT_THROW(solve(problem, of_measure("own_ease", search.name, 100)), std::invalid_argument)
          << search.name;
    }
  }
  expect_rejected(
      "measure", [] { solve(load_problem("planar/trajectory"), of_measure("own_ease", "", 100)); });
}

/// Every answer has a gradient, so a measure without derivatives has no answer.
TEST(OwnMeasure, MustFillItsDerivatives) {
  add_measure({"own_silent", "", false, false, "-",
               [](const Problem&, auto) { return std::make_unique<OwnEase>(1, true); }});
  const Problem problem = load_problem("planar/force");
  for (const char* search : {"cmaes", "slsqp"}) {
    expect_rejected("derivatives", [&] { solve(problem, of_measure("own_silent", search, 100)); });
  }
}

TEST(OwnMeasure, MayHaveNoValueInAPlace) {
  // No value at theta_r[0] above the default.
  const Problem problem = load_problem("planar/force");
  const double limit = problem.theta_r_default[0];
  add_measure({"own_half", "", false, false, "-", [limit](const Problem&, auto) {
                 return make_value_measure([limit](const Posture& posture, const WrenchProgram&) {
                   const double x = posture.theta_r[0];
                   return x > limit ? std::nan("") : x;
                 });
               }});
  const Answer answer = solve(problem, of_measure("own_half", "", 4000));
  EXPECT_EQ(answer.status, Status::kBestFound);
  EXPECT_LE(answer.beta(), limit);
  EXPECT_NEAR(answer.beta(), limit, 1e-3);
  Eigen::VectorXd above = problem.theta_r_default;
  above[0] += 1e-3;
  const Answer none = evaluate(problem, above, of_measure("own_half"));
  EXPECT_EQ(none.status, Status::kInfeasible);
  EXPECT_EQ(none.reason.str(), "the measure has no value here");
  EXPECT_EQ(answer.undecided, 0);
}

/// Most postures of this task collide. That is no reason where the measure has a posture.
TEST(OwnMeasure, ASearchSaysThatItHasNoValueWhereThereIsAPosture) {
  add_measure({"own_nowhere", "", false, false, "-", [](const Problem&, auto) {
                 return make_value_measure(
                     [](const Posture&, const WrenchProgram&) { return std::nan(""); });
               }});
  const Problem problem = load_problem("uvms/valve");
  const Answer answer = solve(problem, of_measure("own_nowhere", "sample", 50));
  EXPECT_EQ(answer.status, Status::kNoneFound);
  const std::string reason = answer.reason.str();
  const std::string expected =
      "nothing that was evaluated has a value: the measure has no value here at theta_r = ";
  ASSERT_EQ(reason.substr(0, expected.size()), expected);
  std::istringstream numbers(reason.substr(expected.size()));
  Eigen::MatrixXd theta_r(1, problem.redundancy());
  for (double& number : theta_r.reshaped()) numbers >> number;
  EXPECT_EQ(evaluate(problem, theta_r).status, Status::kOptimal);
}

}  // namespace
}  // namespace maxwrench
