#include "benchmarks/suite/map_store.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "benchmarks/tables/csv.h"
#include "benchmarks/tables/write_file.h"
#include "maxwrench/problem.h"
#include "maxwrench/version.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMapTable = "map.csv";
constexpr const char* kMapSettings = "map.json";
constexpr std::size_t kPlainColumns = 7;  // level .. scratch
constexpr const char* kBaseColumns[] = {"x", "y", "z", "roll", "pitch", "yaw"};

std::vector<std::string> columns_of(const Problem& task, const MapPlan& plan) {
  std::vector<std::string> columns;
  for (const MapAxis& axis : plan.over) columns.push_back("i_" + axis.name);
  for (const MapAxis& axis : plan.over) columns.push_back(axis.name);
  columns.insert(columns.end(), {"level", "status", "reason", "beta", "unit", "bound", "scratch"});
  for (int i = 0; i < task.redundancy(); ++i) columns.push_back("theta_r." + task.theta_r_name(i));
  for (const char* name : kBaseColumns) columns.push_back(std::string("base.") + name);
  for (const Joint& joint : task.robot.joints) columns.push_back("q." + joint.name);
  columns.insert(columns.end(), {"evaluations", "seed"});
  return columns;
}

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

/// The number in a cell of the table, which may be empty if `none` says what that means.
double number_in(const std::string& text, std::optional<double> none = std::nullopt) {
  if (text.empty() && none) return *none;
  if (text == "-inf") return -kInfinity;
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && last == end && std::isfinite(value)) return value;
  throw std::invalid_argument(
      fmt::format("{}: got '{}', expected a finite number", table_file(kMapTable).string(), text));
}

std::string text_of_value(double value) { return value == kInfinity ? "" : exact_text(value); }

/// Gives a row what only another row of the same cell has, or has better: the lower bound, and the
/// larger result of a search from scratch. Returns whether anything changed.
bool take_over_proofs(const std::vector<std::string>& from, std::size_t bound, std::size_t scratch,
                      std::vector<std::string>& to) {
  const std::vector<std::string> before = to;
  if (number_in(from[bound], kInfinity) < number_in(to[bound], kInfinity)) to[bound] = from[bound];
  if (to[scratch].empty() ||
      (!from[scratch].empty() && number_in(from[scratch]) > number_in(to[scratch]))) {
    to[scratch] = from[scratch];
  }
  return to != before;
}

void append_numbers(const Eigen::VectorXd& v, std::size_t count, std::vector<std::string>& row) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    row.push_back(v.size() > at ? exact_text(v[at]) : "");
  }
}

}  // namespace

MapStore::MapStore(const fs::path& folder, const Problem& task, const MapPlan& plan,
                   const Case& choice, bool again)
    : task_(task),
      over_(plan.over),
      choice_(choice),
      lattice_(plan),
      columns_(columns_of(task, plan)),
      axes_(plan.over.size()),
      theta_r_(static_cast<std::size_t>(task.redundancy())),
      joints_(task.robot.joints.size()),
      seed_(std::to_string(choice.seed)),
      table_(folder / kMapTable, columns_, axes_) {
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
    MapCell cell = read(row);
    known_.emplace(cell.index, std::move(cell));
  });
}

std::optional<MapCell> MapStore::find(const std::vector<long>& index) const {
  const auto found = known_.find(index);
  if (found == known_.end()) return std::nullopt;
  require_true(found->second);
  return found->second;
}

void MapStore::require_true(const MapCell& cell) const {
  const auto reject = [&](const std::string& got, const std::string& expected) {
    throw std::invalid_argument(fmt::format("{}: cell {}: got {}, expected {}",
                                            table_file(kMapTable).string(),
                                            fmt::join(cell.index, ","), got, expected));
  };
  const Eigen::VectorXd at = lattice_.at(cell.index);
  if (!((cell.at - at).cwiseAbs().maxCoeff() <= kAnswerTolerance)) {
    reject("other coordinates", "those of its place");
  }
  if (cell.status != Status::kBestFound) return;
  if (cell.bound < cell.beta) {
    reject(fmt::format("bound {:.9g}", cell.bound), fmt::format("at least {:.9g}", cell.beta));
  }
  Problem here = posed(task_, over_, at);
  prepare_ik_solutions(here);
  const Answer anew = evaluate(here, cell.theta_r, {choice_});
  const double beta = anew.has_value() ? anew.beta() : std::numeric_limits<double>::quiet_NaN();
  if (!(std::abs(beta - cell.beta) <= kAnswerTolerance * (1 + std::abs(cell.beta)))) {
    reject(fmt::format("beta {:.9g}", cell.beta),
           fmt::format("{:.9g}, the value of its posture", beta));
  }
}

