#include "solvers/solve/row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace maxwrench {
namespace {

std::string cell_if(bool is, double value) { return is ? exact_text(value) : ""; }
std::string cell_if(bool is, const Eigen::VectorXd& v) { return is ? exact_text(v) : ""; }

}  // namespace

const std::vector<std::string>& case_columns() {
  static const std::vector<std::string> kColumns = {
      "problem", "measure", "wrench", "solver", "search", "seed", "budget", "scheme", "integrator"};
  return kColumns;
}

std::vector<std::string> case_values(const Case& c) {
  return {c.problem,
          c.measure,
          to_string(c.wrench),
          c.solver,
          c.search,
          fmt::format("{}", c.seed),
          fmt::format("{}", c.budget),
          c.scheme,
          c.integrator};
}

std::vector<std::string> value_columns() {
  std::vector<std::string> columns = case_columns();
  columns.insert(columns.end(),
                 {"status", "beta", "value_between_knots", "unit", "beta_linf", "beta_linf_unit",
                  "label", "theta_r", "h", "u", "lambda", "balance", "bounds", "dual", "gap",
                  "evaluations", "reason", "calls", "task_digest"});
  return columns;
}

std::vector<std::string> values(const Answer& answer) {
  const Trajectory& trajectory = answer.trajectory;
  const Capability& capability = answer.capability;
  const Residual& residual = answer.residual();
  const bool experiment = !answer.choice.integrator.empty();
  const bool solved = answer.has_value() && !experiment;
  const bool posture =
      solved && !answer.task->motion;  // the row does not contain a trajectory's efforts
  std::vector<std::string> cells = case_values(answer.choice);
  cells.insert(
      cells.end(),
      {to_string(answer.status), cell_if(answer.has_value(), answer.beta()),
       cell_if(std::isfinite(trajectory.value_between_knots), trajectory.value_between_knots),
       answer.unit, cell_if(std::isfinite(answer.beta_linf), answer.beta_linf), answer.task->unit(),
       answer.task->label, exact_text(stacked(trajectory.knots)),
       cell_if(posture && capability.w.size() > 0, capability.h), cell_if(posture, capability.u),
       cell_if(posture, capability.lambda), cell_if(solved, residual.balance),
       cell_if(solved, residual.bounds), cell_if(solved, residual.dual),
       cell_if(solved, residual.gap), fmt::format("{}", answer.evaluations),
       answer.has_value() && experiment ? answer.missed : answer.reason.str(),
       describe(answer.calls), answer.task->digest});
  return cells;
}

std::vector<std::string> time_columns() {
  std::vector<std::string> columns = case_columns();
  columns.insert(columns.end(), {"evaluations", "wall_s", "us_per_evaluation"});
  return columns;
}

std::vector<std::string> times(const Answer& answer) {
  std::vector<std::string> cells = case_values(answer.choice);
  cells.push_back(fmt::format("{}", answer.evaluations));
  cells.push_back(fmt::format("{:.4g}", answer.wall_s));
  const double us = 1e6 * answer.wall_s / static_cast<double>(answer.evaluations);
  cells.push_back(answer.evaluations > 0 ? fmt::format("{:.4g}", us) : "");
  return cells;
}

std::string describe(const std::vector<CallCount>& counts) {
  std::string text;
  for (const CallCount& count : counts) {
    text += fmt::format("{}{} {} {} {}", text.empty() ? "" : "; ", count.method, count.status,
                        count.calls, count.evaluations);
  }
  return text;
}

std::string exact_text(double value) { return fmt::format("{:.17g}", value); }

std::string exact_text(const Eigen::VectorXd& v) {
  std::vector<std::string> texts;
  for (const double value : v) texts.push_back(exact_text(value));
  return fmt::format("{}", fmt::join(texts, " "));
}

}  // namespace maxwrench
