#include "benchmarks/suite/row_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "maxwrench/load.h"
#include "maxwrench/measure.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/method.h"
#include "solvers/solve/row.h"
#include "solvers/solve/tank.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

using Cells = std::vector<std::string>;

Cells row_of(const Problem& problem, const char* measure, Wrench wrench) {
  Case c;
  c.problem = problem.name;
  c.measure = measure;
  c.wrench = wrench;
  c.search = "";
  return values(evaluate(problem, problem.theta_r_default, {c}));
}

std::string& cell(Cells& row, const char* column) {
  const Cells columns = value_columns();
  return row[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) -
                                      columns.begin())];
}

RowCheck check(const Problem& problem, const Cells& row) {
  return check_row(problem, {"values.csv", value_columns(), {row}}, 0);
}

/// Its first number times `factor`; a zero becomes the factor.
std::string scaled(const std::string& numbers, double factor) {
  const double first = std::stod(numbers);
  return exact_text(first == 0 ? factor : first * factor) +
         numbers.substr(std::min(numbers.find(' '), numbers.size()));
}

/// Its first number and one.
std::string raised(const std::string& numbers) {
  return exact_text(std::stod(numbers) + 1) +
         numbers.substr(std::min(numbers.find(' '), numbers.size()));
}

/// Without what a row has beside a value.
Cells without_value(Cells row) {
  for (const char* column : {"beta", "h", "u", "lambda", "balance", "bounds", "dual", "gap"}) {
    cell(row, column) = "";
  }
  return row;
}

TEST(CheckRow, AcceptsWhatWasEvaluated) {
  for (const char* name : {"planar/force", "uvms/valve", "mobile/push", "dual_arm/bar_wall"}) {
    const Problem problem = load_problem(name);
    for (const char* measure : {"linf_polytope", "l2_polytope", "ellipsoid"}) {
      if (problem.contact && measure != std::string("linf_polytope")) continue;
      const RowCheck found = check(problem, row_of(problem, measure, Wrench::kPure));
      EXPECT_EQ(found.rejection, "") << name << " " << measure;
      EXPECT_TRUE(found.has_value);
    }
  }
}

/// No column is left out, in a row of each kind: a posture with and without a value, a search,
/// knots, an experiment.
TEST(CheckRow, ReadsEachColumn) {
  const Problem lift = load_problem("uvms/lift"), force = load_problem("planar/force"),
                arm = load_problem("planar/trajectory");
  const Case search = with_search(force, {.problem = force.name, .search = "slsqp", .budget = 300});
  const Case held{.problem = arm.name, .search = ""};
  const Case reading{.problem = lift.name, .search = "", .integrator = "cvode"};
  const Case beyond{.problem = lift.name, .search = ""};
  const std::vector<std::pair<const Problem&, Answer>> answers = {
      {lift, evaluate(lift, lift.theta_r_default, {beyond})},
      {force, solve(force, {search})},
      {arm, evaluate(arm, constant_knots(arm, arm.theta_r_default), {held})},
      {lift, experiment(lift, {reading})},
      {lift, evaluate(lift, 2 * lift.theta_r_max, {beyond})}};
  for (const auto& [problem, answer] : answers) {
    const Cells good = values(answer);
    ASSERT_EQ(check(problem, good).rejection, "");
    for (const std::string& column : value_columns()) {
      if (column == "problem") continue;  // the reader of a file finds the problem by it
      Cells row = good;
      cell(row, column.c_str()) = "-1";
      EXPECT_NE(check(problem, row).rejection, "") << problem.name << " " << column;
    }
  }
}

