#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "maxwrench/load.h"
#include "maxwrench/solve.h"
#include "tests/support/changed_limits.h"
#include "tests/support/contacts.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

const BindingLimit* find_limit(const Explanation& explanation, const std::string& name,
                               LimitSide side) {
  for (const BindingLimit& limit : explanation.limits) {
    if (limit.name == name && limit.side == side) return &limit;
  }
  return nullptr;
}

/// A task at one theta_r, evaluated again with other limits.
struct AtTheta {
  Problem task;
  Eigen::VectorXd theta_r;
  Options options;

  Answer answer() const { return evaluate(task, theta_r.transpose(), options); }
  /// beta with a limit in another place; NaN without a value.
  double with(Eigen::Index i, LimitSide side, double limit) const {
    const Answer changed = evaluate(with_limit(task, i, side, limit), theta_r.transpose(), options);
    return changed.has_value() ? changed.beta() : std::numeric_limits<double>::quiet_NaN();
  }
};

/// Random postures of a task that have a value.
std::vector<AtTheta> postures_of(const std::string& name, const Options& options, int count) {
  std::vector<AtTheta> found;
  Random random(7);
  const Problem task = load_problem(name);
  for (int tries = 0; tries < 200 && static_cast<int>(found.size()) < count; ++tries) {
    AtTheta at{task, task.contact ? near_default(task, random) : random_theta_r(task, random),
               options};
    if (at.answer().has_value()) found.push_back(at);
  }
  EXPECT_EQ(found.size(), static_cast<std::size_t>(count)) << name;
  return found;
}

void expect_budget(const Answer& answer, const Explanation& explanation) {
  ASSERT_EQ(explanation.missing, "");
  const ValueBudget& budget = explanation.budget;
  double sum = budget.weight + budget.buoyancy + budget.trim + budget.other;
  for (const BindingLimit& limit : explanation.limits) sum += limit.share;
  EXPECT_NEAR(sum, answer.beta(), 1e-8 * (1 + std::abs(answer.beta())));
  EXPECT_NEAR(budget.error, 0, 1e-8 * (1 + std::abs(answer.beta())));
  EXPECT_NEAR(budget.other, 0, 1e-9);  // at rest in still water
}

/// An independent model gives these values (to the digits shown).
TEST(BindingLimits, OfTheLiftAtItsDefaultAreTheReferenceValues) {
  const Problem task = load_problem("uvms/lift");
  const Explanation explanation = explain(evaluate(task, task.theta_r_default.transpose()));
  ASSERT_EQ(explanation.limits.size(), 2U);
  for (const char* name : {"front_right_vertical", "front_left_vertical"}) {
    const BindingLimit* limit = find_limit(explanation, name, LimitSide::kLower);
    ASSERT_NE(limit, nullptr) << name;
    EXPECT_EQ(limit->limit, -40);
    EXPECT_EQ(limit->unit, "N");
    EXPECT_NEAR(limit->rate, -0.38410, 5e-6);
    EXPECT_NEAR(limit->down, 1.48353, 5e-6);
  }
  EXPECT_FALSE(explanation.kink);
}

class RangesOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tasks, RangesOf,
                         testing::Values("uvms/valve", "uvms/lift", "planar/force", "mobile/push",
                                         "fixed/push"));

/// beta is linear just inside of a range, and not on the line or without a value just outside.
TEST_P(RangesOf, EndWhereTheValueLeavesItsLine) {
  for (const AtTheta& at : postures_of(GetParam(), {}, 4)) {
    const Answer answer = at.answer();
    const Explanation explanation = explain(answer);
    expect_budget(answer, explanation);
    EXPECT_FALSE(explanation.limits.empty());
    for (const BindingLimit& limit : explanation.limits) {
      const Eigen::Index i = actuator_named(at.task.robot, limit.name);
      const double scale = 1 + std::abs(answer.beta());
      const auto off = [&](double move) {
        const double rate = move > 0 ? limit.rate_up : limit.rate_down;
        return std::abs(at.with(i, limit.side, limit.limit + move) - answer.beta() - rate * move);
      };
      SCOPED_TRACE(limit.name);
      for (const auto& [sign, reach] : {std::pair(1, limit.up), std::pair(-1, limit.down)}) {
        ASSERT_GT(reach, 0);
        const bool meet = limit.side == LimitSide::kUpper ? sign < 0 : sign > 0;
        const Zonotope& set = at.task.robot.actuation;
        const double width = set.u_max[i] - set.u_min[i];
        EXPECT_LE(reach, meet ? width : kInfinity);
        const double inside = reach < kInfinity ? reach : 1000;
        EXPECT_LT(off(sign * 0.5 * inside), 1e-7 * scale);
        EXPECT_LT(off(sign * 0.99999 * inside), 1e-7 * scale);
        if (reach == kInfinity || (meet && 1.05 * reach >= width)) continue;
        EXPECT_FALSE(off(sign * 1.05 * reach) < 1e-7 * scale) << sign * reach;  // or NaN
      }
    }
  }
}

