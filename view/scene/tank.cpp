#include "solvers/solve/tank.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maxwrench/strategies.h"
#include "solvers/solve/format.h"
#include "view/scene/parts.h"
#include "view/scene/scene.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// A longer experiment is drawn by the lowest and the highest reading of stretches of equal length.
constexpr std::size_t kMostStretches = 1000;

/// The samples that are drawn.
std::vector<const TankSample*> telling_samples(const std::vector<TankSample>& samples) {
  const std::size_t length = samples.size() / (2 * kMostStretches) + 1;
  std::vector<const TankSample*> telling;
  if (length == 1) {
    for (const TankSample& sample : samples) telling.push_back(&sample);
    return telling;
  }
  const auto less = [](const TankSample& a, const TankSample& b) { return a.reading < b.reading; };
  for (std::size_t first = 0; first < samples.size(); first += 2 * length) {
    const auto from = samples.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to =
        samples.begin() + static_cast<std::ptrdiff_t>(std::min(first + 2 * length, samples.size()));
    auto [low, high] = std::minmax_element(from, to, less);
    if (high < low) std::swap(low, high);
    telling.push_back(&*low);
    if (high != low) telling.push_back(&*high);
  }
  return telling;
}

}  // namespace

void require_tank(const Problem& problem, const std::string& measure, const std::string& key) {
  if (!problem.motion) {
    throw std::invalid_argument(key + ": got " + problem.name +
                                ", a static task, expected a task in time");
  }
  check(problem.robot);
  if (supported_integrators(problem, measure).empty()) {
    throw std::invalid_argument(key + ": got " + problem.name +
                                ", expected a task in time with one wrench along c, without a "
                                "second contact");
  }
}

ordered_json tank_json(const Answer& answer) {
  if (!answer.has_value()) return nullptr;
  const Problem& problem = *answer.task;
  ScriptOptions script;
  script.interpolation = usual_interpolation(problem);
  script.margin = TankOptions().margin;
  const auto [plan, run] = simulate_trajectory(problem, answer.trajectory, answer.choice.wrench,
                                               find_trajectory_solver(answer.choice.solver), script,
                                               stiff_integrators().front(), TankOptions());
  const bool has_peak = std::isfinite(plan.t_h);
  ordered_json object = {
      {"status", to_string(run.status)},
      {"reason", known(!run.reason.empty(), run.reason.str())},
      {"held", run.summary.held},
      {"missed", known(!run.summary.missed.empty(), run.summary.missed)},
      {"planned", known(std::isfinite(plan.planned), plan.planned)},
      {"asked", known(std::isfinite(plan.planned), (1 - plan.margin) * plan.planned)},
      {"t_h", known(has_peak, plan.t_h)},
      {"reading", nullptr}};
  if (!run.samples.empty()) object["reading"] = reading_of(run.summary);
  ordered_json curve = {{"t", ordered_json::array()},
                        {"planned", ordered_json::array()},
                        {"reading", ordered_json::array()}};
  for (const TankSample* sample : telling_samples(run.samples)) {
    curve["t"].push_back(drawn(sample->t));
    curve["planned"].push_back(drawn(sample->planned));
    curve["reading"].push_back(drawn(sample->reading));
  }
  object["curve"] = std::move(curve);
  return object;
}

}  // namespace maxwrench
