#include "solvers/solve/row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "maxwrench/measure.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {
namespace {

double yardstick(const Problem& problem, const Method& method, const Posture& posture) {
  WrenchProgram program = make_wrench_program(problem, method.choice.wrench);
  set_posture(posture, program);
  Capability capability;
  method.make_yardstick()->evaluate(posture, program, false, capability);
  return capability.status == Status::kOptimal ? capability.beta
                                               : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Row evaluate(const Problem& problem, const Method& method, const Eigen::VectorXd& theta_r,
             bool check_collision) {
  const auto start = std::chrono::steady_clock::now();
  Row row;
  row.choice = method.choice;
  row.unit = method.unit;
  row.evaluations = 1;
  PostureEvaluator model(problem, check_collision);
  WrenchProgram program = make_wrench_program(problem, method.choice.wrench);
  row.posture =
      evaluate_best(model, theta_r, *method.make_measure(), true, program, row.capability);
  row.branches = row.posture.branches;
  const bool valid = row.posture.status == Status::kValid;
  static_cast<Verdict&>(row) = valid ? Verdict(row.capability) : Verdict(row.posture);
  if (!valid) row.reason = describe_violation(problem, row.posture);
  if (row.status == Status::kOptimal) {
    model.pull_back(theta_r, row.capability, row.gradient);
    if (!row.capability.residual.within(kRowTolerance * (1 + std::abs(row.capability.beta)))) {
      row.conclude(Status::kNumericalError, "the answer does not satisfy its program");
    }
  }
  row.wall_s = seconds_since(start);
  if (valid) row.yardstick = yardstick(problem, method, row.posture);
  return row;
}

Row solve(const Problem& problem, const Method& method, int threads,
          const std::function<void(long)>& progress, Interruption* interruption) {
  const auto start = std::chrono::steady_clock::now();
  const auto tally = std::make_shared<Tally>();
  const auto objective = make_interruptible(make_objective(problem, method, tally), interruption);
  const SearchResult result =
      search(method.choice, *method.search, *objective, problem.theta_r_default, threads, progress);
  const double search_s = seconds_since(start);
  Row row;
  if (result.status == Status::kBestFound) {
    row = evaluate(problem, method, result.theta_r);
  } else {
    static_cast<Verdict&>(row) = result;
    row.choice = method.choice;
    row.unit = method.unit;
  }
  conclude_search(result, interruption, row);
  row.undecided = tally->undecided();
  row.branches = tally->sum();
  row.wall_s += search_s;
  return row;
}

std::vector<std::string> value_columns() {
  std::vector<std::string> columns = case_columns();
  columns.insert(
      columns.end(),
      {"status", "beta", "continuous", "unit", "yardstick", "yardstick_unit", "label", "theta_r",
       "h", "u", "lambda", "balance", "bounds", "dual", "gap", "evaluations", "reason", "calls"});
  return columns;
}

std::vector<std::string> values(const Problem& problem, const Row& row) {
  std::vector<std::string> cells = case_values(row.choice);
  const auto add = [&](bool known, const std::string& text) { cells.push_back(known ? text : ""); };
  const Capability& capability = row.capability;
  const bool solved = row.has_value();
  cells.emplace_back(to_string(row.status));
  add(solved, exact_text(capability.beta));
  cells.emplace_back();  // continuous is what plans have
  cells.emplace_back(row.unit);
  add(std::isfinite(row.yardstick), exact_text(row.yardstick));
  cells.emplace_back(problem.unit());
  cells.push_back(problem.label);
  add(row.has_posture(), exact_text(row.posture.theta_r));
  add(solved && capability.w.size() > 0, exact_text(capability.h));
  add(solved, exact_text(capability.u));
  add(solved, exact_text(capability.lambda));
  add(solved, exact_text(capability.residual.balance));
  add(solved, exact_text(capability.residual.bounds));
  add(solved, exact_text(capability.residual.dual));
  add(solved, exact_text(capability.residual.gap));
  cells.push_back(fmt::format("{}", row.evaluations));
  cells.push_back(row.reason.str());
  cells.push_back(describe(row.calls));
  return cells;
}

std::vector<std::string> time_columns() {
  std::vector<std::string> columns = case_columns();
  columns.insert(columns.end(), {"evaluations", "wall_s", "us_per_evaluation"});
  return columns;
}

std::vector<std::string> times(const Case& c, long evaluations, double wall_s) {
  std::vector<std::string> cells = case_values(c);
  cells.push_back(fmt::format("{}", evaluations));
  cells.push_back(fmt::format("{:.4g}", wall_s));
  const double us = 1e6 * wall_s / static_cast<double>(evaluations);
  cells.push_back(evaluations > 0 ? fmt::format("{:.4g}", us) : "");
  return cells;
}

std::string exact_text(double value) { return fmt::format("{:.17g}", value); }

std::string exact_text(const Eigen::VectorXd& v) {
  std::vector<std::string> texts;
  for (const double value : v) texts.push_back(exact_text(value));
  return fmt::format("{}", fmt::join(texts, " "));
}

}  // namespace maxwrench
