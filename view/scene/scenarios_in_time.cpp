#include <algorithm>
#include <cmath>
#include <limits>

#include "maxwrench/sensitivity.h"
#include "solvers/solve/format.h"
#include "solvers/solve/scenario_values.h"
#include "view/scene/parts.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// A page has no scenarios over time if there are more of them, or more numbers.
constexpr long kMostScenariosInTime = 500, kMostNumbers = 20000;

ordered_json row_of(const Eigen::MatrixXd& values, Eigen::Index s) {
  ordered_json row = ordered_json::array();
  for (const double value : values.row(s)) row.push_back(known(std::isfinite(value), value));
  return row;
}

/// The scenarios over time, those of which least is left at some instant first.
ordered_json over_time(const Answer& answer) {
  const Eigen::MatrixXd values = scenario_values(answer);
  const std::vector<ScenarioEnds> ends = scenario_ends(answer);
  const auto& instants = answer.trajectory.instants;
  const auto length = static_cast<std::size_t>(values.cols());
  ordered_json times = ordered_json::array(), list = ordered_json::array();
  for (std::size_t i = instants.size() - length; i < instants.size(); ++i) {
    times.push_back(instants[i].t);
  }
  for (std::size_t s = 0; s < ends.size(); ++s) {
    list.push_back({{"name", ends[s].name},
                    {"low", known(std::isfinite(ends[s].low), ends[s].low)},
                    {"high", known(std::isfinite(ends[s].high), ends[s].high)},
                    {"held", ends[s].held},
                    {"values", row_of(values, static_cast<Eigen::Index>(s))}});
  }
  std::stable_sort(list.begin(), list.end(), [](const ordered_json& a, const ordered_json& b) {
    const auto rank = [](const ordered_json& each) {
      if (!each["held"].get<bool>()) return -kInfinity;
      return each["high"].is_null() ? kInfinity : each["high"].get<double>();
    };
    return rank(a) < rank(b);
  });
  return {{"t", times}, {"ends", list}};
}

}  // namespace

ordered_json scenarios_in_time_json(const Answer& answer) {
  const ScenarioList& list = answer.task->scenarios;
  const Trajectory& trajectory = answer.trajectory;
  if (list.empty() || trajectory.status == Status::kInvalidPosture || answer.program.size() == 0) {
    return nullptr;
  }
  const bool decided = answer.has_value() && trajectory.decides_at >= 0;
  const auto limits = static_cast<std::size_t>(decided ? trajectory.decides.limits : 0);
  const auto at = static_cast<std::size_t>(std::max(trajectory.decides_at, 0));
  ordered_json object = {{"decides", known(decided, describe(list, trajectory.decides))},
                         {"decides_at", known(decided, trajectory.instants.at(at).t)},
                         {"u_min", array(list.limits[limits].actuation.u_min)},
                         {"u_max", array(list.limits[limits].actuation.u_max)},
                         {"count", list.count()}};
  const bool listed = list.count() <= kMostScenariosInTime && answer.program.size() <= kMostNumbers;
  object.update(listed ? over_time(answer) : ordered_json({{"t", nullptr}, {"ends", nullptr}}));
  return object;
}

}  // namespace maxwrench
