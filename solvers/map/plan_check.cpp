#include "solvers/map/plan_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/math/random.h"
#include "maxwrench/batch.h"
#include "maxwrench/bound.h"
#include "maxwrench/objective.h"
#include "solvers/certify/certify.h"
#include "solvers/map/lattice.h"
#include "solvers/map/robot_keys.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// [m; rad] Larger offsets would lose precision by rounding.
constexpr double kFarthestOffset = 1e6;
/// Postures that show whether a coordinate has an effect, and how many of them must have a value.
constexpr int kSampledPostures = 200, kFewestValues = 5;
constexpr double kSameValue = 1e-9;

std::string shown(const MapAxis& axis) {
  return fmt::format("{}={}:{}:{}", axis.name, axis.low, axis.high, axis.count);
}

[[noreturn]] void throw_bad_axis(const MapAxis& axis, const std::string& expected) {
  throw std::invalid_argument(fmt::format("over: got '{}', expected {}", shown(axis), expected));
}

void check_axis(const MapAxis& axis, const Problem& task) {
  const bool scales = !scaled_actuators(task.robot, axis.name).empty();
  if (!scales && !is_map_coordinate(axis.name)) {
    throw_bad_axis(axis, fmt::format("one of the coordinates {}, links.NAME.mass, uncertainty.KEY, "
                                     "or the name of an actuator",
                                     fmt::join(map_coordinates(), " ")));
  }
  if (!scales && (axis.name == "thrust" || axis.name == "torque")) {
    throw_bad_axis(axis, fmt::format("another coordinate: the robot has no {}",
                                     axis.name == "thrust" ? "thrusters" : "joints"));
  }
  if (!std::isfinite(axis.low) || !std::isfinite(axis.high)) {
    throw_bad_axis(axis, "finite limits");
  }
  if (std::max(std::abs(axis.low), std::abs(axis.high)) > kFarthestOffset) {
    throw_bad_axis(axis, fmt::format("limits of at most {:g}", kFarthestOffset));
  }
  if (axis.count < 1) throw_bad_axis(axis, "at least one value");
  if (axis.count == 1 && axis.low != axis.high) {
    throw_bad_axis(axis, "the same limits for one value, or more values");
  }
  if (axis.count > 1 && !(axis.low < axis.high)) throw_bad_axis(axis, "low < high");
  if (scales && !(axis.low > 0)) throw_bad_axis(axis, "factors above 0");
  if (unit_of_robot_key(axis.name)) {
    if (const auto expected = fault_of_robot_key(task, axis)) throw_bad_axis(axis, *expected);
  }
  if (axis.name != "wrench") return;
  const auto wrenches = static_cast<double>(task.scenarios.wrenches.size());
  const double step = axis.count > 1 ? (axis.high - axis.low) / (axis.count - 1) : 1;
  if (std::floor(axis.low) == axis.low && std::floor(step) == step && axis.low >= 1 &&
      axis.high <= wrenches) {
    return;
  }
  throw_bad_axis(axis, wrenches > 0
                           ? fmt::format("whole numbers of wrenches from 1 to {:g}", wrenches)
                           : "another coordinate: the task has one wrench");
}

void check_direction(const Problem& task, const std::string& axis) {
  const std::string unit = task.unit();
  const bool several = task.scenarios.payload || task.scenarios.ball ||
                       task.scenarios.wrenches.size() > 1 || unit == "mixed" || unit == "-";
  if (!several) return;
  throw std::invalid_argument(
      fmt::format("over: got {}, expected it for a task with one force or one torque along c ({})",
                  axis, task.name));
}

void check_number(const char* key, double got, double low, double high) {
  if (got >= low && got <= high) return;
  throw std::invalid_argument(
      fmt::format("{}: got {}, expected a number from {:g} to {:g}", key, got, low, high));
}

/// The value of each posture; -infinity without one.
std::vector<double> values_at(const Problem& task, const Eigen::MatrixXd& postures,
                              const Options& options) {
  Problem here = task;
  prepare_ik_solutions(here);
  Case c = options;
  c.search.clear();
  const Method method = resolve(here, c);
  const auto objective = make_objective(here, method);
  std::vector<double> values;
  for (Eigen::Index i = 0; i < postures.cols(); ++i) {
    values.push_back(evaluate_one(*objective, postures.col(i)));
  }
  return values;
}

bool same_values(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    if (!(std::abs(a[i] - b[i]) <= kSameValue * (1 + std::abs(a[i])))) return false;
  }
  return true;
}

}  // namespace

const std::vector<std::string>& map_coordinates() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names = {"x",       "y",         "z",      "roll",   "pitch", "yaw",
                                      "azimuth", "elevation", "wrench", "thrust", "torque"};
    names.insert(names.end(), robot_keys().begin(), robot_keys().end());
    return names;
  }();
  return kNames;
}

bool is_map_coordinate(const std::string& name) {
  const std::vector<std::string>& known = map_coordinates();
  return unit_of_robot_key(name) || std::find(known.begin(), known.end(), name) != known.end();
}