/// Limits that are not listed have no effect, and the gain is that of a wider limit.
TEST_P(RangesOf, OtherLimitsHaveNoEffectAndGainsAreThoseOfWiderLimits) {
  for (const AtTheta& at : postures_of(GetParam(), {}, 2)) {
    const Answer answer = at.answer();
    const Explanation explanation = explain(answer);
    const Zonotope& set = at.task.robot.actuation;
    for (Eigen::Index i = 0; i < set.actuators(); ++i) {
      for (const LimitSide side : {LimitSide::kLower, LimitSide::kUpper}) {
        const double limit = side == LimitSide::kLower ? set.u_min[i] : set.u_max[i];
        const auto thrusters = static_cast<Eigen::Index>(at.task.robot.thrusters.size());
        const std::string& name =
            i < thrusters ? at.task.robot.thrusters[static_cast<std::size_t>(i)].name
                          : at.task.robot.joints[static_cast<std::size_t>(i - thrusters)].name;
        const BindingLimit* listed = find_limit(explanation, name, side);
        if (listed) {
          const double wider = limit + 0.1 * (side == LimitSide::kLower ? -1 : 1) * std::abs(limit);
          EXPECT_NEAR(at.with(i, side, wider) - answer.beta(), listed->gain,
                      1e-7 * (1 + std::abs(answer.beta())))
              << name;
        } else {
          for (const double move : {1e-6, -1e-6}) {
            EXPECT_NEAR(at.with(i, side, limit + move), answer.beta(), 1e-9) << name;
          }
        }
      }
    }
  }
}

struct ProgramCase {
  const char *task, *measure;
  Wrench wrench;
};
class RatesOf : public testing::TestWithParam<ProgramCase> {};
INSTANTIATE_TEST_SUITE_P(
    Programs, RatesOf,
    testing::Values(ProgramCase{"uvms/valve", "linf_polytope", Wrench::kAny},
                    ProgramCase{"planar/force", "linf_polytope", Wrench::kAny},
                    ProgramCase{"planar/two_arms", "linf_polytope", Wrench::kPure},
                    ProgramCase{"dual_arm/bar_wall", "linf_polytope", Wrench::kPure},
                    ProgramCase{"uvms/lift", "l2_polytope", Wrench::kPure},
                    ProgramCase{"uvms/lift", "l2_polytope", Wrench::kAny}));

TEST_P(RatesOf, AreDifferencesOfTheValue) {
  Options options;
  options.measure = GetParam().measure;
  options.wrench = GetParam().wrench;
  for (const AtTheta& at : postures_of(GetParam().task, options, 3)) {
    const Answer answer = at.answer();
    const Explanation explanation = explain(answer);
    expect_budget(answer, explanation);
    const bool one_column = options.wrench == Wrench::kPure && !at.task.contact;
    EXPECT_EQ(explanation.ranges_missing.empty(), one_column);
    for (const BindingLimit& limit : explanation.limits) {
      const Eigen::Index i = actuator_named(at.task.robot, limit.name);
      if (i < 0) continue;  // a force of the contact
      EXPECT_EQ(std::isnan(limit.up), !one_column);
      const double step = 1e-4 * std::abs(limit.limit);
      EXPECT_NEAR((at.with(i, limit.side, limit.limit + step) - answer.beta()) / step,
                  limit.rate_up, 1e-4 * (1 + std::abs(limit.rate_up)))
          << limit.name;
      EXPECT_NEAR((answer.beta() - at.with(i, limit.side, limit.limit - step)) / step,
                  limit.rate_down, 1e-4 * (1 + std::abs(limit.rate_down)))
          << limit.name;
    }
  }
}

