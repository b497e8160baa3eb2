#include "solvers/search/starts.h"

#include <utility>

#include "maxwrench/batch.h"
#include "solvers/search/probe.h"

namespace maxwrench {

std::vector<Candidate> starts_among(const std::vector<Eigen::VectorXd>& near, Objective& objective,
                                    long& budget) {
  std::vector<Candidate> starts;
  for (const Eigen::VectorXd& theta_r : near) {
    if (budget <= 1) break;
    --budget;
    const double value = evaluate_one(objective, theta_r);
    if (value > -kInfinity) starts.push_back({theta_r, value});
  }
  if (starts.empty()) return starts;
  const auto count = static_cast<long>(starts.size());
  return select_apart(Box(objective), std::move(starts), kApart, count);
}

void include_starts(const std::vector<Candidate>& starts, SearchResult& result) {
  if (starts.empty() || starts.front().value <= result.value) return;
  result.conclude(Status::kBestFound);
  result.theta_r = starts.front().theta_r;
  result.value = starts.front().value;
}

}  // namespace maxwrench
