#include "solvers/solve/plan_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "solvers/solve/row.h"
#include "maxwrench/load.h"

namespace maxwrench {
namespace {

std::string cell(const PlanRow& row, const Problem& problem, const char* column) {
  const std::vector<std::string> columns = value_columns();
  const auto at = std::find(columns.begin(), columns.end(), column) - columns.begin();
  return values(problem, row).at(static_cast<std::size_t>(at));
}

/// The table in a row repeats its value.
TEST(PlanRow, CellsRepeatTheirValue) {
  const Problem problem = load_problem("planar/trajectory");
  const PlanMethod method = resolve_plan(
      problem, {problem.name, "linf_polytope", Wrench::kPure, "", "slp", 1, 60, "spline"});
  const PlanRow row = solve_plan(problem, method, 1);
  ASSERT_TRUE(row.has_value());
  EXPECT_EQ(values(problem, row).size(), value_columns().size());
  std::istringstream text(cell(row, problem, "theta_r"));
  Eigen::VectorXd x(problem.motion->k * problem.redundancy());
  for (double& value : x) text >> value;
  const PlanRow again = evaluate_plan(problem, method, unstacked(x, knots_of(problem)));
  EXPECT_EQ(std::stod(cell(row, problem, "beta")), again.plan.value);
  EXPECT_EQ(std::stod(cell(row, problem, "continuous")), again.plan.continuous);
}

TEST(PlanRow, KeepsWhatHasNoValue) {
  const Problem problem = load_problem("planar/trajectory");
  const PlanMethod method = resolve_plan(problem, {.problem = problem.name, .search = ""});
  const PlanRow row =
      evaluate_plan(problem, method, constant_knots(problem, 2 * problem.theta_r_max));
  EXPECT_EQ(row.status, Status::kInvalidPosture);
  EXPECT_EQ(values(problem, row).size(), value_columns().size());
  EXPECT_EQ(cell(row, problem, "beta"), "");
  EXPECT_NE(cell(row, problem, "reason"), "");
}

/// A case does not change what the problem says.
TEST(PlanRow, CaseAndTaskAgreeOnTheScheme) {
  const Problem problem = load_problem("planar/trajectory");
  EXPECT_EQ(complete(problem, {.problem = problem.name}).scheme, "spline");
  EXPECT_THROW(resolve_plan(problem, {.problem = problem.name, .scheme = "ends"}),
               std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