TEST(BindingLimits, IncludeTheForcesOfTheContact) {
  const Problem task = load_problem("planar/two_arms");
  const auto beta = [&](double w_min) {
    Problem changed = task;
    changed.contact->w_min[1] = w_min;
    return evaluate(changed, task.theta_r_default.transpose()).beta();
  };
  const Explanation explanation = explain(evaluate(task, task.theta_r_default.transpose()));
  const BindingLimit* limit = find_limit(explanation, "contact force 2", LimitSide::kLower);
  ASSERT_NE(limit, nullptr);
  EXPECT_NEAR(limit->rate, (beta(-1e-3) - beta(0)) / -1e-3, 1e-6);
  EXPECT_LT(limit->rate, -0.5);
  EXPECT_EQ(limit->gain, 0);  // 10 % of zero
}

/// Of an ellipsoid, the smaller limit of both counts.
TEST(BindingLimits, OfEllipsoidsAreDifferencesOfTheValue) {
  for (const char* measure : {"ellipsoid", "weighted_transmission_ratio"}) {
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      Options options;
      options.measure = measure;
      options.wrench = wrench;
      const Problem task = load_problem("uvms/lift");  // thrusters -40 .. 50 N
      const AtTheta at{task, task.theta_r_default, options};
      const Answer answer = at.answer();
      const Explanation explanation = explain(answer);
      expect_budget(answer, explanation);
      EXPECT_GT(explanation.limits.size(), 5U);
      for (const BindingLimit& limit : explanation.limits) {
        const Eigen::Index i = actuator_named(task.robot, limit.name);
        EXPECT_EQ(limit.side, LimitSide::kSmaller);
        const double s = limit.limit, step = 1e-4 * s;
        EXPECT_EQ(s, -task.robot.actuation.u_min[i]);
        const auto value = [&](double smaller) {  // raises both if they are the same
          AtTheta other = at;
          other.task = with_limit(task, i, LimitSide::kLower, -smaller);
          const double upper = std::max(smaller, other.task.robot.actuation.u_max[i]);
          return other.with(i, LimitSide::kUpper, upper);
        };
        EXPECT_NEAR((value(s + step) - value(s - step)) / (2 * step), limit.rate,
                    1e-6 * (1 + limit.rate))
            << limit.name;
      }
    }
  }
}

/// The share of the weight is d beta/d scale if all masses are scaled: beta is linear in tau_d.
TEST(ValueBudget, LoadsAreDerivativesByTheirScale) {
  const Problem task = load_problem("uvms/lift");
  const Eigen::MatrixXd theta_r = task.theta_r_default.transpose();
  const Answer answer = evaluate(task, theta_r);
  const ValueBudget budget = explain(answer).budget;
  const double scale = 1.001;
  Problem heavy = task, dense = task, trimmed = task;
  for (Link& link : heavy.robot.links) link.mass *= scale;
  for (Link& link : dense.robot.links) link.volume *= scale;
  trimmed.robot.trim.buoyancy_mass *= scale;
  const auto derivative = [&](const Problem& changed) {
    return (evaluate(changed, theta_r).beta() - answer.beta()) / (scale - 1);
  };
  EXPECT_NEAR(budget.weight, derivative(heavy), 1e-6);
  EXPECT_NEAR(budget.buoyancy, derivative(dense), 1e-6);
  EXPECT_NEAR(budget.trim, derivative(trimmed), 1e-6);
}

/// Along the diagonal of a gantry with 1 N along x and y, beta = sqrt 2 min(u_x, u_y): two facets.
TEST(BindingLimits, AtAKinkHaveARateForEachSide) {
  Vector6d diagonal = Vector6d::Zero();
  diagonal.head<2>().setConstant(std::sqrt(0.5));
  const Problem task = make_problem(cartesian_push(diagonal));
  const Answer answer = evaluate_posture(task, Eigen::Vector2d::Zero());
  ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.c_str();
  EXPECT_NEAR(answer.beta(), std::sqrt(2), 1e-12);
  const Explanation explanation = explain(answer);
  expect_budget(answer, explanation);
  EXPECT_TRUE(explanation.kink);
  ASSERT_EQ(explanation.limits.size(), 2U);
  for (const BindingLimit& limit : explanation.limits) {
    EXPECT_EQ(limit.side, LimitSide::kUpper);
    EXPECT_NEAR(limit.rate_up, 0, 1e-12);
    EXPECT_NEAR(limit.rate_down, std::sqrt(2), 1e-12);
    EXPECT_EQ(limit.up, kInfinity);
    EXPECT_NEAR(limit.down, 2, 1e-12);  // both limits of the motor meet at -1
    EXPECT_EQ(limit.gain, 0);
  }
  EXPECT_NE(summary(explanation).find("10 % more of one limit alone adds nothing"),
            std::string::npos);
}

