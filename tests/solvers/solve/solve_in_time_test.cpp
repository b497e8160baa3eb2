#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "maxwrench/load.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

std::string cell(const Answer& row, const char* column) {
  const std::vector<std::string> columns = value_columns();
  const auto at = std::find(columns.begin(), columns.end(), column) - columns.begin();
  return values(row).at(static_cast<std::size_t>(at));
}

/// The table in a row repeats its value.
TEST(SolveInTime, CellsRepeatTheirValue) {
  const Problem problem = load_problem("planar/trajectory");
  const Method method =
      resolve(problem, {problem.name, "linf_polytope", Wrench::kPure, "", "slp", 1, 60, "spline"});
  const Answer row = solve(problem, {method.choice, 1});
  ASSERT_TRUE(row.has_value());
  EXPECT_EQ(values(row).size(), value_columns().size());
  std::istringstream text(cell(row, "theta_r"));
  Eigen::VectorXd x(problem.motion->k * problem.redundancy());
  for (double& value : x) text >> value;
  const Answer again = evaluate(problem, unstacked(x, knots_of(problem)), {method.choice});
  EXPECT_EQ(std::stod(cell(row, "beta")), again.trajectory.value);
  EXPECT_EQ(std::stod(cell(row, "value_between_knots")), again.trajectory.value_between_knots);
}

TEST(SolveInTime, KeepsWhatHasNoValue) {
  const Problem problem = load_problem("planar/trajectory");
  const Method method = resolve(problem, {.problem = problem.name, .search = ""});
  const Answer row =
      evaluate(problem, constant_knots(problem, 2 * problem.theta_r_max), {method.choice});
  EXPECT_EQ(row.status, Status::kInvalidPosture);
  EXPECT_EQ(values(row).size(), value_columns().size());
  EXPECT_EQ(cell(row, "beta"), "");
  EXPECT_NE(cell(row, "reason"), "");
}

/// A case does not change what the problem says.
TEST(SolveInTime, CaseAndTaskAgreeOnTheScheme) {
  const Problem problem = load_problem("planar/trajectory");
  EXPECT_EQ(resolve(problem, {.problem = problem.name}).choice.scheme, "spline");
  EXPECT_THROW(resolve(problem, {.problem = problem.name, .scheme = "ends"}),
               std::invalid_argument);
}

}  // namespace
}  // namespace maxwrench
