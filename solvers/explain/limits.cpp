#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/measure/closed_form.h"
#include "lib/robot/chain.h"
#include "solvers/explain/exits.h"
#include "solvers/explain/parts.h"
#include "solvers/lp/makers.h"
#include "solvers/solve/format.h"
#include "solvers/wrench/makers.h"

namespace maxwrench {
namespace {

/// A multiplier below this share of the largest is rounding.
constexpr double kLeastMultiplier = 1e-9;
/// The change of a limit, as a share of its magnitude, that `BindingLimit::gain` is about.
constexpr double kMore = 0.1;
/// The share of a limit by which it moves to find a one-sided rate, and how far that may differ
/// from the multiplier by rounding, as a share of the largest multiplier.
constexpr double kSmallMove = 1e-4, kSameRate = 1e-5;
/// A difference of values below this share of 1 + |beta| is rounding.
constexpr double kRoundingOfValue = 1e-9;

/// A column of a wrench program: effort i, or force i - m of the second contact.
struct LimitedColumn {
  std::string name;
  const char* unit;
  double min, max, multiplier;
};

/// The efforts with d = -B'lambda, then the forces of the second contact with s = c_w +
/// (J'W)'lambda.
std::vector<LimitedColumn> limited_columns(const Problem& task, const WrenchProgram& program,
                                           const Eigen::VectorXd& lambda) {
  const Robot& robot = task.robot;
  const Zonotope& set = *program.actuation;
  const Eigen::VectorXd d = -(set.B.transpose() * lambda);
  const Eigen::VectorXd s = program.c_w + program.JtW.transpose() * lambda;
  std::vector<LimitedColumn> columns;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    columns.push_back(
        {actuator_name(robot, i), actuator_unit(robot, i), set.u_min[i], set.u_max[i], d[i]});
  }
  const Eigen::Index own = program.W.cols();
  for (Eigen::Index j = own; j < s.size(); ++j) {
    columns.push_back({contact_force_name(j - own), contact_force_unit(task, j - own),
                       program.w_min[j], program.w_max[j], s[j]});
  }
  return columns;
}

/// The value with a limit of column i in another place; NaN if there is none.
double value_with(WrenchProgram program, Eigen::Index i, LimitSide side, double limit) {
  Zonotope actuation = *program.actuation;
  const Eigen::Index m = actuation.actuators();
  program.actuation = &actuation;
  const bool upper = side == LimitSide::kUpper;
  if (i < m) {
    (upper ? actuation.u_max : actuation.u_min)[i] = limit;
  } else {
    (upper ? program.w_max : program.w_min)[program.W.cols() + i - m] = limit;
  }
  Capability capability;
  make_assembled(make_simplex(), false)->solve(program, false, capability);
  return capability.status == Status::kOptimal ? capability.beta
                                               : std::numeric_limits<double>::quiet_NaN();
}

/// The rates of a limit of column i without its range, by solving again on both sides. Where the
/// rate holds for the small move, its difference is the rate itself; elsewhere the difference
/// counts, which is exact unless other limits take over within the move.
LimitRange rates_on_both_sides(const WrenchProgram& program, Eigen::Index i, LimitSide side,
                               double limit, double rate, double largest, double beta) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const double move = kSmallMove * (limit == 0 ? 1 : std::abs(limit));
  const auto one_side = [&](double step) {
    const double difference = (value_with(program, i, side, limit + step) - beta) / step;
    return std::abs(difference - rate) <= kSameRate * largest ? rate : difference;
  };
  return {one_side(move), one_side(-move), kUnknown, kUnknown};
}

/// Adds a limit of column i if it binds. `largest` is the largest multiplier.
void add_if_it_binds(const WrenchProgram& program, const LimitedColumn& column, Eigen::Index i,
                     LimitSide side, const Exits* exits, double largest, Explanation& explanation) {
  const bool upper = side == LimitSide::kUpper;
  const double limit = upper ? column.max : column.min, least = kLeastMultiplier * largest;
  if (!std::isfinite(limit)) return;
  BindingLimit binding;
  const double rate = upper ? std::max(column.multiplier, 0.0) : std::min(column.multiplier, 0.0);
  static_cast<LimitRate&>(binding) = {column.name, column.unit, side, limit,
                                      std::abs(rate) > least ? rate : 0};
  const LimitRange range =
      exits ? exits->range(i, side)
            : rates_on_both_sides(program, i, side, limit, binding.rate, largest, explanation.beta);
  binding.rate_up = range.rate_up;
  binding.rate_down = range.rate_down;
  binding.up = range.up;
  binding.down = range.down;
  const auto counts = [least](double value) { return std::abs(value) > least; };
  if (!counts(binding.rate) && !counts(range.rate_up) && !counts(range.rate_down)) return;
  explanation.kink |= counts(range.rate_up - range.rate_down);
  binding.share = binding.rate * limit;
  const double wider = limit + (upper ? kMore : -kMore) * std::abs(limit);
  const double gain = limit == 0 ? 0 : value_with(program, i, side, wider) - explanation.beta;
  binding.gain = std::abs(gain) <= kRoundingOfValue * (1 + std::abs(explanation.beta)) ? 0 : gain;
  explanation.limits.push_back(binding);
}

