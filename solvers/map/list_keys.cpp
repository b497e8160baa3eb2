#include "solvers/map/list_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

constexpr std::string_view kWidthPrefix = "uncertainty.", kMassPrefix = "mass.",
                           kVolumePrefix = "volume.";
constexpr double kLargestRadius = 1e9;  // N or N m

/// The part of a key after a prefix; empty: it has another beginning.
std::string after(std::string_view prefix, const std::string& key) {
  return key.starts_with(prefix) ? key.substr(prefix.size()) : "";
}

/// Whether all cases are about one number with this key.
bool is_interval(const LoadGroup& cases, const std::string& key) {
  return std::all_of(cases.begin(), cases.end(), [&key](const LoadCase& load) {
    return load.deltas.size() == 1 && load.deltas[0].key == key &&
           load.deltas[0].change.size() == 1;
  });
}

/// Half the width of such an interval.
double width_of(const LoadGroup& cases) {
  double width = 0;
  for (const LoadCase& load : cases) width = std::max(width, std::abs(load.deltas[0].change[0]));
  return width;
}

/// What a width may not exceed: the nominal mass or volume of a body.
double largest_width(const Robot& robot, const std::string& width) {
  const std::string heavy = after(kMassPrefix, width), wide = after(kVolumePrefix, width);
  for (const BodyPart& part : robot.parts) {
    if (part.name == heavy) return part.mass;
    if (part.name == wide) return part.volume;
  }
  return kInfinity;
}

std::optional<std::string> fault_of_radius(const Problem& task, const MapAxis& axis) {
  const ScenarioList& list = task.scenarios;
  if (!list.ball) return "another coordinate: the task has no ball of wrenches";
  if (list.unit != std::string("-")) {
    return fmt::format("another coordinate: in {} the value is that of a ball of radius 1",
                       list.unit);
  }
  if (axis.low > 0 && axis.high <= kLargestRadius) return std::nullopt;
  return "radii above 0";
}

std::optional<std::string> fault_of_width(const Problem& task, const std::string& width,
                                          const MapAxis& axis) {
  const std::vector<LoadGroup>& loads = task.scenarios.loads;
  if (std::none_of(loads.begin(), loads.end(),
                   [&width](const LoadGroup& cases) { return is_interval(cases, width); })) {
    return "another coordinate: the task does not have it, or the body's centre is uncertain as "
           "well";
  }
  if (axis.low < 0) return "widths of at least 0";
  const double most = largest_width(task.robot, width);
  if (axis.high <= most) return std::nullopt;
  return fmt::format("widths of at most the nominal value, {:g}", most);
}

/// Replaces the number in the name of a case, as in "vehicle mass +0.2 kg".
void rename(double from, double to, std::string& name) {
  const std::string old = fmt::format("{:g} ", from);
  const std::size_t at = name.rfind(old);
  if (at != std::string::npos) name.replace(at, old.size(), fmt::format("{:g} ", to));
}

void set_width(const std::string& width, double value, Problem& task) {
  for (LoadGroup& cases : task.scenarios.loads) {
    if (!is_interval(cases, width)) continue;
    const double factor = value / width_of(cases);
    for (LoadCase& load : cases) {
      double& change = load.deltas[0].change[0];
      rename(change, factor * change, load.name);
      change *= factor;
      for (LinkLoad& each : load.loads) {
        each.mass *= factor;
        each.moment *= factor;
      }
    }
  }
}

}  // namespace

std::optional<const char*> unit_of_list_key(const std::string& coordinate) {
  if (coordinate == kRadiusKey) return "N or N m";
  const std::string width = after(kWidthPrefix, coordinate);
  if (width == "trim" || width == "payload.mass" || !after(kMassPrefix, width).empty()) return "kg";
  if (!after(kVolumePrefix, width).empty()) return "m^3";
  return std::nullopt;
}

std::optional<std::string> fault_of_list_key(const Problem& task, const MapAxis& axis) {
  if (axis.name == kRadiusKey) return fault_of_radius(task, axis);
  return fault_of_width(task, after(kWidthPrefix, axis.name), axis);
}

void set_list_key(const std::string& key, double value, Problem& task) {
  if (key == kRadiusKey) {
    task.scenarios.ball->radius = value;
  } else {
    set_width(after(kWidthPrefix, key), value, task);
  }
}

}  // namespace maxwrench
