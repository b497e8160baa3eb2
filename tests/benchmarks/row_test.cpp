#include "benchmarks/row.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "problems/loader.h"
#include "solvers/strategies.h"
#include "tests/support.h"

namespace maxwrench {
namespace {

/// The converged optima of the planar problem [N]; the paper prints 1.91, 3.47 and 3.88.
double planar_optimum(const Case& c) {
  if (c.measure == "ellipsoid") return 1.9075;
  return c.wrench == Wrench::kPure ? 3.4775 : 3.8806;
}

/// Whether the lower level is somebody else's: slower, and none of ours to sanitize.
bool is_peer(const Case& c) { return c.lp == "clp" || c.lp == "glpk" || c.lp == "ipopt"; }

/// The rows that the paper has a number for.
std::vector<Case> planar_cases() {
  std::vector<Case> cases;
  for (Case c : product("planar/force", 1, 40000)) {
    const bool beta_1 = c.measure == "ellipsoid" && c.wrench == Wrench::kPure;
    if (!beta_1 && c.measure != "linf_polytope") continue;
    c.budget = c.lp == "ipopt" ? 2000 : is_peer(c) ? 20000 : c.search == "grid" ? 400000 : 40000;
    cases.push_back(c);
  }
  return cases;
}

class PlanarOptimum : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(All, PlanarOptimum, testing::ValuesIn(planar_cases()),
                         [](const testing::TestParamInfo<Case>& named) {
                           const Case& c = named.param;
                           return fmt::format("{}_{}_{}_{}", c.measure, to_string(c.wrench), c.lp,
                                              c.search);
                         });

TEST_P(PlanarOptimum, IsFoundByEverySolverAndSearch) {
  if (kSampleDivisor > 1 && is_peer(GetParam())) {
    GTEST_SKIP() << "thousands of solves by a library take too long under sanitizers";
  }
  const Problem problem = load_problem("planar/force");
  const Row row = solve(problem, GetParam(), 2);
  ASSERT_EQ(row.status, Status::kOptimal) << row.reason;
  if (find_search(GetParam().search).local) {
    EXPECT_LT(row.capability.beta, planar_optimum(GetParam()) + 1e-3);
  } else {
    EXPECT_NEAR(row.capability.beta, planar_optimum(GetParam()), 1e-3);
  }
  EXPECT_LE(row.evaluations, GetParam().budget);
  EXPECT_TRUE(row.capability.residual.within(kRowTolerance, row.capability.beta));
}

TEST(Row, SearchByIpoptMayEvaluateByIpopt) {
  if (kSampleDivisor > 1) GTEST_SKIP() << "interior point solves take too long under sanitizers";
  const Problem problem = load_problem("planar/force");
  const Row row = solve(
      problem, {problem.name, "linf_polytope", Wrench::kPure, "ipopt", "multistart", 1, 200}, 2);
  EXPECT_EQ(row.status, Status::kOptimal) << row.reason;
  EXPECT_LE(row.evaluations, 200);
}

TEST(Row, SelfCollisionDoesNotChangeThePlanarOptima) {
  const Problem checked = load_problem("planar/force");
  Problem unchecked = checked;
  unchecked.robot.collision = nullptr;
  ASSERT_TRUE(checked.robot.collision != nullptr);
  for (const char* measure : {"ellipsoid", "linf_polytope"}) {
    const Case c = complete({checked.name, measure, Wrench::kPure});
    EXPECT_NEAR(solve(checked, c, 1).capability.beta, solve(unchecked, c, 1).capability.beta, 1e-9);
  }
}

TEST(Row, EveryMeasureIsReadBesideTheSameYardstick) {
  const Problem problem = load_problem("uvms/valve");
  const Eigen::Vector4d theta_r(3, 1.2, 1.1, 0.4);
  for (Case c : product(problem.name, 1, 1)) {
    c.search.clear();
    const Case common{problem.name, "linf_polytope", c.wrench, "simplex"};
    const Row row = evaluate(problem, c, theta_r);
    ASSERT_TRUE(row.has_value()) << c.measure << ": " << row.reason;
    EXPECT_EQ(row.yardstick, evaluate(problem, common, theta_r).capability.beta);
    EXPECT_EQ(values(problem, row).size(), value_columns().size());
    const bool wrench = find_measure(c.measure).unit == nullptr;
    EXPECT_STREQ(unit(problem, c), wrench ? "N m" : find_measure(c.measure).unit);
  }
  // A posture that does not exist has none.
  const Row none = evaluate(problem, complete({problem.name}), Eigen::Vector4d(9, 9, 9, 9));
  EXPECT_TRUE(std::isnan(none.yardstick));
}

TEST(Row, KeepsStatusAndReasonOfWhatHasNoValue) {
  Random random(1);
  Problem problem = random_problem(random, 2);
  problem.robot.gravity = 1000;  // nothing can hold this
  const Case c = complete({problem.name, "linf_polytope", Wrench::kPure, "simplex", "grid", 1, 50});
  const Row row = solve(problem, c, 1);
  EXPECT_EQ(row.status, Status::kInfeasible);
  EXPECT_FALSE(row.reason.empty());
  EXPECT_FALSE(row.has_posture());
  EXPECT_EQ(values(problem, row).size(), value_columns().size());
  EXPECT_EQ(times(row).size(), time_columns().size());
}

}  // namespace
}  // namespace maxwrench
