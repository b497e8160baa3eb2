#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "solvers/solve/method.h"
#include "tests/support/refusals.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

TEST(Solve, RejectsOptionsOutOfRange) {
  for (const char* name : {"planar/force", "planar/trajectory"}) {
    const Problem problem = load_problem(name);
    const auto rejected = [&](const char* key, const auto& spoil) {
      Options options;
      spoil(options);
      expect_rejected(key, [&] { solve(problem, options); });
    };
    for (const int threads : {-1, 1025}) {
      rejected("threads", [&](Options& options) { options.threads = threads; });
    }
    for (const long budget : {-1L, long{kMostBudget} + 1}) {
      rejected("budget", [&](Options& options) { options.budget = budget; });
    }
    for (const double bad : {std::nan(""), kInfinity}) {
      const Eigen::MatrixXd theta_r =
          Eigen::MatrixXd::Constant(knots_of(problem), problem.redundancy(), bad);
      EXPECT_THROW(evaluate(problem, theta_r), std::invalid_argument);
    }
  }
}

/// Every search, of postures, trajectories and between facets, ends soon after it is asked to, and
/// has what it found before.
TEST(Solve, EndsSoonWhenItIsInterrupted) {
  const long last = kSanitized ? 100 : 400;
  for (const char* name : {"planar/force", "planar/trajectory"}) {
    const Problem problem = load_problem(name);
    std::vector<std::string> names = supported_searches(problem, "linf_polytope", Wrench::kPure);
    names.insert(names.end(), {"sample+cmaes", "restart:sample+cmaes"});
    for (const std::string& search : names) {
      SCOPED_TRACE(search + " on " + name);
      std::atomic<long> asked = 0;
      Options options;
      options.search = search;
      options.budget = 1'000'000;
      options.threads = 2;
      options.interrupted = [&] { return ++asked >= last; };
      const Answer answer = solve(problem, options);
      if (asked < last) continue;  // it came to its end before
      EXPECT_EQ(answer.status, Status::kBudgetExhausted);
      EXPECT_EQ(answer.stopped, "interrupted");
      EXPECT_LE(answer.evaluations, last + 2);
      // The first points of these may have no value.
      const bool blind = search == "grid" || search.find("sample") != std::string::npos;
      EXPECT_TRUE(answer.has_value() || blind);
    }
  }
}

}  // namespace
}  // namespace maxwrench
