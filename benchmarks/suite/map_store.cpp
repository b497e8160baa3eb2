#include "benchmarks/suite/map_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/write_file.h"
#include "maxwrench/problem.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

/// What the values of a map depend on, except the version.
nlohmann::ordered_json settings_of(const Problem& task, const MapPlan& plan, const Case& choice) {
  nlohmann::ordered_json over = nlohmann::ordered_json::array();
  for (const MapAxis& axis : plan.over) {
    over.push_back({axis.name, axis.low, axis.high, axis.count});
  }
  return {{"problem", task.name},
          {"task_digest", task.digest},
          {"measure", choice.measure},
          {"wrench", to_string(choice.wrench)},
          {"solver", choice.solver},
          {"search", choice.search},
          {"seed", choice.seed},
          {"budget", choice.budget},
          {"over", over},
          {"refine", plan.refine},
          {"tolerance", plan.tolerance}};
}

/// Gives a row what only another row of the same cell has, or has better: the lower bound, and the
/// larger result of a search from scratch. Returns whether anything changed.
bool take_over_proofs(const std::vector<std::string>& from, std::size_t bound, std::size_t scratch,
                      std::vector<std::string>& to) {
  const std::vector<std::string> before = to;
  if (map_number(from[bound], kInfinity) < map_number(to[bound], kInfinity))
    to[bound] = from[bound];
  if (to[scratch].empty() ||
      (!from[scratch].empty() && map_number(from[scratch]) > map_number(to[scratch]))) {
    to[scratch] = from[scratch];
  }
  return to != before;
}

/// The header of the table of a folder, also of a run that was killed; empty if it has none.
std::string header_of(const fs::path& folder) {
  std::string text = csv_text(table_file(folder / kMapTable));
  if (text.empty()) text = text_of(folder / "map.csv.part");
  return text.substr(0, text.find('\n'));
}

/// The columns of the first folder that has cells.
std::vector<std::string> merged_columns(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    const std::string header = header_of(folder);
    if (header.empty()) continue;
    std::vector<std::string> columns = split_csv(header);
    const auto lacks = [&](const char* name) {
      return std::find(columns.begin(), columns.end(), name) == columns.end();
    };
    if (!columns.front().starts_with("i_") || lacks("beta") || lacks("bound") || lacks("scratch")) {
      throw std::invalid_argument(fmt::format("{}: line 1: got '{}', expected the columns of a map",
                                              (folder / kMapTable).string(), one_line(header)));
    }
    return columns;
  }
  throw std::invalid_argument(
      fmt::format("{}: got no cell, here and in the other folders, expected those of a map",
                  folders.back().string()));
}

}  // namespace

MapStore::MapStore(const fs::path& folder, const Problem& task, const MapPlan& plan,
                   const Case& choice, bool again)
    : rows_(task, plan, choice), table_(folder / kMapTable, rows_.columns(), rows_.axes()) {
  table_.hold();
  nlohmann::ordered_json settings = settings_of(task, plan, choice);
  const fs::path file = folder / kMapSettings;
  const std::string before = text_of(file);
  std::string versions = std::string(version()) + " " + sources_id();
  bool same_version = false;
  if (!before.empty()) {
    nlohmann::ordered_json old = nlohmann::ordered_json::parse(before, nullptr, false);
    const bool readable = old.is_object() && old.contains("version");
    if (readable) {
      same_version = old["version"] == versions;
      old.erase("version");
    }
    if (!readable || old != settings) {
      throw std::invalid_argument(fmt::format(
          "{}: got the cells of another map, expected those of this one, or an empty folder",
          file.string()));
    }
  } else if (table_.size() > 0) {
    throw std::invalid_argument(
        fmt::format("{}: got no such file beside a map.csv, expected one", file.string()));
  }
  if (!same_version || again) {
    table_.drop([](const std::vector<std::string>&) { return true; });
  }
  settings["version"] = versions;
  write_file(file, settings.dump() + "\n");
  table_.each([this](const std::vector<std::string>& row) {
    MapCell cell = rows_.read(row);
    known_.emplace(cell.index, std::move(cell));
  });
}

std::optional<MapCell> MapStore::find(const std::vector<long>& index) const {
  const auto found = known_.find(index);
  if (found == known_.end()) return std::nullopt;
  const std::string fault = rows_.fault(found->second);
  if (!fault.empty()) {
    throw std::invalid_argument(table_file(kMapTable).string() + ": " + fault);
  }
  return found->second;
}

void MapStore::put(const MapCell& cell) { table_.put(rows_.row_of(cell)); }

bool holds_map(const fs::path& folder) { return fs::exists(folder / kMapSettings); }

std::size_t merge_maps(const fs::path& out, const std::vector<std::string>& folders) {
  std::vector<fs::path> all(folders.begin(), folders.end());
  const std::string settings = text_of(all.front() / kMapSettings);
  if (holds_map(out)) all.insert(all.begin(), out);
  for (const fs::path& folder : all) {
    if (text_of(folder / kMapSettings) != settings) {
      throw std::invalid_argument(
          fmt::format("{}: got another map or version than in {}, expected the same",
                      (folder / kMapSettings).string(), folders.front()));
    }
    if (Journal::is_held(folder / "map.csv.part") && folder != out) {
      throw std::invalid_argument(
          fmt::format("{}: got a file that is being written, expected a map that has ended",
                      (folder / "map.csv.part").string()));
    }
  }
  const std::vector<std::string> columns = merged_columns(all);
  std::size_t axes = 0;
  while (axes < columns.size() && columns[axes].starts_with("i_")) ++axes;
  Table merged(out / kMapTable, columns, axes);
  merged.hold();
  for (const std::string& folder : folders) {
    const Table part(fs::path(folder) / kMapTable, columns, axes);
    const std::size_t beta = part.column("beta"), bound = part.column("bound"),
                      scratch = part.column("scratch");
    part.each([&](const std::vector<std::string>& row) {
      auto there = merged.find(row);
      if (there && there->at(beta) != row.at(beta)) {
        throw std::invalid_argument(fmt::format(
            "{}: got another value of a cell than in {} or an earlier folder, expected the same",
            (fs::path(folder) / kMapTable).string(), out.string()));
      }
      if (!there) {
        merged.add(row);
      } else if (take_over_proofs(row, bound, scratch, *there)) {
        merged.add(*there);
      }
    });
  }
  merged.write();
  write_file(out / kMapSettings, settings);
  return merged.size();
}

}  // namespace maxwrench
