#include "benchmarks/row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>

#include "lib/wrench_program.h"
#include "solvers/strategies.h"

namespace maxwrench {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string number(double value) { return fmt::format("{:.17g}", value); }

std::string numbers(const Eigen::VectorXd& v) {
  std::vector<std::string> texts;
  for (const double value : v) texts.push_back(number(value));
  return fmt::format("{}", fmt::join(texts, " "));
}

double yardstick(const Problem& problem, Wrench wrench, const Posture& posture) {
  WrenchProgram program = make_wrench_program(problem, wrench);
  set_posture(posture, program);
  const Case c = complete({problem.name, "linf_polytope", wrench, "simplex"});
  Capability capability;
  measure_maker(problem, c)()->evaluate(posture, program, false, capability);
  return capability.status == Status::kOptimal ? capability.beta
                                               : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Row evaluate(const Problem& problem, const Case& asked, const Eigen::VectorXd& theta_r,
             bool check_collision) {
  const auto start = std::chrono::steady_clock::now();
  const Case c = fit(problem, asked);
  Row row;
  row.choice = c;
  row.evaluations = 1;
  PostureModel model(problem, check_collision);
  row.posture = model.evaluate(theta_r);
  row.status = row.posture.status;
  row.reason = row.posture.reason;
  if (row.status == Status::kOptimal) {
    WrenchProgram program = make_wrench_program(problem, c.wrench);
    set_posture(row.posture, program);
    measure_maker(problem, c)()->evaluate(row.posture, program, true, row.capability);
    row.status = row.capability.status;
    row.reason = row.capability.reason;
  }
  if (row.status == Status::kOptimal) {
    model.pull_back(theta_r, row.capability.lambda, row.capability.beta_J, row.gradient);
    if (!row.capability.residual.within(kRowTolerance, row.capability.beta)) {
      row.status = Status::kNumericalError;
      row.reason = "the answer does not satisfy its program";
    }
  }
  row.wall_s = seconds_since(start);
  if (row.posture.status == Status::kOptimal) {
    row.yardstick = yardstick(problem, c.wrench, row.posture);
  }
  return row;
}

Row solve(const Problem& problem, const Case& asked, int threads,
          const std::function<void(long)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  const Case c = fit(problem, asked);
  const auto objective = make_capability_objective(problem, c.wrench, measure_maker(problem, c));
  SearchOptions options;
  options.seed = c.seed;
  options.budget = c.budget;
  options.threads = threads;
  options.progress = progress;
  options.start = problem.theta_r_default;
  const SearchResult result = find_search(c.search).make()->maximize(*objective, options);
  Row row;
  if (result.status == Status::kOptimal) {
    row = evaluate(problem, c, result.theta_r);
  } else {
    row.choice = c;
    row.status = result.status;
    row.reason = result.reason;
  }
  row.evaluations = result.evaluations;
  row.wall_s = seconds_since(start);
  return row;
}

std::vector<std::string> value_columns() {
  std::vector<std::string> columns = case_columns();
  columns.insert(columns.end(),
                 {"status", "beta", "unit", "yardstick", "yardstick_unit", "label", "theta_r", "h",
                  "u", "lambda", "balance", "bounds", "dual", "gap", "evaluations", "reason"});
  return columns;
}

std::vector<std::string> values(const Problem& problem, const Row& row) {
  std::vector<std::string> cells = case_values(row.choice);
  const auto add = [&](bool known, const std::string& text) { cells.push_back(known ? text : ""); };
  const Capability& capability = row.capability;
  const bool solved = row.has_value();
  cells.emplace_back(to_string(row.status));
  add(solved, number(capability.beta));
  cells.emplace_back(unit(problem, row.choice));
  add(std::isfinite(row.yardstick), number(row.yardstick));
  cells.emplace_back(problem.unit());
  cells.push_back(problem.label);
  add(row.has_posture(), numbers(row.posture.theta_r));
  add(solved && capability.w.size() > 0, numbers(capability.h));
  add(solved, numbers(capability.u));
  add(solved, numbers(capability.lambda));
  add(solved, number(capability.residual.balance));
  add(solved, number(capability.residual.bounds));
  add(solved, number(capability.residual.dual));
  add(solved, number(capability.residual.gap));
  cells.push_back(fmt::format("{}", row.evaluations));
  cells.push_back(row.reason);
  return cells;
}

std::vector<std::string> time_columns() {
  std::vector<std::string> columns = case_columns();
  columns.insert(columns.end(), {"evaluations", "wall_s", "us_per_evaluation"});
  return columns;
}

std::vector<std::string> times(const Row& row) {
  std::vector<std::string> cells = case_values(row.choice);
  cells.push_back(fmt::format("{}", row.evaluations));
  cells.push_back(fmt::format("{:.4g}", row.wall_s));
  cells.push_back(fmt::format("{:.4g}", 1e6 * row.wall_s / static_cast<double>(row.evaluations)));
  return cells;
}

}  // namespace maxwrench
