#include "benchmarks/suite/cost.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <string_view>

#include "benchmarks/tables/table.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

// Measured on two cores at 2.1 GHz: microseconds of one evaluation of a static task.
constexpr double kPosture = 8;
constexpr double kSecondContact = 12;
constexpr double kDependentJoints = 50;
/// Additional microseconds for each unit of `WrenchSolverEntry::cost`.
constexpr double kSolver = 12;
constexpr double kIpopt = 3300;
// Additional microseconds of one evaluation in a search by Ipopt.
constexpr double kIpoptInPosture = 80;

/// For a task in time with kActuators actuators and a pure wrench: one evaluation, where most
/// evaluations end at an instant without balance; and the programs in the knots of a hundred
/// evaluations of `slp`.
constexpr double kActuators = 12;
constexpr struct {
  const char* solver;
  double us, slp_s;
} kTrajectoryCosts[] = {
    {"simplex", 1000, 5}, {"ipopt", 8000, 8}, {"glpk", 300, 0.4}, {"clp", 200, 0.2}};
constexpr double kOursInTime_us = 100;
constexpr double kOursSlp_s = 0.12;
/// Factors: of `slp` with any wrench, and of an evaluation where most have a value (by Ipopt).
constexpr double kAnyWrench = 4;
constexpr double kGoodTrajectories = 10;

/// Seconds of an experiment in the virtual tank.
constexpr double kExperiment_s = 0.5;
constexpr double kExperimentByIda_s = 4;

bool searches_by_ipopt(const Case& c) {
  if (c.search.empty()) return false;
  const std::vector<const SearchEntry*> stages = find_search(c.search).stages;
  return std::any_of(stages.begin(), stages.end(),
                     [](const SearchEntry* stage) { return one_at_a_time(stage->name); });
}

bool searches_by_slp(const Case& c) {
  const std::vector<const SearchEntry*> stages = find_search(c.search).stages;
  return std::any_of(stages.begin(), stages.end(), [](const SearchEntry* stage) {
    return stage->name == std::string_view("slp");
  });
}

double in_time_seconds(const Problem& problem, const Case& c) {
  double us = kOursInTime_us, slp_s = kOursSlp_s;
  for (const auto& entry : kTrajectoryCosts) {
    if (entry.solver != c.solver) continue;
    us = entry.us;
    slp_s = entry.slp_s;
  }
  if (searches_by_ipopt(c)) us *= kGoodTrajectories;
  const double size = std::pow(problem.robot.actuators() / kActuators, 3);
  const double more = c.wrench == Wrench::kAny ? kAnyWrench : 1;
  if (searches_by_slp(c)) us += 1e4 * slp_s * more;
  return 1e-6 * us * static_cast<double>(c.budget) * size;
}

double static_seconds(const Problem& problem, const Case& c) {
  double us = problem.contact ? kSecondContact : kPosture;
  if (!problem.dependent.empty()) us = std::max(us, kDependentJoints);
  if (searches_by_ipopt(c)) us += kIpoptInPosture;
  if (one_at_a_time(c.solver)) {
    us += kIpopt;
  } else if (c.solver != kNoSolver) {
    us += kSolver * (find_wrench_solver(c.solver).cost - 1);
  }
  return 1e-6 * us * static_cast<double>(c.budget);
}

std::string without_seed_and_budget(const std::vector<std::string>& row) {
  std::string text;
  for (std::size_t i = 0; i < case_columns().size(); ++i) {
    if (case_columns()[i] != "seed" && case_columns()[i] != "budget") text += row[i] + '\n';
  }
  return text;
}

/// Zero for text that is not a positive number.
double positive(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = error == std::errc() && end == cell.data() + cell.size();
  return whole && std::isfinite(value) && value > 0 ? value : 0;
}

}  // namespace

bool waits_for_others(const Case& c) { return one_at_a_time(c.solver) || searches_by_ipopt(c); }

double usual_seconds(const Problem& problem, const Case& c) {
  if (c.integrator == "ida") return kExperimentByIda_s;
  if (!c.integrator.empty()) return kExperiment_s;
  return problem.motion ? in_time_seconds(problem, c) : static_seconds(problem, c);
}

Forecast::Forecast(const Table& times) {
  const std::size_t budget = times.column("budget");
  const std::size_t cpu_s = times.column("cpu_s");
  times.each([&](const std::vector<std::string>& row) {
    const double evaluations = positive(row[budget]), seconds = positive(row[cpu_s]);
    if (evaluations == 0 || seconds == 0) return;  // from an earlier version
    Sum& sum = measured_[without_seed_and_budget(row)];
    sum.budget += evaluations;
    sum.seconds += seconds;
  });
}

double Forecast::seconds(const Problem& problem, const Case& c) const {
  const auto found = measured_.find(without_seed_and_budget(case_values(c)));
  if (found == measured_.end() || found->second.budget == 0) return usual_seconds(problem, c);
  return found->second.seconds / found->second.budget * static_cast<double>(c.budget);
}

std::vector<Case> shard(const std::vector<Case>& cases, const std::vector<double>& costs, int index,
                        int count) {
  std::vector<std::size_t> order(cases.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  using Part = std::pair<double, int>;  // cost so far and index
  std::priority_queue<Part, std::vector<Part>, std::greater<>> parts;
  for (int i = 0; i < count; ++i) parts.emplace(0.0, i);
  std::vector<Case> chosen;
  for (const std::size_t i : order) {
    const Part least = parts.top();
    parts.pop();
    if (least.second == index) chosen.push_back(cases[i]);
    parts.emplace(least.first + costs[i], least.second);
  }
  return chosen;
}

}  // namespace maxwrench