/// Each claim by itself: the value, the posture, the efforts, the wrench, the multipliers, how well
/// they balance, the evaluations. What two measures prove themselves, the others have evaluated.
TEST(CheckRow, RejectsWhatDoesNotFollow) {
  const Problem problem = load_problem("uvms/lift");
  for (const char* measure : {"linf_polytope", "l2_polytope", "ellipsoid", "least_effort"}) {
    const Cells good = row_of(problem, measure, Wrench::kPure);
    ASSERT_EQ(check(problem, good).rejection, "") << measure;
    for (const char* column : {"beta", "theta_r", "u", "h", "lambda", "balance", "bounds", "dual",
                               "gap", "evaluations"}) {
      Cells row = good;
      std::string& text = cell(row, column);
      if (text.empty()) continue;
      text = column == std::string("h") ? "1 2 3 4 5 6" : raised(text);
      EXPECT_NE(check(problem, row).rejection, "") << measure << " " << column;
    }
    Cells row = good;
    cell(row, "value_between_knots") = cell(row, "beta");
    EXPECT_EQ(check(problem, row).rejection, "value_between_knots: expected none") << measure;
  }
}

/// What a search says of its own effort: at most the budget, and its methods at most all of it.
TEST(CheckRow, RejectsMoreEvaluationsThanTheBudget) {
  const Problem problem = load_problem("planar/force");
  Case c = with_search(problem, {.problem = problem.name, .search = "slsqp", .budget = 300});
  Cells good = values(solve(problem, {c}));
  ASSERT_EQ(check(problem, good).rejection, "");
  ASSERT_NE(cell(good, "calls"), "");
  for (const auto& [column, text] : {std::pair{"evaluations", "301"},
                                     {"evaluations", "-1"},
                                     {"evaluations", "1"},
                                     {"evaluations", "0"},
                                     {"budget", "0"},
                                     {"solver", ""},
                                     {"solver", "ellipsoid"},
                                     {"search", "slsqpx"},
                                     {"search", "slsqp+facet"},
                                     {"calls", "slsqp"},
                                     {"calls", "slsqp success 1 100 more"},
                                     {"calls", "slsqp success 1 301"},
                                     {"status", "optimal"},
                                     {"status", "budget_exhausted"},
                                     {"reason", "interrupted"}}) {
    Cells row = good;
    cell(row, column) = text;
    EXPECT_NE(check(problem, row).rejection, "") << column << " " << text;
  }
}

/// A row belongs to the files of its task as they were.
TEST(CheckRow, RejectsRowsOfAnotherTask) {
  const Problem problem = load_problem("planar/force");
  Cells row = row_of(problem, "linf_polytope", Wrench::kPure);
  EXPECT_EQ(cell(row, "task_digest").size(), 16U);
  cell(row, "task_digest")[0] ^= 1;
  EXPECT_EQ(check(problem, row).rejection.find("task_digest: "), 0U);
}

TEST(CheckRow, RejectsWhatCannotBeRead) {
  const Problem problem = load_problem("planar/force");
  const Cells good = row_of(problem, "linf_polytope", Wrench::kPure);
  for (const char* column : {"beta", "theta_r", "u", "h", "lambda", "seed"}) {
    for (const char* text : {"nan", "inf", "1 x", "1e999", "0 0 0 0 0 0 0 0 0 0 0"}) {
      Cells row = good;
      cell(row, column) = text;
      EXPECT_NE(check(problem, row).rejection, "") << column << " " << text;
    }
  }
  Cells row = good;
  cell(row, "wrench") = "some";
  EXPECT_NE(check(problem, row).rejection.find("some"), std::string::npos);
}

TEST(CheckRow, AsksForAReasonWhereThereIsNoValue) {
  const Problem problem = load_problem("planar/force");
  Cells row = without_value(row_of(problem, "linf_polytope", Wrench::kPure));
  EXPECT_NE(check(problem, row).rejection, "");
  cell(row, "reason") = "the time ran out";
  EXPECT_NE(check(problem, row).rejection.find("without a value"), std::string::npos);
  for (const char* status : {"proven", "reached", "x", ""}) {
    cell(row, "status") = status;
    EXPECT_NE(check(problem, row).rejection.find("without a value"), std::string::npos) << status;
  }
  cell(row, "status") = "none_found";
  EXPECT_EQ(check(problem, row).rejection, "status: expected 'optimal'");
  cell(row, "search") = "grid";
  EXPECT_EQ(check(problem, row).rejection.find("beta: what it found has the value "), 0U);
  cell(row, "theta_r") = cell(row, "beta_linf") = "";
  EXPECT_EQ(check(problem, row).rejection, "");
  EXPECT_FALSE(check(problem, row).has_value);
}

