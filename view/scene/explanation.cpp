#include <algorithm>
#include <cmath>
#include <utility>

#include "maxwrench/explain.h"
#include "maxwrench/sensitivity.h"
#include "solvers/solve/format.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// A page lists no scenarios if there are more.
constexpr long kMostScenariosListed = 500;

/// Those of which least is left come first.
ordered_json ends_json(const Answer& answer) {
  std::vector<ScenarioEnds> ends = scenario_ends(answer);
  std::stable_sort(ends.begin(), ends.end(), [](const ScenarioEnds& a, const ScenarioEnds& b) {
    return std::pair(a.held, a.high) < std::pair(b.held, b.high);
  });
  ordered_json list = ordered_json::array();
  for (const ScenarioEnds& each : ends) {
    list.push_back({{"name", each.name},
                    {"low", known(std::isfinite(each.low), each.low)},
                    {"high", known(std::isfinite(each.high), each.high)},
                    {"held", each.held}});
  }
  return list;
}

}  // namespace

ordered_json explanation_json(const Answer& answer) {
  if (!answer.task->scenarios.empty()) return nullptr;
  return ordered_json::parse(to_json(explain(answer)));
}

ordered_json scenarios_json(const Answer& answer) {
  const ScenarioList& list = answer.task->scenarios;
  if (answer.task->motion || list.empty() || answer.posture.status != Status::kValid)
    return nullptr;
  const bool solved = answer.has_value();
  const ScenarioChoice& decides = answer.capability.decides;
  const Zonotope& set =
      list.limits[static_cast<std::size_t>(solved ? decides.limits : 0)].actuation;
  return {{"decides", known(solved, describe(list, decides))},
          {"u_min", array(set.u_min)},
          {"u_max", array(set.u_max)},
          {"count", list.count()},
          {"ends", list.count() <= kMostScenariosListed ? ends_json(answer) : ordered_json()}};
}

}  // namespace maxwrench
