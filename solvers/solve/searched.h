#pragma once

#include <chrono>

#include "solvers/solve/case.h"
#include "solvers/solve/interruption.h"
#include "maxwrench/search.h"

namespace maxwrench {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Whether a row that ended so is what was asked for.
inline bool answers(Status row) { return row == Status::kOptimal || row == Status::kBestFound; }

/// Whether a row that ended so has a value, if its lower level ended so: an interrupted search may
/// have one too.
inline bool counts(Status row, Status lower_level) {
  return answers(row) || (row == Status::kBudgetExhausted && lower_level == Status::kOptimal);
}

/// What the search of a method maximises.
std::unique_ptr<Objective> make_objective(const Problem& problem, const Method& method,
                                          std::shared_ptr<Tally> tally = nullptr);
std::unique_ptr<Objective> make_objective(const Problem&&, const Method&,
                                          std::shared_ptr<Tally> = nullptr) = delete;

/// How often a method of a search ended so, and what that took.
struct CallCount {
  std::string method, status;
  long calls = 0, evaluations = 0;
};
/// In the order in which they first appear.
std::vector<CallCount> count_calls(const std::vector<Call>& calls);
/// "slsqp xtol_reached 12 340; slsqp failure 1 20": calls and evaluations.
std::string describe(const std::vector<CallCount>& counts);

/// Runs the search of a case from `start`.
SearchResult search(const Case& c, const NamedSearch& named, Objective& objective,
                    const Eigen::VectorXd& start, int threads,
                    const std::function<void(long)>& progress);

/// Makes the row of a posture, or plan, that a search found the row of that search: what it took,
/// and its word, for `optimal` is one of the lower level.
template <class AnyRow>
void conclude_search(const SearchResult& result, const Interruption* interruption, AnyRow& row) {
  row.evaluations = result.evaluations;
  row.calls = count_calls(result.calls);
  if (row.status == Status::kOptimal) row.conclude(Status::kBestFound);
  if (row.status == Status::kInfeasible) {  // true of what was found, not of the task
    row.conclude(Status::kNoneFound, "of the best that was found: " + row.reason.str());
  }
  if (interruption == nullptr || !interruption->noticed) return;
  row.evaluations -= interruption->skipped;
  if (row.status != Status::kNumericalError) {
    row.conclude(Status::kBudgetExhausted, "interrupted");
  }
}

}  // namespace maxwrench
