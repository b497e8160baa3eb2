#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "maxwrench/pareto.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// A share that is promised, in percent: rounded down to a tenth, but for the rounding of t.
std::string at_least(double t) { return percent(std::floor(1000 * t + 1e-6) / 1000); }

double degrees(double phi) { return phi * 180 / std::numbers::pi; }

std::string front_line(const FrontPoint& point, const std::string& name) {
  std::string text = fmt::format("{:<12}{:>9.5f}", name, point.t);
  text += point.bound < kInfinity ? fmt::format(" {:>9.5f}", point.bound) : "         -";
  for (const double beta : point.beta) {
    text += fmt::format(" {:>11}", std::isfinite(beta) ? decimals(beta) : "-");
  }
  return text + "  " + line(point.theta_r) + "\n";
}

ordered_json object_of(const FrontPoint& point) {
  return {{"phi", known(!std::isnan(point.phi), point.phi)},
          {"weights", array(point.weights)},
          {"t", point.t},
          {"bound", known(point.bound < kInfinity, point.bound)},
          {"beta", array(point.beta)},
          {"theta_r", array(point.theta_r)}};
}

}  // namespace

std::string summary(const Front& front) {
  std::string text;
  for (std::size_t k = 0; k < front.own.size(); ++k) {
    const Answer& own = front.own[k];
    text += fmt::format("task {}  {}  measure {}  wrench {}  best {}\n", k + 1, own.choice.problem,
                        own.choice.measure, to_string(own.choice.wrench),
                        own.has_value() ? fmt::format("{:.5f} {}", own.beta(), own.unit) : "-");
  }
  text += fmt::format("{}{}\n", to_string(front.status),
                      front.reason.empty() ? "" : ": " + front.reason.str());
  if (front.compromise.theta_r.size() == 0) return text;
  text += "phi [deg]           t     bound";
  for (std::size_t k = 0; k < front.own.size(); ++k) {
    text += fmt::format(" {:>11}", fmt::format("beta {} [{}]", k + 1, front.own[k].unit));
  }
  text += "  theta_r\n";
  for (const FrontPoint& point : front.points) {
    text += front_line(point, fmt::format("{:.2f}", degrees(point.phi)));
  }
  text += front_line(front.compromise, "all tasks");
  text += fmt::format(
      "one posture for all tasks: at least {} of the best that was found for each alone\n",
      at_least(front.compromise.t));
  if (front.dominated > 0) text += fmt::format("{} dominated points left out\n", front.dominated);
  return text + line(front.evaluations, front.wall_s) + "\n";
}

std::string to_json(const Front& front) {
  ordered_json tasks = ordered_json::array(), points = ordered_json::array();
  for (const Answer& own : front.own) {
    tasks.push_back({{"problem", own.choice.problem},
                     {"measure", own.choice.measure},
                     {"wrench", to_string(own.choice.wrench)},
                     {"unit", own.unit},
                     {"best", known(own.has_value(), own.beta())},
                     {"task_digest", own.task->digest}});
  }
  for (const FrontPoint& point : front.points) points.push_back(object_of(point));
  ordered_json compromise = nullptr;
  if (front.compromise.theta_r.size() > 0) compromise = object_of(front.compromise);
  return in_one_line({{"tasks", tasks},
                      {"status", to_string(front.status)},
                      {"reason", known(!front.reason.empty(), front.reason.str())},
                      {"points", points},
                      {"compromise", compromise},
                      {"dominated", front.dominated},
                      {"evaluations", front.evaluations},
                      {"wall_s", front.wall_s},
                      {"version", version()}});
}

std::string front_csv(const Front& front) {
  std::string text = "phi,t,bound";
  for (std::size_t k = 1; k <= front.own.size(); ++k) text += fmt::format(",beta_{}", k);
  for (int i = 0; i < front.own.front().task->redundancy(); ++i) {
    text += ",theta_r." + front.own.front().task->theta_r_name(i);
  }
  text += "\n";
  const auto add = [&text](const FrontPoint& point) {
    text += std::isnan(point.phi) ? "" : exact_text(point.phi);
    text += "," + exact_text(point.t);
    text += "," + (point.bound < kInfinity ? exact_text(point.bound) : "");
    for (const double beta : point.beta) text += "," + (std::isnan(beta) ? "" : exact_text(beta));
    for (const double value : point.theta_r) text += "," + exact_text(value);
    text += "\n";
  };
  for (const FrontPoint& point : front.points) add(point);
  if (front.compromise.theta_r.size() > 0) add(front.compromise);
  return text;
}

}  // namespace maxwrench
