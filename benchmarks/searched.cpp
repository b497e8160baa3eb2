#include "benchmarks/searched.h"

#include "maxwrench/strategies.h"

namespace maxwrench {

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
