#include "benchmarks/report/row_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "benchmarks/race/race_statistics.h"
#include "benchmarks/race/significance.h"

namespace maxwrench {
namespace {

using TaskKey = std::tuple<std::string, std::string, Wrench, std::string>;

TaskKey task_of(const Case& c) { return {c.problem, c.measure, c.wrench, c.scheme}; }

std::map<TaskKey, TaskSummary> tasks_by_key(const std::vector<ResultRow>& rows) {
  std::map<TaskKey, TaskSummary> tasks;
  for (const ResultRow& row : rows) {
    if (row.is_experiment()) continue;
    TaskSummary& task = tasks[task_of(row.choice)];
    if (task.rows++ == 0) task.choice = row.choice;
    if (task.unit.empty()) task.unit = row.unit;
    if (!row.solved()) continue;
    ++task.solved;
    if (task.best && *row.beta <= *task.best) continue;
    task.best = row.beta;
    task.choice = row.choice;
  }
  return tasks;
}

/// The shortfall of a value from the best, as a share of it.
double share_below(double best, double beta) {
  return best == beta ? 0 : (best - beta) / std::abs(best);
}

}  // namespace

std::vector<TaskSummary> summarise_tasks(const std::vector<ResultRow>& rows) {
  std::vector<TaskSummary> tasks;
  for (auto& [key, task] : tasks_by_key(rows)) tasks.push_back(std::move(task));
  return tasks;
}

std::vector<SearchSummary> summarise_searches(const std::vector<ResultRow>& rows) {
  struct Sample {
    SearchSummary summary;
    std::vector<double> below, us;
  };
  const std::map<TaskKey, TaskSummary> tasks = tasks_by_key(rows);
  std::map<std::string, Sample> samples;
  for (const ResultRow& row : rows) {
    if (row.choice.search.empty()) continue;
    Sample& sample = samples[row.choice.search];
    ++sample.summary.rows;
    if (row.us) sample.us.push_back(*row.us);
    const bool solved = row.solved();
    sample.summary.solved += solved ? 1 : 0;
    sample.below.push_back(solved ? share_below(*tasks.at(task_of(row.choice)).best, *row.beta)
                                  : kInfinity);
    sample.summary.near += sample.below.back() <= 1e-3 ? 1 : 0;
  }
  std::vector<SearchSummary> all;
  for (auto& [search, sample] : samples) {
    SearchSummary& summary = all.emplace_back(sample.summary);
    summary.search = search;
    summary.below = median(sample.below);
    summary.us = median(sample.us);
  }
  const auto missed = [](const SearchSummary& each) {
    return 1 - static_cast<double>(each.near) / static_cast<double>(each.rows);
  };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return std::tuple(missed(a), a.below) < std::tuple(missed(b), b.below);
  });
  return all;
}

std::vector<CostSummary> summarise_costs(const std::vector<ResultRow>& rows) {
  using Key = std::tuple<std::string, std::string, Wrench, std::string>;
  std::map<Key, std::vector<double>> samples;
  for (const ResultRow& row : rows) {
    const Case& c = row.choice;
    if (row.us && !c.search.empty())
      samples[{c.problem, c.scheme, c.wrench, c.solver}].push_back(*row.us);
  }
  std::vector<CostSummary> costs;
  for (const auto& [key, us] : samples) {
    const auto& [problem, scheme, wrench, solver] = key;
    const ConfidenceInterval interval = median_interval(us);
    costs.push_back({problem, scheme, solver, wrench, static_cast<long>(us.size()), median(us),
                     interval.low, interval.high});
  }
  return costs;
}

std::vector<FailureSummary> summarise_failures(const std::vector<ResultRow>& rows) {
  std::map<std::vector<std::string>, FailureSummary> failures;
  for (const ResultRow& row : rows) {
    if (row.solved()) continue;
    const Case& c = row.choice;
    FailureSummary& failure =
        failures[{c.problem, c.scheme, c.solver, c.integrator, row.status, row.reason}];
    ++failure.rows;
    failure.problem = c.problem;
    failure.scheme = c.scheme;
    failure.solver = c.solver;
    failure.integrator = c.integrator;
    failure.status = row.status;
    failure.reason = row.reason;
  }
  std::vector<FailureSummary> all;
  for (auto& [key, failure] : failures) all.push_back(std::move(failure));
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.rows > b.rows; });
  return all;
}

}  // namespace maxwrench