void MapStore::put(const MapCell& cell) {
  std::vector<std::string> row;
  for (const long i : cell.index) row.push_back(std::to_string(i));
  append_numbers(cell.at, axes_, row);
  const bool has = cell.status == Status::kBestFound;
  row.insert(row.end(), {std::to_string(cell.level), to_string(cell.status), cell.reason.str(),
                         has ? exact_text(cell.beta) : "", cell.unit, text_of_value(cell.bound),
                         !cell.scratch                 ? ""
                         : *cell.scratch == -kInfinity ? "-inf"
                                                       : exact_text(*cell.scratch)});
  append_numbers(cell.theta_r, theta_r_, row);
  append_numbers(cell.base, std::size(kBaseColumns), row);
  append_numbers(cell.q, joints_, row);
  row.insert(row.end(), {std::to_string(cell.evaluations), seed_});
  table_.put(row);
}

MapCell MapStore::read(const std::vector<std::string>& row) const {
  MapCell cell;
  std::size_t next = 0;
  for (; next < axes_; ++next) cell.index.push_back(std::lround(number_in(row[next])));
  const auto numbers = [&](std::size_t count) {
    Eigen::VectorXd v(static_cast<Eigen::Index>(count));
    for (double& value : v) {
      value = number_in(row[next++], std::numeric_limits<double>::quiet_NaN());
    }
    return v;
  };
  cell.at = numbers(axes_);
  const std::size_t plain = next;
  cell.level = static_cast<int>(std::lround(number_in(row[plain])));
  const bool has = row[plain + 1] == to_string(Status::kBestFound);
  if (!has && row[plain + 1] != to_string(Status::kNoneFound)) {
    throw std::invalid_argument(
        fmt::format("{}: got status '{}', expected best_found or none_found",
                    table_file(kMapTable).string(), row[plain + 1]));
  }
  cell.conclude(has ? Status::kBestFound : Status::kNoneFound, row[plain + 2]);
  cell.beta = has ? number_in(row[plain + 3]) : std::numeric_limits<double>::quiet_NaN();
  cell.unit = row[plain + 4];
  cell.bound = number_in(row[plain + 5], kInfinity);
  if (!row[plain + 6].empty()) cell.scratch = number_in(row[plain + 6], -kInfinity);
  next += kPlainColumns;
  cell.theta_r = numbers(theta_r_);
  cell.base = numbers(std::size(kBaseColumns));
  cell.q = numbers(joints_);
  if (has && !cell.theta_r.allFinite()) {
    throw std::invalid_argument(
        fmt::format("{}: got best_found without theta_r, expected {} numbers",
                    table_file(kMapTable).string(), theta_r_));
  }
  if (!has) cell.theta_r = cell.base = cell.q = Eigen::VectorXd();
  cell.evaluations = std::lround(number_in(row[next]));
  return cell;
}

bool holds_map(const fs::path& folder) { return fs::exists(folder / kMapSettings); }

std::size_t merge_maps(const fs::path& out, const std::vector<std::string>& folders) {
  std::vector<fs::path> all(folders.begin(), folders.end());
  const std::string settings = text_of(all.front() / kMapSettings);
  if (holds_map(out)) all.insert(all.begin(), out);
  std::string header = csv_text(table_file(all.front() / kMapTable));
  if (header.empty()) header = text_of(all.front() / "map.csv.part");  // of a killed run
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
  const std::vector<std::string> columns = split_csv(header.substr(0, header.find('\n')));
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
