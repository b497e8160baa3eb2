#include <fmt/format.h>

#include <cmath>

#include "maxwrench/margin.h"
#include "maxwrench/version.h"
#include "solvers/solve/format.h"
#include "solvers/solve/row.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

std::string shown_margin(double margin) {
  return std::isfinite(margin) ? decimals(margin) : std::string(margin > 0 ? "any" : "none");
}

/// "thruster at -40, elbow at 9"
std::string shown_limits(const std::vector<LimitRate>& limits) {
  std::string text;
  for (const LimitRate& limit : limits) {
    text += fmt::format("{}{} at {:g} {}", text.empty() ? "" : ", ", limit.name, limit.limit,
                        limit.unit);
  }
  return text;
}

/// A text as a field of CSV.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

std::string numbers(const Vector6d& v) {
  std::string text;
  for (const double x : v) text += fmt::format("{:>9}", decimals(x));
  return text;
}

ordered_json object_of(const InstantMargin& at) {
  ordered_json binding = ordered_json::array();
  for (const LimitRate& limit : at.binding) {
    binding.push_back({{"actuator", limit.name},
                       {"unit", limit.unit},
                       {"limit", to_string(limit.side)},
                       {"at", known(std::isfinite(limit.limit), limit.limit)},
                       {"rate", limit.rate}});
  }
  return {{"t", at.t},
          {"status", to_string(at.status)},
          {"margin", known(std::isfinite(at.margin), at.margin)},
          {"worst", array(at.worst)},
          {"facet", known(at.facet >= 0, at.facet)},
          {"binding", binding},
          {"limits", at.limits},
          {"u", known(at.u.size() > 0, array(at.u))},
          {"by_program", known(std::isfinite(at.by_program), at.by_program)}};
}

}  // namespace

std::string summary(const MotionMargin& margin) {
  std::string text = fmt::format("{}  margin of {}\n", margin.problem, margin.set);
  text += fmt::format("{}{}\n", to_string(margin.status),
                      margin.reason.empty() ? "" : ": " + margin.reason.str());
  const InstantMargin& worst = margin.instants[static_cast<std::size_t>(margin.worst)];
  text += fmt::format("margin      {} {} at {:g} s, the least of {} instants from {:g} to {:g} s\n",
                      shown_margin(worst.margin), margin.unit, worst.t, margin.instants.size(),
                      margin.instants.front().t, margin.instants.back().t);
  if (worst.status == Status::kOptimal) {
    text += fmt::format("worst     {}\n", numbers(worst.worst));
  }
  if (!worst.binding.empty()) {
    text += fmt::format("{}       {}{}\n", worst.status == Status::kInfeasible ? "needs" : "binds",
                        shown_limits(worst.binding),
                        worst.limits.empty() ? "" : " (" + worst.limits + ")");
  }
  text += fmt::format("residual {}; programs differ by {:.1e}\n", line(margin.residual),
                      margin.difference);
  const auto count = static_cast<double>(margin.instants.size());
  text += fmt::format("{} instants in {:.3g} s, {:.2f} us each; verified in {:.3g} s\n",
                      margin.instants.size(), margin.wall_s, 1e6 * margin.wall_s / count,
                      margin.checks_s);
  return text;
}

std::string to_json(const MotionMargin& margin) {
  ordered_json instants = ordered_json::array();
  for (const InstantMargin& at : margin.instants) instants.push_back(object_of(at));
  const InstantMargin& worst = margin.instants[static_cast<std::size_t>(margin.worst)];
  return in_one_line({{"problem", margin.problem},
                      {"set", margin.set},
                      {"status", to_string(margin.status)},
                      {"reason", known(!margin.reason.empty(), margin.reason.str())},
                      {"margin", known(std::isfinite(worst.margin), worst.margin)},
                      {"unit", margin.unit},
                      {"worst", object_of(worst)},
                      {"infeasible", margin.infeasible},
                      {"instants", instants},
                      {"residual", to_json(margin.residual)},
                      {"difference", margin.difference},
                      {"wall_s", margin.wall_s},
                      {"checks_s", margin.checks_s},
                      {"version", version()}});
}

std::string margin_csv(const MotionMargin& margin) {
  std::string text = "t,margin,status,fx,fy,fz,tx,ty,tz,facet,binding,limits\n";
  for (const InstantMargin& at : margin.instants) {
    text += exact_text(at.t) + "," + exact_text(at.margin) + "," + to_string(at.status);
    for (const double x : at.worst) text += "," + exact_text(x + 0.0);
    text += "," + (at.facet >= 0 ? fmt::format("{}", at.facet) : "") + ",";
    std::string binding;
    for (const LimitRate& limit : at.binding) {
      binding +=
          fmt::format("{}{}:{}", binding.empty() ? "" : " ", limit.name, to_string(limit.side));
    }
    text += field(binding) + "," + field(at.limits) + "\n";
  }
  return text;
}

}  // namespace maxwrench
