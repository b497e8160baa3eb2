#include "benchmarks/suite/map_check.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/suite/map_rows.h"
#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/draw.h"
#include "benchmarks/tables/write_file.h"
#include "maxwrench/batch.h"
#include "solvers/map/plan_check.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// What map.json says.
struct MapSettings {
  std::string problem, digest;
  MapPlan plan;
  Case choice;
};

MapSettings read_map_settings(const fs::path& file) {
  MapSettings settings;
  try {
    const nlohmann::json object = nlohmann::json::parse(text_of(file));
    settings.problem = object.at("problem");
    settings.digest = object.at("task_digest");
    settings.choice.problem = settings.problem;
    settings.choice.measure = object.at("measure");
    settings.choice.wrench = parse_wrench(object.at("wrench"));
    settings.choice.solver = object.at("solver");
    settings.choice.seed = object.at("seed");
    for (const auto& axis : object.at("over")) {
      settings.plan.over.push_back({axis.at(0), axis.at(1), axis.at(2), axis.at(3)});
    }
    settings.plan.refine = object.at("refine");
    settings.plan.tolerance = object.at("tolerance");
  } catch (const std::exception&) {
    throw std::invalid_argument(file.string() +
                                ": got a file that is damaged, expected what `map --out` writes");
  }
  return settings;
}

}  // namespace

MapCheck check_map(const fs::path& folder, const std::function<Problem(const std::string&)>& load,
                   std::size_t sample, std::uint64_t seed, int threads) {
  const MapSettings settings = read_map_settings(folder / kMapSettings);
  const Problem task = load(settings.problem);
  if (task.digest != settings.digest) {
    throw std::invalid_argument(
        fmt::format("{}: got a map of another {}, expected one of this task",
                    (folder / kMapSettings).string(), settings.problem));
  }
  check_plan(task, settings.plan);
  const MapRows rows(task, settings.plan, settings.choice);
  const Table table(folder / kMapTable, rows.columns(), rows.axes());
  std::vector<MapCell> cells;
  table.each([&](const std::vector<std::string>& row) { cells.push_back(rows.read(row)); });
  if (cells.empty()) {
    throw std::invalid_argument(table_file(folder / kMapTable).string() +
                                ": got no cell, expected one or more");
  }
  const std::vector<std::size_t> drawn = draw_rows(cells.size(), sample, seed);
  std::vector<std::string> faults(drawn.size());
  parallel_for(threads, static_cast<long>(drawn.size()), [&](long i) {
    const auto at = static_cast<std::size_t>(i);
    faults[at] = rows.fault(cells[drawn[at]]);
  });
  MapCheck check{task.name, cells.size(), drawn.size(), 0, {}};
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    check.values += cells[drawn[i]].status == Status::kBestFound;
    if (!faults[i].empty()) check.rejected.push_back(faults[i]);
  }
  return check;
}

}  // namespace maxwrench