/// What stands beside the value.
TEST(CheckRow, RejectsOtherWords) {
  const Problem problem = load_problem("uvms/lift");
  const Cells good = row_of(problem, "linf_polytope", Wrench::kPure);
  for (const auto& [column, text] :
       {std::pair{"status", "infeasible"}, {"unit", "lb"}, {"beta_linf", "1"}, {"beta_linf", ""}}) {
    Cells row = good;
    cell(row, column) = text;
    EXPECT_EQ(check(problem, row).rejection.find(column), 0U) << column << " " << text;
  }
}

/// Efforts of any posture at theta_r that is worth as much: here the wrist may be turned over.
TEST(CheckRow, AcceptsPosturesThatTie) {
  const Problem problem = load_problem("fixed/push");
  for (const char* name : {"linf_polytope", "ellipsoid"}) {
    const Case c{.problem = problem.name, .measure = name};
    const Method method = resolve(problem, c);
    const Answer best = evaluate(problem, problem.theta_r_default, {method.choice});
    PostureEvaluator model(problem);
    model.evaluate(problem.theta_r_default);
    int ties = 0;
    for (int ik_solution = 0; ik_solution < model.ik_solutions(); ++ik_solution) {
      Answer row = best;
      row.posture = model.select(ik_solution);
      WrenchProgram program = make_wrench_program(problem, c.wrench);
      set_posture(row.posture, program);
      method.make_measure()->evaluate(row.posture, program, true, row.capability);
      const bool same = std::abs(row.capability.beta - best.capability.beta) < 1e-7;
      EXPECT_EQ(check(problem, values(row)).rejection.empty(), same) << ik_solution;
      ties += same ? 1 : 0;
    }
    EXPECT_GT(ties, 1);
  }
}

/// Static, and in time; of another reading, or one that was not planned so.
TEST(CheckRow, SLOW_CarriesOutExperiments) {
  for (const auto& [name, scheme] :
       {std::pair{"mobile/push", ""}, {"mobile/trajectory", "spline"}}) {
    const Problem problem = load_problem(name);
    const Case c{.problem = name, .search = "", .scheme = scheme, .integrator = "cvode"};
    const Cells good = values(experiment(problem, {c}));
    EXPECT_EQ(check(problem, good).rejection, "") << name;
    for (const char* column :
         {"beta", "beta_linf", "unit", "status", "reason", "integrator", "theta_r"}) {
      Cells row = good;
      std::string& text = cell(row, column);
      text = text.empty() || text.front() > '9' ? "x" : scaled(text, 1.001);
      EXPECT_NE(check(problem, row).rejection, "") << name << " " << column;
    }
    Cells row = good;
    cell(row, "status") = "budget_exhausted";
    EXPECT_NE(check(problem, row).rejection, "") << name;
  }
}

/// Of rows that say that they have no value.
TEST(CheckRow, RejectsNamesAndFailuresThatAreNot) {
  const Problem problem = load_problem("uvms/lift");
  Cells good = without_value(row_of(problem, "linf_polytope", Wrench::kPure));
  cell(good, "search") = "grid";
  cell(good, "theta_r") = cell(good, "beta_linf") = "";
  cell(good, "status") = "none_found";
  cell(good, "reason") = "the time ran out";
  EXPECT_EQ(check(problem, good).rejection, "");
  for (const auto& [column, text] : {std::pair{"status", "infeasible"},
                                     {"status", "budget_exhausted"},
                                     {"reason", "interrupted"},
                                     {"reason", ""},
                                     {"unit", "N m"},
                                     {"unit", ""},
                                     {"beta_linf", "1"},
                                     {"value_between_knots", "1"},
                                     {"h", "0 0 0 0 0 0"},
                                     {"gap", "0"},
                                     {"search", "slp+grid"},
                                     {"search", "joint"},
                                     {"evaluations", "-3"},
                                     {"calls", "grid ended 1 30000"}}) {
    Cells row = good;
    cell(row, column) = text;
    EXPECT_NE(check(problem, row).rejection, "") << column << " " << text;
  }
  for (const char* column : {"measure", "solver", "search", "scheme", "integrator", "theta_r",
                             "label", "beta_linf_unit"}) {
    Cells row = good;
    cell(row, column) = "x";
    EXPECT_NE(check(problem, row).rejection, "") << column;
  }
  cell(good, "search") = "";
  cell(good, "integrator") = "cvode";
  EXPECT_EQ(check(problem, good).rejection, "status: expected 'reached'");
}

