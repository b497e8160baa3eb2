#include "benchmarks/report/benchmark_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <tuple>

namespace maxwrench {
namespace {

/// Rows of one instance by their solver.
using ByMethod = std::map<std::string, const ResultRow*>;

bool belongs(const ResultRow& row, bool in_time, Wrench wrench) {
  return row.choice.scheme.empty() != in_time && (in_time || row.choice.wrench == wrench);
}

using Instances = std::map<std::vector<std::string>, ByMethod>;

/// Removes instances that were not tried with every method that has rows of the same problem,
/// measure and wrench.
void keep_tried_by_all(Instances& instances) {
  constexpr std::ptrdiff_t kTask = 3;  // columns of the key
  std::map<std::vector<std::string>, std::set<std::string>> serving;
  const auto task_of = [](const std::vector<std::string>& key) {
    return std::vector<std::string>(key.begin(), key.begin() + kTask);
  };
  for (const auto& [key, by_solver] : instances) {
    for (const auto& [solver, row] : by_solver) serving[task_of(key)].insert(solver);
  }
  std::erase_if(instances, [&](const auto& instance) {
    return instance.second.size() <
           std::max<std::size_t>(2, serving.at(task_of(instance.first)).size());
  });
}

Instances instances_of(const std::vector<ResultRow>& rows, bool in_time, Wrench wrench) {
  Instances instances;
  for (const ResultRow& row : rows) {
    const Case& c = row.choice;
    if (row.is_experiment() || c.solver == kNoSolver || !belongs(row, in_time, wrench)) continue;
    if (row.solved() && !row.us) continue;  // its time was not measured
    const ResultRow*& kept = instances[{c.problem, c.measure, to_string(c.wrench), c.search,
                                        std::to_string(c.seed), c.scheme}][c.solver];
    if (kept == nullptr || kept->choice.budget < c.budget) kept = &row;
  }
  keep_tried_by_all(instances);
  return instances;
}

/// All methods on all instances; `cost` is the cost of a row that has a value.
BenchmarkSet benchmark_set_of(const std::string& title, const std::string& unit,
                              const Instances& instances,
                              const std::function<double(const ResultRow&)>& cost) {
  BenchmarkSet benchmark_set;
  benchmark_set.title = title;
  benchmark_set.unit = unit;
  std::set<std::string> methods;
  for (const auto& [key, by_method] : instances) {
    for (const auto& [method, row] : by_method) methods.insert(method);
  }
  for (const std::string& method : methods) {
    benchmark_set.methods.push_back(method);
    std::vector<double>& costs = benchmark_set.cost.emplace_back();
    for (const auto& [key, by_method] : instances) {
      const auto found = by_method.find(method);
      const bool has = found != by_method.end() && found->second->solved();
      costs.push_back(has ? cost(*found->second) : kInfinity);
    }
  }
  return benchmark_set;
}

/// Milliseconds of a search to the target for each seed of a race, infinity where it did not reach
/// it.
std::map<std::uint64_t, double> times_to_target(const Comparison& race, const std::string& search) {
  std::map<std::uint64_t, double> ms;
  for (const Contender& contender : race.contenders) {
    for (const Attempt& each : contender.attempts) {
      const double here =
          contender.search == search ? 1e3 * first_hit(each.run, race.target()).seconds : kInfinity;
      double& least = ms.try_emplace(each.choice.seed, kInfinity).first->second;
      least = std::min(least, here);
    }
  }
  return ms;
}

/// The default search of all races; empty if they differ.
std::string common_default(const std::vector<Comparison>& races) {
  const std::string& first = races.front().default_search;
  const bool same = std::all_of(races.begin(), races.end(), [&](const Comparison& race) {
    return race.default_search == first;
  });
  return same ? first : "";
}

std::string family_of(const std::string& problem) {
  const std::size_t slash = problem.rfind('/');
  return slash == std::string::npos ? problem : problem.substr(0, slash);
}

}  // namespace

std::vector<BenchmarkSet> solver_benchmark_sets(const std::vector<ResultRow>& rows) {
  std::vector<BenchmarkSet> benchmark_sets;
  for (const auto& [in_time, wrench] :
       {std::pair{false, Wrench::kPure}, {false, Wrench::kAny}, {true, Wrench::kPure}}) {
    BenchmarkSet benchmark_set = benchmark_set_of(
        in_time ? "tasks in time" : fmt::format("static tasks, wrench {}", to_string(wrench)), "us",
        instances_of(rows, in_time, wrench), [](const ResultRow& row) { return *row.us; });
    if (benchmark_set.instances() > 0) benchmark_sets.push_back(std::move(benchmark_set));
  }
  return benchmark_sets;
}

std::vector<BenchmarkSet> integrator_benchmark_sets(const std::vector<ResultRow>& rows) {
  Instances instances;
  for (const ResultRow& row : rows) {
    const Case& c = row.choice;
    if (!row.is_experiment() || (row.solved() && !row.us)) continue;
    instances[{c.problem, c.measure, to_string(c.wrench), c.solver, c.scheme}][c.integrator] = &row;
  }
  keep_tried_by_all(instances);
  if (instances.empty()) return {};
  return {benchmark_set_of("virtual tank", "ms", instances,
                           [](const ResultRow& row) { return *row.ms(); })};
}

std::vector<RaceGroup> race_groups(const std::vector<Comparison>& races) {
  RaceGroup statics{"all static tasks", {}}, in_time{"tasks in time", {}};
  std::map<std::string, RaceGroup> families;
  for (const Comparison& race : races) {
    (race.in_time ? in_time : statics).races.push_back(race);
    if (race.in_time) continue;
    RaceGroup& family = families[family_of(race.problem)];
    family.title = family_of(race.problem);
    family.races.push_back(race);
  }
  std::vector<RaceGroup> groups;
  if (!statics.races.empty()) groups.push_back(std::move(statics));
  if (families.size() > 1) {
    for (auto& [name, family] : families) groups.push_back(std::move(family));
  }
  if (!in_time.races.empty()) groups.push_back(std::move(in_time));
  return groups;
}

BenchmarkSet search_benchmark_set(const RaceGroup& group) {
  BenchmarkSet benchmark_set{group.title, "ms", {}, {}, common_default(group.races)};
  for (const Standing& standing : standings(group.races)) {
    benchmark_set.methods.push_back(standing.search);
    std::vector<double>& costs = benchmark_set.cost.emplace_back();
    for (const Comparison& race : group.races) {
      for (const auto& [seed, ms] : times_to_target(race, standing.search)) costs.push_back(ms);
    }
  }
  return benchmark_set;
}

}  // namespace maxwrench
