#include "benchmarks/searched.h"

#include "maxwrench/plan.h"
#include "maxwrench/strategies.h"

namespace maxwrench {

std::unique_ptr<Objective> make_objective(const Problem& problem, const Method& method,
                                          std::shared_ptr<Tally> tally) {
  const Wrench wrench = method.choice.wrench;
  if (method.plan_solver) return make_plan_objective(problem, wrench, method.plan_solver->make);
  return make_capability_objective(problem, wrench, method.make_measure, true, std::move(tally));
}

SearchResult search(const Case& c, const SearchEntry& entry, Objective& objective,
                    const Eigen::VectorXd& start, int threads,
                    const std::function<void(long)>& progress) {
  SearchOptions options;
  options.seed = c.seed;
  options.budget = c.budget;
  options.threads = threads;
  options.progress = progress;
  options.start = start;
  return entry.make()->maximize(objective, options);
}

}  // namespace maxwrench
