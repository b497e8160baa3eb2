#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "maxwrench/map.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// The largest bound of a cell with a value.
double largest_bound(const CapabilityMap& map) {
  double largest = -kInfinity;
  for (const MapCell& cell : map.cells) {
    if (cell.status == Status::kBestFound) largest = std::max(largest, cell.bound);
  }
  return largest;
}

struct MapCounts {
  long with_value = 0, evaluations = 0;
  std::vector<long> levels;        ///< number of cells of each level
  const MapCell* least = nullptr;  ///< the least value
};

MapCounts count_cells(const CapabilityMap& map) {
  MapCounts counts;
  for (const MapCell& cell : map.cells) {
    const auto level = static_cast<std::size_t>(cell.level);
    if (counts.levels.size() <= level) counts.levels.resize(level + 1);
    ++counts.levels[level];
    counts.evaluations += cell.evaluations;
    if (cell.status != Status::kBestFound) continue;
    ++counts.with_value;
    if (counts.least == nullptr || cell.beta < counts.least->beta) counts.least = &cell;
  }
  return counts;
}

/// What the proofs of the cells say, in a line.
std::string bounds_line(const CapabilityMap& map, long with_value) {
  const double widest = map.widest_gap();
  std::string text = fmt::format("proven    {} of {} cells with a value to {:g} %", map.proven(),
                                 with_value, 100 * map.plan.gap);
  if (!std::isfinite(widest)) return text + "; some have no bound\n";
  return text + fmt::format(", the widest gap is {:.2g} %; none of them has more than {:.5f} {}\n",
                            100 * widest, largest_bound(map), map.unit);
}

std::string place_of(const CapabilityMap& map, const MapCell& cell) {
  std::string text;
  for (std::size_t a = 0; a < map.plan.over.size(); ++a) {
    text += fmt::format("{}{} {:.5g}", a > 0 ? ", " : "", map.plan.over[a].name,
                        cell.at[static_cast<Eigen::Index>(a)]);
  }
  return text;
}

ordered_json object_of(const CapabilityMap& map, const MapCell* cell) {
  if (cell == nullptr) return nullptr;
  ordered_json at;
  for (std::size_t a = 0; a < map.plan.over.size(); ++a) {
    at[map.plan.over[a].name] = cell->at[static_cast<Eigen::Index>(a)];
  }
  return {{"at", at}, {"beta", cell->beta}, {"theta_r", array(cell->theta_r)}};
}

}  // namespace

std::string summary(const CapabilityMap& map) {
  const MapCounts counts = count_cells(map);
  std::string text =
      fmt::format("{}  measure {}  wrench {}  search {}\n", map.task->name, map.choice.measure,
                  to_string(map.choice.wrench), map.choice.search);
  text += fmt::format("map over");
  for (const MapAxis& axis : map.plan.over) {
    text += fmt::format("  {} {:g} .. {:g} ({})", axis.name, axis.low, axis.high, axis.count);
  }
  text += fmt::format("\n{}{}\n", to_string(map.status),
                      map.reason.empty() ? "" : ": " + map.reason.str());
  text +=
      fmt::format("cells     {}, {} with a value; by level", map.cells.size(), counts.with_value);
  for (const long count : counts.levels) text += fmt::format(" {}", count);
  text += "\n";
  const auto say = [&](const char* name, const MapCell* cell) {
    if (cell == nullptr) return;
    text +=
        fmt::format("{:<8}{:>11.5f} {} at {}\n", name, cell->beta, map.unit, place_of(map, *cell));
  };
  say("largest", map.best());
  say("least", counts.least);
  if (const long checked = map.checked(); checked > 0) {
    text += fmt::format(
        "checked   {} cells from scratch: {} ({:.2f} %) improve by more than 0.1 %\n", checked,
        map.improved(), 100.0 * static_cast<double>(map.improved()) / static_cast<double>(checked));
  }
  if (map.plan.bound && counts.with_value > 0) text += bounds_line(map, counts.with_value);
  for (const std::string& name : map.unchanging) {
    text += fmt::format("{} changes nothing: no sampled posture has another value there\n", name);
  }
  return text + line(counts.evaluations, map.wall_s) + "\n";
}

std::string to_json(const CapabilityMap& map) {
  const MapCounts counts = count_cells(map);
  ordered_json over = ordered_json::array();
  for (const MapAxis& axis : map.plan.over) {
    over.push_back({{"name", axis.name},
                    {"unit", map_unit(axis.name)},
                    {"low", axis.low},
                    {"high", axis.high},
                    {"count", axis.count}});
  }
  const long checked = map.checked();
  const bool bounded = map.plan.bound && counts.with_value > 0;
  return in_one_line({{"problem", map.task->name},
                      {"measure", map.choice.measure},
                      {"wrench", to_string(map.choice.wrench)},
                      {"solver", map.choice.solver},
                      {"search", map.choice.search},
                      {"seed", map.choice.seed},
                      {"budget", map.choice.budget},
                      {"over", over},
                      {"status", to_string(map.status)},
                      {"reason", known(!map.reason.empty(), map.reason.str())},
                      {"unit", map.unit},
                      {"cells", map.cells.size()},
                      {"with_value", counts.with_value},
                      {"computed", map.computed},
                      {"levels", counts.levels},
                      {"largest", object_of(map, map.best())},
                      {"least", object_of(map, counts.least)},
                      {"checked", checked},
                      {"improved", known(checked > 0, map.improved())},
                      {"proven", known(bounded, map.proven())},
                      {"widest_gap", known(bounded, map.widest_gap())},
                      {"largest_bound", known(bounded, largest_bound(map))},
                      {"unchanging", map.unchanging},
                      {"evaluations", counts.evaluations},
                      {"wall_s", map.wall_s},
                      {"task_digest", map.task->digest},
                      {"version", version()}});
}

}  // namespace maxwrench
