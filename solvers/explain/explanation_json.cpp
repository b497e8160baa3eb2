#include <cmath>

#include "maxwrench/explain.h"
#include "maxwrench/solve.h"
#include "solvers/explain/parts.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

using nlohmann::ordered_json;

/// The number, or null: ranges may be infinite, and others unknown.
ordered_json finite_or_null(double value) { return known(std::isfinite(value), value); }

ordered_json text_or_null(const std::string& text) { return known(!text.empty(), text); }

/// `whose` is the key of what has the limit: an actuator, or anything.
ordered_json limit_json(const char* whose, const LimitRate& limit) {
  return {{whose, limit.name},
          {"unit", limit.unit},
          {"limit", to_string(limit.side)},
          {"at", limit.limit},
          {"rate", limit.rate}};
}

ordered_json limits_json(const std::vector<LimitRate>& limits) {
  ordered_json list = ordered_json::array();
  for (const LimitRate& limit : limits) list.push_back(limit_json("name", limit));
  return list;
}

ordered_json binding_json(const BindingLimit& limit) {
  ordered_json object = limit_json("actuator", limit);
  object["share"] = limit.share;
  object["gain"] = finite_or_null(limit.gain);
  object["rate_up"] = finite_or_null(limit.rate_up);
  object["rate_down"] = finite_or_null(limit.rate_down);
  object["up"] = finite_or_null(limit.up);
  object["down"] = finite_or_null(limit.down);
  return object;
}

ordered_json budget_json(const ValueBudget& budget) {
  return {{"weight", budget.weight},
          {"buoyancy", budget.buoyancy},
          {"trim", budget.trim},
          {"other", budget.other},
          {"error", budget.error}};
}

ordered_json explanation_object(const Explanation& explanation) {
  const bool at_posture = explanation.missing.empty() && explanation.instants.empty();
  ordered_json object;
  object["missing"] = text_or_null(explanation.missing);
  if (!explanation.scenario.empty()) object["scenario"] = explanation.scenario;
  object["words"] = known(at_posture, binding_words(explanation));
  object["binding"] = ordered_json::array();
  for (const BindingLimit& limit : explanation.limits) {
    object["binding"].push_back(binding_json(limit));
  }
  object["ranges_missing"] = text_or_null(explanation.ranges_missing);
  object["kink"] = explanation.kink;
  object["budget"] = known(at_posture, budget_json(explanation.budget));
  const BestPostureRates& best = explanation.best;
  object["best_posture"] = {{"missing", text_or_null(best.missing)},
                            {"limits", limits_json(best.limits)},
                            {"residual", finite_or_null(best.residual)},
                            {"unique", known(best.missing.empty(), best.unique)}};
  const LeastEfforts& efforts = explanation.efforts;
  const bool held = efforts.missing.empty();
  object["least_efforts"] = {{"missing", text_or_null(efforts.missing)},
                             {"share", efforts.share},
                             {"u", known(held, array(efforts.u))},
                             {"norm", known(held, efforts.norm)},
                             {"vertex_norm", finite_or_null(efforts.vertex_norm)},
                             {"balance", known(held, efforts.balance)},
                             {"gap", known(held, efforts.gap)}};
  object["instants"] = ordered_json::array();
  for (const InstantLimits& instant : explanation.instants) {
    ordered_json& added = object["instants"].emplace_back();
    added["t"] = instant.t;
    if (!instant.scenario.empty()) added["scenario"] = instant.scenario;
    added["words"] = where_limits_are(instant.limits);
    added["limits"] = limits_json(instant.limits);
  }
  return object;
}

}  // namespace

std::string to_json(const Explanation& explanation) {
  return in_one_line(explanation_object(explanation));
}

std::string to_json(const Answer& answer, const Explanation& explanation) {
  ordered_json object = ordered_json::parse(to_json(answer));
  object["explanation"] = explanation_object(explanation);
  return in_one_line(object);
}

}  // namespace maxwrench
