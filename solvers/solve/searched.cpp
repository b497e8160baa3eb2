#include "solvers/solve/searched.h"

#include <fmt/format.h>

#include <algorithm>

#include "maxwrench/plan.h"
#include "maxwrench/strategies.h"

namespace maxwrench {

std::unique_ptr<Objective> make_objective(const Problem& problem, const Method& method,
                                          std::shared_ptr<Tally> tally) {
  const Wrench wrench = method.choice.wrench;
  if (method.plan_solver) return make_plan_objective(problem, wrench, method.plan_solver->make);
  return make_capability_objective(problem, wrench, method.make_measure, true, std::move(tally));
}

std::vector<CallCount> count_calls(const std::vector<Call>& calls) {
  std::vector<CallCount> counts;
  for (const Call& call : calls) {
    const auto same = std::find_if(counts.begin(), counts.end(), [&](const CallCount& count) {
      return count.method == call.method && count.status == call.status;
    });
    CallCount& count = same != counts.end()
                           ? *same
                           : counts.emplace_back(CallCount{call.method, call.status, 0, 0});
    ++count.calls;
    count.evaluations += call.evaluations;
  }
  return counts;
}

std::string describe(const std::vector<CallCount>& counts) {
  std::string text;
  for (const CallCount& count : counts) {
    text += fmt::format("{}{} {} {} {}", text.empty() ? "" : "; ", count.method, count.status,
                        count.calls, count.evaluations);
  }
  return text;
}

SearchResult search(const Case& c, const NamedSearch& named, Objective& objective,
                    const Eigen::VectorXd& start, int threads,
                    const std::function<void(long)>& progress) {
  SearchOptions options;
  options.seed = c.seed;
  options.budget = c.budget;
  options.threads = threads;
  options.progress = progress;
  options.start = start;
  return named.make()->maximize(objective, options);
}

}  // namespace maxwrench