const char* map_unit(const std::string& coordinate) {
  if (const auto unit = unit_of_robot_key(coordinate)) return *unit;
  const std::vector<std::string>& known = map_coordinates();
  const auto place = std::find(known.begin(), known.end(), coordinate) - known.begin();
  return place < 3 ? "m" : place < 8 ? "rad" : "-";
}

void check_plan(const Problem& task, const MapPlan& plan) {
  if (task.motion) {
    throw std::invalid_argument(
        fmt::format("map: got {}, a task in time, expected a static task", task.name));
  }
  if (plan.over.empty()) {
    throw std::invalid_argument("over: got nothing, expected a coordinate, such as x=-0.2:0.2:9");
  }
  check_number("refine", plan.refine, 0, kMostHalvings);
  check_number("tolerance", plan.tolerance, 0, kInfinity);
  check_number("check", plan.check, 0, 1);
  check_number("check_budget", static_cast<double>(plan.check_budget), 0, kMostBudget);
  if (plan.shards < 1 || plan.shard < 1 || plan.shard > plan.shards) {
    throw std::invalid_argument(
        fmt::format("shard: got '{}/{}', expected I/N such as 2/4, with I from 1 to N", plan.shard,
                    plan.shards));
  }
  double cells = 1, finest = 1;
  for (std::size_t i = 0; i < plan.over.size(); ++i) {
    const MapAxis& axis = plan.over[i];
    check_axis(axis, task);
    if (axis.name == "azimuth" || axis.name == "elevation") check_direction(task, axis.name);
    for (std::size_t k = 0; k < i; ++k) {
      if (plan.over[k].name == axis.name) throw_bad_axis(axis, "each coordinate once");
    }
    cells *= axis.count;
    finest *= axis.name == "wrench" ? axis.count : std::ldexp(axis.count - 1, plan.refine) + 1;
  }
  if (cells > static_cast<double>(kMostCells)) {
    throw std::invalid_argument(fmt::format("over: got a grid of {:g} cells, expected at most {:g}",
                                            cells, static_cast<double>(kMostCells)));
  }
  if (plan.refine > 0 && finest > static_cast<double>(10 * kMostCells)) {
    throw std::invalid_argument(
        fmt::format("refine: got {}, which may make {:g} cells, expected at most {:g}", plan.refine,
                    finest, static_cast<double>(10 * kMostCells)));
  }
  if (plan.shards > 1) Lattice(plan).shard_cells(0);  // rejects more parts than coarse cells
}

void require_bound(const Problem& task, const MapPlan& plan, const Case& choice) {
  CertifyOptions how;
  how.gap = plan.gap;
  how.seconds = plan.seconds;
  require_valid(how);
  Eigen::VectorXd first(static_cast<Eigen::Index>(plan.over.size()));
  for (Eigen::Index a = 0; a < first.size(); ++a) {
    first[a] = plan.over[static_cast<std::size_t>(a)].low;
  }
  const Problem cell = posed(task, plan.over, first);
  make_capability_bound(cell, choice.measure, choice.wrench);
}

std::vector<std::string> find_unchanging(const Problem& task, const MapPlan& plan,
                                         const Options& options) {
  const auto count = static_cast<Eigen::Index>(plan.over.size());
  Eigen::VectorXd middle(count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const MapAxis& axis = plan.over[static_cast<std::size_t>(a)];
    // Off the centre, where symmetry could hide an effect. A number of a wrench stays whole.
    middle[a] = axis.name == "wrench" ? axis.low : 0.63 * axis.low + 0.37 * axis.high;
  }
  Random random(options.seed, RandomUse::kModel, 0);
  Eigen::MatrixXd postures(task.redundancy(), kSampledPostures);
  for (Eigen::Index i = 0; i < postures.cols(); ++i) {
    for (Eigen::Index k = 0; k < postures.rows(); ++k) {
      postures(k, i) = random.uniform(task.theta_r_min[k], task.theta_r_max[k]);
    }
  }
  const std::vector<double> here = values_at(posed(task, plan.over, middle), postures, options);
  const auto with_value = [](double value) { return value > -kInfinity; };
  if (std::count_if(here.begin(), here.end(), with_value) < kFewestValues) return {};
  std::vector<std::string> names;
  for (Eigen::Index a = 0; a < count; ++a) {
    const MapAxis& axis = plan.over[static_cast<std::size_t>(a)];
    if (axis.count < 2) continue;
    bool same = true;
    std::vector<double> values = {axis.low, axis.high};
    if (axis.name == "wrench") {
      for (int i = 1; i + 1 < axis.count; ++i) values.push_back(axis.low + i);
    }
    for (const double value : values) {
      Eigen::VectorXd there = middle;
      there[a] = value;
      same = same && same_values(here, values_at(posed(task, plan.over, there), postures, options));
    }
    if (same) names.push_back(axis.name);
  }
  return names;
}

}  // namespace maxwrench
