#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "lib/math/random.h"
#include "lib/scenario/current_load.h"
#include "maxwrench/interruption.h"
#include "maxwrench/measure.h"
#include "maxwrench/problem.h"
#include "maxwrench/sensitivity.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

constexpr long kMostDraws = 10'000'000;

/// Any point of the box whose corners are the cases of a load. Generalised forces are affine in
/// each coordinate alone, so the weights of the corners are products.
LoadCase drawn_case(const LoadGroup& corners, Random& random) {
  const auto index = [&random](std::size_t count) {
    return std::min(count - 1,
                    static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
  };
  if (has_current(corners) || !std::has_single_bit(corners.size())) {
    return corners[index(corners.size())];
  }
  std::vector<double> weights(corners.size(), 1);
  for (std::size_t bit = 1; bit < corners.size(); bit *= 2) {
    const double share = random.uniform();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      weights[i] *= (i & bit) != 0 ? share : 1 - share;
    }
  }
  LoadCase drawn;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (const LinkLoad& load : corners[i].loads) {
      drawn.loads.push_back({load.link, weights[i] * load.mass, weights[i] * load.moment});
    }
  }
  return drawn;
}

/// One of the losses, with each actuator that is not lost between its weakest and its full
/// strength.
ScenarioLimits drawn_limits(const Problem& problem, Random& random) {
  const std::vector<ScenarioLimits>& all = problem.scenarios.limits;
  const auto chosen = static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size()));
  ScenarioLimits limits = all[std::min(chosen, all.size() - 1)];
  const Zonotope& full = problem.robot.actuation;
  const Zonotope& weak = all.front().actuation;
  Eigen::VectorXd u_min = limits.actuation.u_min, u_max = limits.actuation.u_max;
  for (Eigen::Index i = 0; i < u_min.size(); ++i) {
    const double share = random.uniform();
    if (u_min[i] != weak.u_min[i] || u_max[i] != weak.u_max[i]) continue;  // lost
    if (full.u_min[i] != u_min[i]) u_min[i] += share * (full.u_min[i] - u_min[i]);
    if (full.u_max[i] != u_max[i]) u_max[i] += share * (full.u_max[i] - u_max[i]);
  }
  limits.actuation = with_limits(std::move(limits.actuation), u_min, u_max);
  return limits;
}

double value_of(const Problem& drawn, const Answer& answer) {
  const Case& c = answer.choice;
  const auto measure = make_scenario_polytope(drawn, c.wrench, find_wrench_solver(c.solver).make(),
                                              find_wrench_solver(c.solver).needs_facets);
  WrenchProgram program = make_wrench_program(drawn, c.wrench);
  set_posture(answer.posture, program);
  Capability capability;
  measure->evaluate(answer.posture, program, false, capability);
  if (capability.status == Status::kOptimal) return capability.beta;
  return capability.status == Status::kUnbounded ? kInfinity : -kInfinity;
}

}  // namespace

ScenarioSample sample_scenarios(const Answer& answer, long draws, std::uint64_t seed,
                                std::optional<double> guaranteed) {
  if (!answer.task || answer.task->scenarios.empty()) {
    throw std::invalid_argument(
        "sample: got a task without a list of scenarios, expected one with uncertainty");
  }
  if (answer.task->motion) {
    throw std::invalid_argument("sample: got a task in time, expected a static task");
  }
  if (answer.posture.status != Status::kValid) {
    throw std::invalid_argument("sample: got an invalid posture, expected a valid one");
  }
  if (draws < 1 || draws > kMostDraws) {
    throw std::invalid_argument(fmt::format("sample: got {}, expected 1 to {}", draws, kMostDraws));
  }
  if (guaranteed && !std::isfinite(*guaranteed)) {
    throw std::invalid_argument(
        fmt::format("guaranteed: got {:g}, expected a finite number", *guaranteed));
  }
  const Problem& problem = *answer.task;
  Problem drawn = problem;
  ScenarioSample sample;
  sample.drawn = draws;
  sample.unit = answer.unit;
  sample.guaranteed = guaranteed.value_or(answer.has_value() ? answer.beta() : -kInfinity);
  std::vector<double>& values = sample.values;
  for (long i = 0; i < draws; ++i) {
    end_if_interrupted();
    Random random(seed, RandomUse::kModel, static_cast<std::uint64_t>(i));
    for (std::size_t group = 0; group < problem.scenarios.loads.size(); ++group) {
      drawn.scenarios.loads[group] = {drawn_case(problem.scenarios.loads[group], random)};
    }
    drawn.scenarios.limits = {drawn_limits(problem, random)};
    values.push_back(value_of(drawn, answer));
  }
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(draws - 1))];
  };
  sample.least = sorted.front();
  sample.q01 = quantile(0.01);
  sample.q05 = quantile(0.05);
  sample.median = quantile(0.5);
  const double limit = sample.guaranteed - 1e-9 * (1 + std::abs(sample.guaranteed));
  for (const double value : values) {
    sample.infeasible += value == -kInfinity;
    sample.below += value < limit;
  }
  return sample;
}

std::string summary(const ScenarioSample& sample) {
  const auto shown = [](double value) {
    return value == -kInfinity ? std::string("-") : fmt::format("{:.5f}", value);
  };
  return fmt::format(
      "sample   {} models: least {} {}, 1 % {}, 5 % {}, median {}; {} infeasible, {} below {}\n",
      sample.drawn, shown(sample.least), sample.unit, shown(sample.q01), shown(sample.q05),
      shown(sample.median), sample.infeasible, sample.below, shown(sample.guaranteed));
}

std::string sample_csv(const ScenarioSample& sample) {
  std::string text = "model,beta\n";
  for (std::size_t i = 0; i < sample.values.size(); ++i) {
    const double value = sample.values[i];
    text += fmt::format("{},{}\n", i, value == -kInfinity ? "" : exact_text(value));
  }
  return text;
}

}  // namespace maxwrench