/// A posture and knots beyond the limits, evaluated: why there is no value is looked at, too.
TEST(CheckRow, EvaluatesWhatHasNoValue) {
  for (const char* name : {"uvms/lift", "planar/trajectory"}) {
    const Problem problem = load_problem(name);
    const Case c{.problem = name, .search = ""};
    const Eigen::VectorXd far = 2 * problem.theta_r_max;
    Cells row;
    if (problem.motion) {
      const Eigen::MatrixXd knots = far.transpose().replicate(knots_of(problem), 1);
      row = values(evaluate(problem, knots, {c}));
    } else {
      row = values(evaluate(problem, far, {c}));
    }
    ASSERT_EQ(cell(row, "beta"), "") << name;
    EXPECT_EQ(check(problem, row).rejection, "") << name;
    const std::string status = cell(row, "status");
    cell(row, "status") = "unbounded";
    EXPECT_EQ(check(problem, row).rejection, "status: expected '" + status + "'");
    cell(row, "status") = status;
    for (const auto& [column, text] : {std::pair{"reason", "joint limit of another"},
                                       {"unit", "lb"},
                                       {"beta_linf", "1"},
                                       {"value_between_knots", "1"},
                                       {"solver", ""}}) {
      Cells other = row;
      cell(other, column) = text;
      EXPECT_EQ(check(problem, other).rejection.find(column), 0U) << name << " " << column;
    }
    cell(row, "theta_r") = "";
    EXPECT_NE(check(problem, row).rejection.find("theta_r"), std::string::npos) << name;
  }
}

/// An experiment that cannot begin: its task has no efforts to begin with.
TEST(CheckRow, CarriesOutExperimentsWithoutAReading) {
  const Problem problem = load_problem("uvms/valve_trajectory_fast");
  const Case c{.problem = problem.name, .search = "", .scheme = "ends", .integrator = "cvode"};
  Problem changed = problem;
  set_scheme("scheme", c.scheme, changed);
  Cells good = values(experiment(changed, {c}));
  ASSERT_EQ(cell(good, "beta"), "");
  EXPECT_EQ(check(problem, good).rejection, "");
  for (const auto& [column, text] : {std::pair{"value_between_knots", "1"},
                                     {"unit", "lb"},
                                     {"beta_linf", "1"},
                                     {"theta_r", ""},
                                     {"reason", "interrupted"},
                                     {"status", "none_found"},
                                     {"solver", ""},
                                     {"calls", "x"}}) {
    Cells row = good;
    cell(row, column) = text;
    EXPECT_EQ(check(problem, row).rejection.find(column), 0U) << column << " " << text;
  }
}

TEST(CheckRow, EvaluatesTrajectories) {
  const Problem problem = load_problem("planar/trajectory");
  const Case c{.problem = problem.name, .search = ""};
  Problem changed = problem;
  const Method method = resolve(changed, c);
  const Answer row =
      evaluate(changed, constant_knots(changed, changed.theta_r_default), {method.choice});
  ASSERT_TRUE(row.has_value());
  Cells cells = values(row);
  EXPECT_EQ(check(problem, cells).rejection, "");
  Cells other = cells;
  cell(other, "value_between_knots") = scaled(cell(other, "value_between_knots"), 1.01);
  EXPECT_EQ(check(problem, other).rejection.find("value_between_knots"), 0U);
  cell(cells, "beta") = scaled(cell(cells, "beta"), 1.01);
  EXPECT_NE(check(problem, cells).rejection.find("has the value"), std::string::npos);
}

}  // namespace
}  // namespace maxwrench
