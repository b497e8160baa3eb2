#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "solvers/explain/parts.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

/// A list in words: "a", "a and b", "a, b and c".
std::string in_words(std::vector<std::string> names) {
  if (names.empty()) return "";
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : fmt::format("{} and {}", fmt::join(names, ", "), last);
}

/// What 10 % more of the limit that adds most would add.
std::string more_of(const LimitRate& limit, double gain, const std::string& unit) {
  if (!(gain > 0)) return "10 % more of one limit alone adds nothing\n";
  return fmt::format("10 % more of {} adds {:.5f} {}\n", limit.name, gain, unit);
}

/// The values of a limit between which its rate holds, such as "-41.48353 .. -38.2".
std::string range_text(const BindingLimit& limit) {
  if (std::isnan(limit.up)) return "";
  return fmt::format("  {} .. {}", decimals(limit.limit - limit.down),
                     decimals(limit.limit + limit.up));
}

std::string rate_text(const BindingLimit& limit) {
  const std::string down = decimals(limit.rate_down), up = decimals(limit.rate_up);
  if (std::isnan(limit.rate_up) || up == down) return decimals(limit.rate);
  return down + " / " + up;
}

std::string binding_table(const Explanation& e) {
  std::string text = fmt::format("{:<32}{:>12}{:>21}{:>14}{:>12}{}\n", "limit", "at",
                                 e.kink ? "rate down / up" : "rate", "share [" + e.unit + "]",
                                 "10 % more", e.ranges_missing.empty() ? "  rate holds" : "");
  for (const BindingLimit& limit : e.limits) {
    text +=
        fmt::format("{:<32}{:>12}{:>21}{:>14}{:>12}{}\n", limit.name + " " + to_string(limit.side),
                    fmt::format("{:g} {}", limit.limit, limit.unit), rate_text(limit),
                    decimals(limit.share), decimals(limit.gain), range_text(limit));
  }
  const std::pair<const char*, double> loads[] = {{"weight", e.budget.weight},
                                                  {"buoyancy", e.budget.buoyancy},
                                                  {"trim", e.budget.trim},
                                                  {"other", e.budget.other}};
  for (const auto& [name, share] : loads) {
    if (std::abs(share) > 1e-9 * (1 + std::abs(e.beta))) {
      text += fmt::format("{:<65}{:>14}\n", name, decimals(share));
    }
  }
  return text +
         fmt::format("{:<65}{:>14.5f}  (error {:.1e})\n", "sum: beta", e.beta, e.budget.error);
}

std::string rates_table(const std::vector<LimitRate>& limits, const std::string& unit) {
  std::string text;
  for (const LimitRate& limit : limits) {
    text += fmt::format("{:<32}{:>12}{:>21}  {} per {}\n", limit.name + " " + to_string(limit.side),
                        fmt::format("{:g} {}", limit.limit, limit.unit), decimals(limit.rate), unit,
                        limit.unit);
  }
  return text;
}

std::string best_text(const Explanation& e) {
  const BestPostureRates& best = e.best;
  if (!best.missing.empty()) return "posture optimised again: no rates, " + best.missing + "\n";
  std::string text = fmt::format("posture optimised again: {}{}\n", where_limits_are(best.limits),
                                 best.unique ? "" : "; the rates are some of several");
  const LimitRate& first = best.limits.front();
  text += more_of(first, 0.1 * std::abs(first.rate * first.limit), e.unit + " to first order");
  return text + rates_table(best.limits, e.unit) +
         fmt::format("{:<44}{:>21.1e}\n", "residual", best.residual);
}

std::string efforts_text(const Explanation& e) {
  const LeastEfforts& efforts = e.efforts;
  const std::string which =
      efforts.share == 1 ? "least efforts"
                         : fmt::format("least efforts for {:g} of the wrench", efforts.share);
  if (!efforts.missing.empty()) return which + ": none, " + efforts.missing + "\n";
  std::string text = fmt::format("{}: |W_u u| {:.5f}", which, efforts.norm);
  if (!std::isnan(efforts.vertex_norm)) {
    text += fmt::format(", of the efforts above {:.5f}", efforts.vertex_norm);
  }
  text += "\nu_least  ";
  for (const double u : efforts.u) text += fmt::format(" {:>9}", decimals(u));
  return text + "\n";
}

std::string instants_text(const Explanation& e) {
  std::string text;
  for (const InstantLimits& instant : e.instants) {
    text += fmt::format("binds at {:.4f} s{}: {}\n", instant.t,
                        instant.scenario.empty() ? "" : " (" + instant.scenario + ")",
                        where_limits_are(instant.limits));
    text += rates_table(instant.limits, e.unit);
  }
  return text + "no ranges, no other posture and no least efforts: " + e.efforts.missing + "\n";
}

}  // namespace

std::string where_limits_are(const std::vector<LimitRate>& limits) {
  std::vector<std::string> parts;
  const std::pair<LimitSide, const char*> sides[] = {{LimitSide::kLower, "lower"},
                                                     {LimitSide::kUpper, "upper"}};
  for (const auto& [side, word] : sides) {
    std::vector<std::string> names;
    for (const LimitRate& limit : limits) {
      if (limit.side == side) names.push_back(limit.name);
    }
    if (names.empty()) continue;
    const bool one = names.size() == 1;
    parts.push_back(fmt::format("{} {} {} limit{}", in_words(names),
                                one ? "is at its" : "are at their", word, one ? "" : "s"));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string binding_words(const Explanation& e) {
  if (e.limits.empty()) return "binds: no limit\n";
  const BindingLimit& first = e.limits.front();
  std::string text;
  if (first.side == LimitSide::kSmaller) {
    text = fmt::format("binds: the ellipsoid, in which all limits count; {} counts most\n",
                       first.name);
  } else {
    text = fmt::format("binds: {}\n", where_limits_are({e.limits.begin(), e.limits.end()}));
  }
  if (e.kink)
    text +=
        "the value has a kink here: a limit that falls and one that rises have rates of their "
        "own\n";
  return text + more_of(first, first.gain, e.unit);
}

std::string summary(const Explanation& explanation) {
  if (!explanation.instants.empty()) return instants_text(explanation);
  std::string text;
  if (!explanation.scenario.empty()) {
    text = fmt::format("in the scenario that decides, {}\n", explanation.scenario);
  }
  if (!explanation.missing.empty()) {
    text += "binds: not known, " + explanation.missing + "\n";
    if (std::isnan(explanation.beta)) return text;
  } else {
    text += binding_words(explanation) + binding_table(explanation);
    if (!explanation.ranges_missing.empty()) {
      text += "no ranges: " + explanation.ranges_missing + "\n";
    }
  }
  return text + best_text(explanation) + efforts_text(explanation);
}

}  // namespace maxwrench
