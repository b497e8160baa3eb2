#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/suite/results.h"

// The rows of a run, gathered.

namespace maxwrench {

/// What all rows of a problem, measure, wrench and scheme tell about their task.
struct TaskSummary {
  Case choice;  ///< of these columns, and of the best row
  std::string unit;
  long rows = 0, solved = 0;
  std::optional<double> best;  ///< of the solved rows
};
std::vector<TaskSummary> summarise_tasks(const std::vector<ResultRow>& rows);

/// One search over all rows of a run that has values.
struct SearchSummary {
  std::string search;
  long rows = 0, solved = 0;
  long near = 0;             ///< of the solved those within 0.1 % of the best of their task
  double below = kInfinity;  ///< the median of how far they stay below it, as a share
  double us = kInfinity;     ///< the median of the microseconds of an evaluation
};
/// Best first: by the share of rows that are near, then by `below`.
std::vector<SearchSummary> summarise_searches(const std::vector<ResultRow>& rows);

/// What an evaluation of a search costs with one lower-level solver on one problem.
struct CostSummary {
  std::string problem, scheme, solver;
  Wrench wrench = Wrench::kPure;
  long rows = 0;
  double us = kInfinity;  ///< median, with its bootstrap interval of 95 %
  double us_low = 0, us_high = 0;
};
std::vector<CostSummary> summarise_costs(const std::vector<ResultRow>& rows);

/// Rows without a value that ended alike, whatever measure, wrench, search and seed.
struct FailureSummary {
  std::string problem, scheme, solver, integrator, status, reason;
  long rows = 0;
};
/// The most frequent first.
std::vector<FailureSummary> summarise_failures(const std::vector<ResultRow>& rows);

}  // namespace maxwrench
