#include "benchmarks/suite/map_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "benchmarks/tables/csv.h"
#include "maxwrench/solve.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

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

std::string text_of_value(double value) { return value == kInfinity ? "" : exact_text(value); }

void append_numbers(const Eigen::VectorXd& v, std::size_t count, std::vector<std::string>& row) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    row.push_back(v.size() > at ? exact_text(v[at]) : "");
  }
}

}  // namespace

double map_number(const std::string& text) {
  if (text == "-inf") return -kInfinity;
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && last == end && std::isfinite(value)) return value;
  throw std::invalid_argument(
      fmt::format("{}: got '{}', expected a finite number", table_file(kMapTable).string(), text));
}

double map_number(const std::string& text, double none) {
  return text.empty() ? none : map_number(text);
}

MapRows::MapRows(const Problem& task, const MapPlan& plan, const Case& choice)
    : task_(task),
      over_(plan.over),
      choice_(choice),
      lattice_(plan),
      columns_(columns_of(task, plan)),
      axes_(plan.over.size()),
      theta_r_(static_cast<std::size_t>(task.redundancy())),
      joints_(task.robot.joints.size()),
      seed_(std::to_string(choice.seed)) {}

std::string MapRows::fault(const MapCell& cell) const {
  const auto fault = [&cell](const std::string& got, const std::string& expected) {
    return fmt::format("cell {}: got {}, expected {}", fmt::join(cell.index, ","), got, expected);
  };
  const Eigen::VectorXd at = lattice_.at(cell.index);
  bool inside = (cell.at - at).cwiseAbs().maxCoeff() <= kAnswerTolerance;
  for (std::size_t i = 0; i < axes_; ++i) {
    const double x = cell.at[static_cast<Eigen::Index>(i)];
    inside =
        inside && x >= over_[i].low - kAnswerTolerance && x <= over_[i].high + kAnswerTolerance;
  }
  if (!inside) return fault("other coordinates", "those of its place");
  if (cell.status != Status::kBestFound) return "";
  if (cell.bound < cell.beta) {
    return fault(fmt::format("bound {:.9g}", cell.bound),
                 fmt::format("at least {:.9g}", cell.beta));
  }
  Problem here = posed(task_, over_, at);
  prepare_ik_solutions(here);
  const Answer anew = evaluate(here, cell.theta_r, {choice_});
  const double beta = anew.has_value() ? anew.beta() : std::numeric_limits<double>::quiet_NaN();
  if (!(std::abs(beta - cell.beta) <= kAnswerTolerance * (1 + std::abs(cell.beta)))) {
    return fault(fmt::format("beta {:.9g}", cell.beta),
                 fmt::format("{:.9g}, the value of its posture", beta));
  }
  return "";
}

std::vector<std::string> MapRows::row_of(const MapCell& cell) const {
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
  return row;
}

MapCell MapRows::read(const std::vector<std::string>& row) const {
  MapCell cell;
  std::size_t next = 0;
  for (; next < axes_; ++next) cell.index.push_back(std::lround(map_number(row[next])));
  const auto numbers = [&](std::size_t count) {
    Eigen::VectorXd v(static_cast<Eigen::Index>(count));
    for (double& value : v) {
      value = map_number(row[next++], std::numeric_limits<double>::quiet_NaN());
    }
    return v;
  };
  cell.at = numbers(axes_);
  const std::size_t plain = next;
  cell.level = static_cast<int>(std::lround(map_number(row[plain])));
  const bool has = row[plain + 1] == to_string(Status::kBestFound);
  if (!has && row[plain + 1] != to_string(Status::kNoneFound)) {
    throw std::invalid_argument(
        fmt::format("{}: got status '{}', expected best_found or none_found",
                    table_file(kMapTable).string(), row[plain + 1]));
  }
  cell.conclude(has ? Status::kBestFound : Status::kNoneFound, row[plain + 2]);
  cell.beta = has ? map_number(row[plain + 3]) : std::numeric_limits<double>::quiet_NaN();
  cell.unit = row[plain + 4];
  cell.bound = map_number(row[plain + 5], kInfinity);
  if (!row[plain + 6].empty()) cell.scratch = map_number(row[plain + 6], -kInfinity);
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
  cell.evaluations = std::lround(map_number(row[next]));
  return cell;
}

}  // namespace maxwrench