/// The binding limits of an optimum of the program.
void explain_program(const Answer& answer, const WrenchProgram& program,
                     const Eigen::VectorXd& lambda, Explanation& explanation) {
  const std::vector<LimitedColumn> columns = limited_columns(*answer.task, program, lambda);
  std::optional<Exits> exits;
  if (program.columns() > 1) {
    explanation.ranges_missing = "several wrench components are free";
  } else if (!program.actuation->has_facets) {
    explanation.ranges_missing = "the actuators have too many facets to enumerate";
  } else {
    exits.emplace(program);
  }
  double largest = 0;
  for (const LimitedColumn& column : columns) {
    largest = std::max(largest, std::abs(column.multiplier));
  }
  Eigen::Index i = 0;
  for (const LimitedColumn& column : columns) {
    for (const LimitSide side : {LimitSide::kLower, LimitSide::kUpper}) {
      add_if_it_binds(program, column, i, side, exits ? &*exits : nullptr, largest, explanation);
    }
    ++i;
  }
}

/// The L2 polytope as a program of its own, whose multipliers the answer does not hold.
void explain_l2(const Answer& answer, const WrenchProgram& program, Explanation& explanation) {
  const Zonotope& actuation = answer.task->robot.actuation;
  const Eigen::Index m = actuation.actuators();
  const Zonotope box =
      make_zonotope(Eigen::MatrixXd::Identity(m, m), actuation.u_min, actuation.u_max);
  WrenchProgram own = program;
  own.actuation = &box;
  own.JtW = actuation.B_pinv * program.JtW;
  own.tau_d = actuation.B_pinv * program.tau_d;
  Capability capability;
  make_condensed()->solve(own, false, capability);
  if (capability.status != Status::kOptimal) {
    explanation.missing =
        std::string("the multipliers are not known: ") + capability.reason.c_str();
    return;
  }
  explain_program(answer, own, capability.lambda, explanation);
}

/// All limits of the ellipsoid |W_u u| <= 1 count.
void explain_ellipsoid(const Answer& answer, const WrenchProgram& program,
                       Explanation& explanation) {
  const Zonotope& set = *program.actuation;
  const Eigen::VectorXd& lambda = answer.capability.lambda;
  const bool loaded = answer.choice.measure == "ellipsoid";
  Eigen::VectorXd tau = program.JtW * answer.capability.w;
  if (loaded) tau += program.tau_d;
  const Eigen::VectorXd s = smaller_limits(set);
  const Eigen::VectorXd e = (set.B_pinv * tau).cwiseQuotient(s);
  const double multiplier = answer.beta() - lambda.dot(program.tau_d);
  for (Eigen::Index i = 0; i < e.size(); ++i) {
    BindingLimit binding;
    binding.share = multiplier * e[i] * e[i];
    if (!(binding.share > kLeastMultiplier * multiplier)) continue;
    const Robot& robot = answer.task->robot;
    static_cast<LimitRate&>(binding) = {actuator_name(robot, i), actuator_unit(robot, i),
                                        LimitSide::kSmaller, s[i], binding.share / s[i]};
    binding.gain = kMore * binding.share;
    explanation.limits.push_back(binding);
  }
  explanation.ranges_missing = "the ellipsoid is smooth, so rates change at once";
}

/// Why a measure has no binding limits.
std::string without_limits(const std::string& measure) {
  for (const char* name : {"manipulability", "transmission_ratio", "least_effort"}) {
    if (measure == name) return "measure " + measure + " does not depend on the limits of efforts";
  }
  return "measure " + measure + " has no multipliers of the limits of efforts";
}

}  // namespace

void explain_limits(const Answer& answer, const WrenchProgram& program, Explanation& explanation) {
  const std::string& measure = answer.choice.measure;
  if (measure == "linf_polytope") {
    explain_program(answer, program, answer.capability.lambda, explanation);
  } else if (measure == "l2_polytope") {
    explain_l2(answer, program, explanation);
  } else if (measure == "ellipsoid" || measure == "weighted_transmission_ratio") {
    explain_ellipsoid(answer, program, explanation);
  } else {
    explanation.missing = without_limits(measure);
  }
  if (!explanation.missing.empty()) return;
  ValueBudget& budget = explanation.budget;
  split_loads(answer, answer.capability.lambda, budget);
  // The loads of a scenario.
  budget.other += answer.capability.lambda.dot(program.tau_d - answer.posture.tau_d);
  budget.error = answer.beta() - budget.weight - budget.buoyancy - budget.trim - budget.other;
  for (const BindingLimit& limit : explanation.limits) budget.error -= limit.share;
  if (!(std::abs(budget.error) <= kAnswerTolerance * (1 + std::abs(answer.beta())))) {
    explanation.missing =
        fmt::format("the multipliers miss the value by {:.1e} {}", budget.error, answer.unit);
    explanation.limits.clear();
  }
  const auto importance = [](const BindingLimit& limit) {
    return std::pair(std::isnan(limit.gain) ? 0 : limit.gain, std::abs(limit.share));
  };
  std::stable_sort(explanation.limits.begin(), explanation.limits.end(),
                   [&](const auto& a, const auto& b) { return importance(a) > importance(b); });
}

}  // namespace maxwrench
