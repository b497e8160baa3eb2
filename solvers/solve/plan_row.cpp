#include "solvers/solve/plan_row.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "solvers/solve/row.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"

namespace maxwrench {

PlanMethod resolve_plan(const Problem& problem, const Case& c) {
  const char* scheme = to_string(problem.motion->scheme);
  if (!c.scheme.empty() && c.scheme != scheme) {
    throw std::invalid_argument(
        fmt::format("scheme: got '{}', expected {}, that of the task", c.scheme, scheme));
  }
  PlanMethod method;
  method.choice = c;
  if (std::string_view(find_measure(c.measure).name) != Case().measure) {
    throw std::invalid_argument("measure: got '" + c.measure + "', expected " + Case().measure +
                                ": a task in time has no other");
  }
  method.solver = c.lp.empty() ? &plan_solvers().front() : &find_plan_solver(c.lp);
  method.choice.lp = method.solver->name;
  method.choice.scheme = scheme;
  if (!c.search.empty()) method.search = find_plan_search(c.search);
  return method;
}

Case complete(const Problem& problem, const Case& c) {
  return problem.motion ? resolve_plan(problem, c).choice : resolve(problem, c).choice;
}

Eigen::MatrixXd constant_knots(const Problem& problem, const Eigen::VectorXd& theta_r) {
  return theta_r.transpose().replicate(problem.motion->k, 1);
}

bool PlanRow::has_value() const { return counts(status, plan.status); }

PlanRow evaluate_plan(const Problem& problem, const PlanMethod& method,
                      const Eigen::MatrixXd& knots, bool check_collision) {
  const auto start = std::chrono::steady_clock::now();
  PlanRow row;
  row.choice = method.choice;
  row.unit = problem.unit();
  row.collision = check_collision && problem.robot.collision != nullptr;
  row.evaluations = 1;
  PlanEvaluator evaluator(problem, method.choice.wrench, method.solver->make, check_collision);
  const Plan& plan = evaluator.evaluate(knots);
  if (plan.status != Status::kInvalidPosture) {
    // A check, the same for all rows: a solver that takes minutes for its instants tells no more.
    const auto checker = plan_solvers().front().make();
    evaluator.evaluate_continuous(checker.get());
  }
  static_cast<Verdict&>(row) = plan;
  row.plan = plan;
  row.clearance = evaluator.least_clearance();
  row.program = evaluator.program();
  row.wall_s = seconds_since(start);
  return row;
}

PlanRow solve_plan(const Problem& problem, const PlanMethod& method, int threads,
                   const std::function<void(long)>& progress, Interruption* interruption) {
  const auto start = std::chrono::steady_clock::now();
  const auto objective = make_interruptible(
      make_plan_objective(problem, method.choice.wrench, method.solver->make), interruption);
  const Eigen::VectorXd constant = stacked(constant_knots(problem, problem.theta_r_default));
  const SearchResult result =
      search(method.choice, *method.search, *objective, constant, threads, progress);
  PlanRow row;
  if (result.status == Status::kBestFound) {
    row = evaluate_plan(problem, method, unstacked(result.theta_r, knots_of(problem)));
  } else {
    static_cast<Verdict&>(row) = result;
    row.choice = method.choice;
    row.unit = problem.unit();
  }
  conclude_search(result, interruption, row);
  row.wall_s = seconds_since(start);
  return row;
}

std::vector<std::string> values(const Problem& problem, const PlanRow& row) {
  const Plan& plan = row.plan;
  const Residual& residual = plan.solution.residual;
  const bool solved = row.has_value();
  const auto known = [](bool is, double value) { return is ? exact_text(value) : std::string(); };
  std::vector<std::string> cells = case_values(row.choice);
  cells.insert(
      cells.end(),
      {to_string(row.status), known(solved, plan.value),
       known(std::isfinite(plan.continuous), plan.continuous), row.unit, "", problem.unit(),
       problem.label, exact_text(stacked(plan.knots)), "", "", "", known(solved, residual.balance),
       known(solved, residual.bounds), known(solved, residual.dual), known(solved, residual.gap),
       fmt::format("{}", row.evaluations), row.reason.str(), describe(row.calls)});
  return cells;
}

}  // namespace maxwrench
