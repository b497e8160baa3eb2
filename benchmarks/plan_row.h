#pragma once

#include "benchmarks/searched.h"
#include "maxwrench/plan.h"

namespace maxwrench {

struct PlanSolverEntry;

/// `Method` of a task in time.
struct PlanMethod {
  Case choice;  ///< complete: nothing is left to defaults
  const PlanSolverEntry* solver = nullptr;
  const SearchEntry* search = nullptr;  ///< null: none
};

/// As `resolve`, of a task in time. An empty `lp` is the first plan solver.
PlanMethod resolve_plan(const Case& c);

/// `Row` of a task in time: what a table of theta_r is worth, re-checked from the problem's data.
struct PlanRow : Verdict {
  Case choice;
  const char* unit = "";  ///< of the value
  bool collision = true;  ///< whether knots that collide were refused
  Plan plan;
  PlanProgram program;  ///< of the plan, whose value is its optimum; refers to the problem
  long evaluations = 0;
  double wall_s = 0;

  bool has_plan() const { return plan.knots.size() > 0; }
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

}  // namespace maxwrench
