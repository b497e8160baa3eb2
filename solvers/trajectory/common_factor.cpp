#include "solvers/trajectory/common_factor.h"

#include <algorithm>
#include <cmath>

#include "solvers/trajectory/by_facets.h"

namespace maxwrench {
namespace {

/// A slope n'a below this share of |a| counts as zero.
constexpr double kLevelSlope = 1e-12;
/// The violation of a pair that is parallel to a, relative to the sizes involved, by which rounding
/// may make it infeasible.
constexpr double kRoundedPair = 1e-9;
/// The share of its limit by which a row may be violated where the ends of the interval meet.
constexpr double kHeldRow = 1e-8;

}  // namespace

bool CommonFactor::suits(const TrajectoryProgram& program) {
  const auto single = [](const WrenchProgram& at) { return at.columns() == 1 && at.c_w[0] > 0; };
  return program.common && program.border() == 0 && starts_anywhere(program) &&
         std::all_of(program.instants.begin(), program.instants.end(), single);
}

/// Takes in low <= t <= high.
void CommonFactor::add(double low, double high, const End& at) {
  if (low > low_.value) {
    low_ = at;
    low_.value = low;
  }
  if (high < high_.value) {
    high_ = at;
    high_.value = high;
  }
}

void CommonFactor::narrow(const TrajectoryProgram& program, int i) {
  const WrenchProgram& at = program.instants[static_cast<std::size_t>(i)];
  const Zonotope& set = *at.actuation;
  const double per = at.c_w[0];
  add(per * at.w_min[0], per * at.w_max[0], {.instant = i});
  slopes_.noalias() = set.N.transpose().lazyProduct(at.JtW.col(0));
  slopes_ /= per;
  loads_.noalias() = set.N.transpose().lazyProduct(at.tau_d);
  const double flat = kLevelSlope * at.JtW.norm() / per;
  for (int j = 0; j < set.facet_pairs(); ++j) {
    const double slope = slopes_[j], below = set.b_min[j] - loads_[j];
    const double above = set.b_max[j] - loads_[j];
    if (std::abs(slope) > flat) {
      const double low_before = low_.value;
      add(std::min(below / slope, above / slope), std::max(below / slope, above / slope),
          {.instant = i, .pair = j, .slope = slope});
      if (low_.value == low_before) continue;
      const double limit = std::abs(slope > 0 ? set.b_min[j] : set.b_max[j]);
      slack_ = kHeldRow * (std::isfinite(limit) ? limit : 0) / std::abs(slope);
      continue;
    }
    const double rounded = kRoundedPair * (1 + std::abs(loads_[j]));
    if (below > rounded) missed_ = {.instant = i, .pair = j, .slope = -1};
    if (above < -rounded) missed_ = {.instant = i, .pair = j, .slope = 1};
  }
}

/// The multipliers of sign times (t <= value): d value/d tau_d,i = -n/(n'a) of the pair.
void CommonFactor::set_multipliers(const TrajectoryProgram& program, const End& end, double sign,
                                   TrajectorySolution& solution) {
  solution.pi[end.instant] += sign;
  if (end.pair < 0) return;
  const Zonotope& set = *program.instants.front().actuation;
  solution.lambda.col(end.instant) -= sign / end.slope * set.N.col(end.pair);
}

Status CommonFactor::solve(const TrajectoryProgram& program, TrajectorySolution& solution) {
  low_ = {.value = -kInfinity};
  high_ = {.value = kInfinity};
  missed_ = {};
  slack_ = 0;
  const Zonotope& set = *program.instants.front().actuation;
  slopes_.resize(set.facet_pairs());
  loads_.resize(set.facet_pairs());
  for (int i = 0; i < program.size(); ++i) narrow(program, i);
  if (missed_.instant >= 0) {
    solution.lambda.col(missed_.instant) = missed_.slope * set.N.col(missed_.pair);
    return Status::kInfeasible;
  }
  if (low_.value > high_.value + slack_) {
    // Both ends, with the opposite signs of lambda, as a proof has them.
    set_multipliers(program, high_, 1, solution);
    set_multipliers(program, low_, -1, solution);
    solution.lambda *= -1;
    return Status::kInfeasible;
  }
  solution.value = high_.value;
  if (high_.value == kInfinity) return Status::kUnbounded;
  set_multipliers(program, high_, 1, solution);
  return Status::kOptimal;
}

}  // namespace maxwrench
