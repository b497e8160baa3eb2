#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "tests/support/own_strategies.h"
#include "tests/support/refusals.h"

namespace maxwrench {
namespace {

/// The optimum of the paper's first example is 1.9075 N.
TEST(OwnSearch, IsUsedByItsNameInStagesAndRestarts) {
  add_search(random_entry("own_random"));
  const Problem problem = load_problem("planar/force");
  for (const char* name :
       {"own_random", "own_random+cmaes", "sample+own_random", "restart:own_random",
        "restart:own_random+cmaes", "own_random+own_random"}) {
    SCOPED_TRACE(name);
    Options options = of_measure("ellipsoid", name, 3000);
    options.threads = 1;
    const Answer one = solve(problem, options);
    EXPECT_EQ(one.status, Status::kBestFound);
    EXPECT_EQ(one.choice.search, name);
    EXPECT_NEAR(one.beta(), 1.9075, 0.02);
    EXPECT_LE(one.evaluations, 3000);
    options.threads = 4;
    const Answer many = solve(problem, options);
    EXPECT_EQ(many.posture.theta_r, one.posture.theta_r);
    EXPECT_EQ(many.evaluations, one.evaluations);
  }
  add_search(random_entry("own_first", false));
  EXPECT_NO_THROW(find_search("own_first+cmaes"));
  expect_rejected("search", [] { find_search("sample+own_first"); });
  // A task in time offers its knots.
  const Answer motion =
      solve(load_problem("planar/trajectory"), of_measure("linf_polytope", "own_random", 20));
  EXPECT_EQ(motion.evaluations, 20);
}

TEST(OwnSearch, IsInterrupted) {
  add_search(random_entry("own_random"));
  for (const char* name : {"own_random", "restart:own_random"}) {
    for (const long last : {1L, 50L}) {
      std::atomic<long> asked = 0;
      Options options = of_measure("ellipsoid", name, 100000);
      options.threads = 1;
      options.interrupted = [&] { return ++asked > last; };
      const Answer answer = solve(load_problem("planar/force"), options);
      EXPECT_EQ(answer.status, Status::kBudgetExhausted) << name;
      EXPECT_EQ(answer.stopped, "interrupted");
      EXPECT_EQ(answer.evaluations, last);
    }
  }
}

/// Stages and restarts rely on the counts; without them a restart would never end.
TEST(OwnSearch, RejectsResultsWithoutMeaning) {
  SearchResult result;
  add_search({"own_result", "", false,
              [&] { return std::make_unique<OwnResult>([&](const auto&) { return result; }); },
              true});
  const auto rejected = [&] {
    for (const char* name : {"own_result", "sample+own_result", "restart:own_result"}) {
      expect_rejected("search", [&] {
        solve(load_problem("planar/force"), of_measure("ellipsoid", name, 1000));
      });
    }
  };
  for (const long evaluations : {0L, -1L, 1001L}) {
    result.evaluations = evaluations;
    rejected();
  }
  result.evaluations = 1;
  result.value = 1;
  result.conclude(Status::kBestFound);
  rejected();  // without theta_r
  result.theta_r = Eigen::VectorXd::Zero(9);
  rejected();
  const int r = load_problem("planar/force").redundancy();
  result.theta_r = Eigen::VectorXd::Constant(r, NAN);
  rejected();
  result.theta_r = Eigen::VectorXd::Constant(r, 9);  // rad, beyond the limits
  rejected();
  result.theta_r.setZero(r);
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
    result.value = value;
    rejected();
  }
  result.value = 1;
  for (const Candidate& start :
       {Candidate{Eigen::VectorXd::Zero(r + 1), 1}, Candidate{Eigen::VectorXd::Constant(r, NAN), 1},
        Candidate{Eigen::VectorXd::Constant(r, 9), 1},
        Candidate{Eigen::VectorXd::Zero(r), -kInfinity}}) {
    result.starts = {start};
    rejected();
  }
}

}  // namespace
}  // namespace maxwrench
