#pragma once

#include "solvers/solve/searched.h"
#include "maxwrench/plan.h"

namespace maxwrench {

struct PlanSolverEntry;

/// `Method` of a task in time.
struct PlanMethod {
  Case choice;  ///< complete: nothing is left to defaults
  const PlanSolverEntry* solver = nullptr;
  std::optional<NamedSearch> search;  ///< none: the plan is given
};

/// As `resolve`, of a task in time, whose scheme a case may name and not change. An empty `lp` is
/// the first plan solver.
PlanMethod resolve_plan(const Problem& problem, const Case& c);

/// The case with nothing left to defaults, of any task; throws as `resolve` and `resolve_plan`.
Case complete(const Problem& problem, const Case& c);

/// What is usual for a search of plans: one evaluation costs about a thousand times that of a
/// posture.
inline constexpr long kPlanBudget = 5000;

/// One theta_r throughout, k×r.
Eigen::MatrixXd constant_knots(const Problem& problem, const Eigen::VectorXd& theta_r);

/// `Row` of a task in time: what a table of theta_r is worth, re-checked from the problem's data.
struct PlanRow : Verdict {
  Case choice;
  const char* unit = "";  ///< of the value
  bool collision = true;  ///< whether knots that collide were refused
  Plan plan;
  std::optional<Clearance> clearance;  ///< the least between knots too
  PlanProgram program;  ///< of the plan, whose value is its optimum; refers to the problem
  long evaluations = 0;
  std::vector<CallCount> calls;  ///< of the methods of the search
  double wall_s = 0;

  bool has_plan() const { return plan.knots.rows() > 0; }
  bool has_value() const;
};

/// Evaluates a table k×r with `continuous`.
PlanRow evaluate_plan(const Problem& problem, const PlanMethod& method,
                      const Eigen::MatrixXd& knots, bool check_collision = true);
PlanRow evaluate_plan(const Problem&& problem, const PlanMethod& method,
                      const Eigen::MatrixXd& knots, bool check_collision = true) = delete;

/// Searches the best table from the constant default and evaluates it anew, as `solve` of a
/// posture.
PlanRow solve_plan(const Problem& problem, const PlanMethod& method, int threads,
                   const std::function<void(long)>& progress = {},
                   Interruption* interruption = nullptr);
PlanRow solve_plan(const Problem&& problem, const PlanMethod& method, int threads,
                   const std::function<void(long)>& progress = {},
                   Interruption* interruption = nullptr) = delete;

/// The cells of `value_columns`: beta is the value, theta_r the table row by row.
std::vector<std::string> values(const Problem& problem, const PlanRow& row);

}  // namespace maxwrench