/// With other forces free, the same kink is found without facets: a push along x with any force
/// along y is limited by x alone.
TEST(BindingLimits, OfAFreeForceLeaveOutItsActuator) {
  const Problem task = make_problem(cartesian_push(Vector6d::Unit(0)));
  Options options;
  options.wrench = Wrench::kAny;
  const Explanation explanation = explain(evaluate_posture(task, Eigen::Vector2d::Zero(), options));
  ASSERT_EQ(explanation.limits.size(), 1U);
  EXPECT_EQ(explanation.limits[0].name, "along_x");
  EXPECT_NEAR(explanation.limits[0].rate, 1, 1e-12);
  EXPECT_NEAR(explanation.limits[0].gain, 0.1, 1e-9);
}

/// Two motors in series along x bear the same force: with a force along y free, neither gives more
/// alone, and each takes away at rate 1.
TEST(BindingLimits, OfSeveralColumnsHaveARateForEachSideOfAKink) {
  TaskSpec spec = cartesian_push(Vector6d::Unit(0));
  Joint again = spec.robot.joints[0];
  again.name = "along_x_again";
  again.parent = 2;
  spec.robot.joints.push_back(again);
  spec.robot.links.push_back({.name = "tip", .mass = 0.1, .inertia = Eigen::Matrix3d::Identity()});
  spec.robot.end_effectors[0].link = 3;
  spec.robot.parts.clear();
  spec.robot = finalize(spec.robot);
  Options options;
  options.wrench = Wrench::kAny;
  const Answer answer = evaluate_posture(make_problem(spec), Eigen::Vector3d::Zero(), options);
  ASSERT_EQ(answer.status, Status::kOptimal) << answer.reason.c_str();
  EXPECT_NEAR(answer.beta(), 1, 1e-9);
  const Explanation explanation = explain(answer);
  expect_budget(answer, explanation);
  EXPECT_TRUE(explanation.kink);
  for (const char* name : {"along_x", "along_x_again"}) {
    const BindingLimit* limit = find_limit(explanation, name, LimitSide::kUpper);
    ASSERT_NE(limit, nullptr) << name;
    EXPECT_NEAR(limit->rate_up, 0, 1e-6);
    EXPECT_NEAR(limit->rate_down, 1, 1e-6);
    EXPECT_EQ(limit->gain, 0);
    EXPECT_TRUE(std::isnan(limit->up));
  }
  EXPECT_EQ(explanation.limits.size(), 2U);
}

/// A motor whose limits are the same force: it cannot fall below itself.
TEST(BindingLimits, OfAnActuatorWithoutWidthEndAtOnce) {
  Problem task = make_problem(cartesian_push(Vector6d::Unit(0)));
  task = with_limit(task, 0, LimitSide::kLower, 1);
  const Explanation explanation = explain(evaluate_posture(task, Eigen::Vector2d::Zero()));
  const BindingLimit* limit = find_limit(explanation, "along_x", LimitSide::kUpper);
  ASSERT_NE(limit, nullptr);
  EXPECT_EQ(limit->down, 0);
  EXPECT_EQ(limit->up, kInfinity);
}

/// An entry ends a range: u_y is at least 0.5 N, so no efforts balance the posture once u_x falls
/// below 0.5 N, before its limits meet.
TEST(BindingLimits, EndWhereNoEffortsBalanceThePosture) {
  Vector6d diagonal = Vector6d::Zero();
  diagonal.head<2>().setConstant(std::sqrt(0.5));
  Problem task = make_problem(cartesian_push(diagonal));
  // u_y between 0.5 and 1, u_x between -1 and 0.8: 0.5 sqrt 2 <= x <= 0.8 sqrt 2.
  task = with_limit(with_limit(task, 1, LimitSide::kLower, 0.5), 0, LimitSide::kUpper, 0.8);
  const Explanation explanation = explain(evaluate_posture(task, Eigen::Vector2d::Zero()));
  const BindingLimit* limit = find_limit(explanation, "along_x", LimitSide::kUpper);
  ASSERT_NE(limit, nullptr);
  EXPECT_NEAR(limit->rate, std::sqrt(2), 1e-12);
  EXPECT_NEAR(limit->down, 0.3, 1e-12);
  EXPECT_NEAR(limit->up, 0.2, 1e-12);
  EXPECT_EQ(evaluate_posture(with_limit(task, 0, LimitSide::kUpper, 0.49), Eigen::Vector2d::Zero())
                .status,
            Status::kInfeasible);
}

}  // namespace
}  // namespace maxwrench
