#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/solve/method.h"
#include "tests/support/known.h"
#include "tests/support/objectives.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

bool is_not_among(std::initializer_list<std::string_view> names, const char* name) {
  return std::find(names.begin(), names.end(), name) == names.end();
}

/// Flat, huge, tiny, steep and with holes: no library's method may end a search by what it makes of
/// the numbers. pagmo's CMA-ES asks for points that are no numbers where all values are equal.
TEST(HardNumbers, EndNoSearch) {
  struct Function {
    const char* name;
    Known::Function f;
  };
  const Function functions[] = {
      {"flat", [](const Eigen::VectorXd&) { return 1.0; }},
      {"huge", [](const Eigen::VectorXd& x) { return 1e308 * std::sin(x.sum()); }},
      {"tiny", [](const Eigen::VectorXd& x) { return 1e-310 * x.sum(); }},
      {"steep", [](const Eigen::VectorXd& x) { return -std::exp(700 * x[0]); }},
      {"steps", [](const Eigen::VectorXd& x) { return std::floor(3 * x[0]); }},
      {"nearly nowhere",
       [](const Eigen::VectorXd& x) { return x.norm() < 1e-3 ? 1.0 : -kInfinity; }},
  };
  const Eigen::VectorXd low = Eigen::VectorXd::Constant(3, -1), high = -low;
  for (const SearchEntry& entry : searches()) {
    for (const Function& function : functions) {
      SCOPED_TRACE(std::string(entry.name) + ", " + function.name);
      const bool looks_at_start = is_not_among({"sample", "grid", "direct_l"}, entry.name);
      if (!looks_at_start && function.name == std::string("nearly nowhere")) continue;
      Known objective(function.f, low, high);
      SearchOptions options;
      options.budget = samples(3000);
      options.start = Eigen::VectorXd::Zero(3);
      const SearchResult result = find_search(entry.name).make()->maximize(objective, options);
      EXPECT_EQ(result.status, Status::kBestFound);
      EXPECT_LE(result.evaluations, options.budget);
      EXPECT_TRUE(std::isfinite(result.value));
      if (looks_at_start) {
        EXPECT_GE(result.value, function.f(options.start));
      }
    }
  }
}

/// Ipopt would go on through 40 iterations of each start.
TEST(HardNumbers, InterruptedSearchesEvaluateNoMore) {
  const Problem problem = load_problem("planar/force");
  const Method method = resolve(problem, {problem.name});
  for (const SearchEntry& entry : searches()) {
    for (const long evaluations : {1, 7, 50, 333}) {
      SCOPED_TRACE(std::string(entry.name) + ' ' + std::to_string(evaluations));
      const auto objective = make_objective(problem, method);
      SearchOptions options;
      const Interruption interruption(evaluations, options);
      options.budget = 20000;
      options.start = problem.theta_r_default;
      const SearchResult result = find_search(entry.name).make()->maximize(*objective, options);
      EXPECT_EQ(interruption.left(), evaluations - result.evaluations);
      EXPECT_TRUE(result.interrupted || result.evaluations < evaluations);
      EXPECT_LE(result.evaluations, evaluations);
      if (is_not_among({"sample", "grid"}, entry.name)) {
        EXPECT_EQ(result.status, Status::kBestFound);
      }
    }
  }
}

/// The same method, problem and seed give the same row, whatever ran before in this process.
TEST(HardNumbers, SLOW_EveryMethodRepeatsItselfInOneProcess) {
  for (const char* name : {"planar/force", "planar/trajectory", "uvms/lift_impulse"}) {
    const Problem problem = load_problem(name);
    for (const std::string& search : supported_searches(problem, "linf_polytope", Wrench::kPure)) {
      SCOPED_TRACE(search + " on " + name);
      Options options;
      options.search = search;
      options.budget = 100;
      options.seed = 3;
      const Answer first = solve(problem, options);
      options.threads = 3;
      const Answer second = solve(problem, options);
      EXPECT_EQ(first.status, second.status);
      if (first.answered()) {
        EXPECT_EQ(first.beta(), second.beta());
      }
      EXPECT_EQ(first.evaluations, second.evaluations);
    }
  }
}

/// Ipopt and the MUMPS below it keep nothing from one program to the next, nor does the objective:
/// `joint_nlp` takes the same path again, after itself, after other searches by Ipopt, with other
/// threads, and from an objective that has been elsewhere.
TEST(HardNumbers, SLOW_JointNlpRepeatsItself) {
  for (const char* name : {"uvms/valve", "uvms/valve_trajectory", "mobile/trajectory"}) {
    const Problem problem = load_problem(name);
    const Case c{.problem = problem.name, .search = "joint_nlp"};
    const auto objective = make_objective(problem, resolve(problem, c));
    for (const long budget : {50, 100, 200}) {
      SCOPED_TRACE(std::string(name) + ' ' + std::to_string(budget));
      SearchOptions options;
      options.budget = budget;
      options.start = stacked(constant_knots(problem, problem.theta_r_default));
      const auto run = [&](const char* search, Objective& of, int threads) {
        options.threads = threads;
        return find_search(search).make()->maximize(of, options);
      };
      const SearchResult first = run("joint_nlp", *objective->clone(), 1);
      ASSERT_EQ(first.status, Status::kBestFound);
      for (int again = 0; again < 3; ++again) {
        run(again == 0 ? "multistart" : "slp", *objective, 1);
        const SearchResult next = run("joint_nlp", *objective, 1 + again);
        EXPECT_EQ(next.value, first.value);
        EXPECT_EQ(next.theta_r, first.theta_r);
        EXPECT_EQ(next.evaluations, first.evaluations);
      }
    }
  }
}

}  // namespace
}  // namespace maxwrench
