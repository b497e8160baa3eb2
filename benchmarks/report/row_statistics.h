#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/suite/results.h"

// Statistics of the rows of a run.

namespace maxwrench {

/// The rows of one problem, measure, wrench and scheme.
struct TaskSummary {
  Case choice;  ///< these columns, and the best row's
  std::string unit;
  long rows = 0, solved = 0;
  std::optional<double> best;  ///< among the solved rows
};
std::vector<TaskSummary> summarise_tasks(const std::vector<ResultRow>& rows);

/// One search, over all its rows of a run that has values.
struct SearchSummary {
  std::string search;
  long rows = 0, solved = 0;
  long near = 0;             ///< number of solved rows within 0.1 % of the best of their task
  double below = kInfinity;  ///< the median of their shortfall, as a share
  double us = kInfinity;     ///< the median time of an evaluation in microseconds
};
/// Best first: by the share of rows that are near, then by `below`.
std::vector<SearchSummary> summarise_searches(const std::vector<ResultRow>& rows);

/// The time of an evaluation of a search with one lower-level solver on one problem.
struct CostSummary {
  std::string problem, scheme, solver;
  Wrench wrench = Wrench::kPure;
  long rows = 0;
  double us = kInfinity;  ///< the median, with its 95 % bootstrap interval
  double us_low = 0, us_high = 0;
};
std::vector<CostSummary> summarise_costs(const std::vector<ResultRow>& rows);

/// Rows without a value that ended in the same way, with any measure, wrench, search and seed.
struct FailureSummary {
  std::string problem, scheme, solver, integrator, status, reason;
  long rows = 0;
};
/// The most frequent first.
std::vector<FailureSummary> summarise_failures(const std::vector<ResultRow>& rows);

}  // namespace maxwrench
