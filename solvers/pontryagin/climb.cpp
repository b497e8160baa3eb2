#include "solvers/pontryagin/climb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/robot/chain.h"
#include "maxwrench/problem.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

constexpr int kFewestIntervals = 35;
constexpr int kInstants = 4;             // of the motion of least effort, per interval
constexpr double kStiffness = 1;         // for epsilon = 1
constexpr double kPlanStiffness = 1e4;   // likewise, of a plan
constexpr double kSpeeds = 0.98;         // what the stiffness lets exceed is mostly below the limit
constexpr double kUnlimitedReach = 1e6;  // factor of the limits of efforts
constexpr int kFirstSteps = 40, kLaterSteps = 15;  // of Newton's method
constexpr double kFirstFactor = 0.5, kLargestFactor = 0.99, kSmallestFactor = 0.1;
constexpr int kFewSteps = 3;            // then the next factor is smaller
constexpr double kLeastEpsilon = 1e-3;  // of epsilon, at the end
constexpr double kRisen = 1e-6;         // relative, of the mass
constexpr int kSwitchingSamples = 20;   // per interval, to find where efforts change their sign

/// The largest effort at a node, in units of its weight.
double largest_effort(Shooting& shooting, const Problem& problem, const Extremal& extremal) {
  const Eigen::VectorXd w = effort_weights(problem);
  CanonicalEquations& equations = shooting.equations(extremal);
  double largest = 0;
  Eigen::VectorXd z_dot;
  for (const Eigen::VectorXd& node : extremal.nodes) {
    Eigen::VectorXd z(node.size() + 1);
    z << node, 0;
    equations.rates(z, extremal.m, z_dot);
    largest = std::max(largest, equations.efforts().cwiseQuotient(w).lpNorm<Eigen::Infinity>());
  }
  return largest;
}

/// Lowers the limits of efforts to the task's.
bool lower_limits(Shooting& shooting, const Problem& problem, Extremal& at) {
  at.index.reach = std::max(1.0, largest_effort(shooting, problem, at));
  double factor = kFirstFactor;
  if (shooting.solve(at, false, kLaterSteps) < 0) return false;
  while (at.index.reach > 1) {
    Extremal next = at;
    next.index.reach = std::max(1.0, factor * at.index.reach);
    if (shooting.solve(next, false, kLaterSteps) < 0) {
      factor = std::sqrt(factor);
      if (factor > kLargestFactor || shooting.ended()) return false;
      continue;
    }
    at = std::move(next);
  }
  return true;
}

/// The largest excess of a joint's speed at a node, as a share of its limit; negative: there is
/// none.
double excess_of_speeds(const Problem& problem, const Extremal& extremal) {
  const Eigen::Index n = problem.redundancy();
  double largest = -1;
  for (const Eigen::VectorXd& node : extremal.nodes) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto joint = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
      const double fastest = problem.robot.joints[joint].velocity_max;
      largest = std::max(largest, std::abs(node[n + j]) / fastest - 1);
    }
  }
  return largest;
}

/// The extremal of another epsilon, on the line through the last two over log(epsilon).
Extremal predicted_extremal(const Extremal& before, const Extremal& at, double factor) {
  Extremal next = at;
  next.index.epsilon *= factor;
  if (before.nodes.empty()) return next;
  const double share = std::log(factor) / std::log(at.index.epsilon / before.index.epsilon);
  for (std::size_t k = 0; k < next.nodes.size(); ++k) {
    next.nodes[k] += share * (at.nodes[k] - before.nodes[k]);
  }
  next.m += share * (at.m - before.m);
  return next;
}

/// Lowers epsilon. Returns how it ended.
const char* lower_epsilon(Shooting& shooting, Extremal& at,
                          const std::function<void(const Extremal&)>& seen) {
  const double first = at.index.epsilon;
  double factor = kFirstFactor;
  Extremal before;
  while (at.index.epsilon > kLeastEpsilon * first) {
    Extremal next = predicted_extremal(before, at, factor);
    const int steps = shooting.solve(next, true, kLaterSteps);
    if (shooting.ended()) return "budget";
    if (steps < 0) {
      factor = std::sqrt(factor);
      if (factor > kLargestFactor) return "stalled";
      continue;
    }
    before = std::exchange(at, std::move(next));
    seen(at);
    const bool risen = at.m - before.m > kRisen * (1 + std::abs(at.m));
    if (!risen && factor <= kFirstFactor) return "jumps";
    if (steps <= kFewSteps) factor = std::max(kSmallestFactor, factor * factor);
  }
  return "jumps";
}

}  // namespace

Climb climb(Shooting& shooting, const Problem& problem, const Eigen::MatrixXd& knots, double m,
            const std::function<void(const Extremal&)>& seen) {
  const int given = problem.motion->k - 1;
  const int intervals = given * ((kFewestIntervals + given - 1) / given);
  SplineMotion motion = resampled(*problem.motion, knots, intervals, kInstants);
  minimise_effort(problem, m, kStiffness, motion);
  Climb result;
  Extremal at = shooting.guess(motion, m);
  at.index = {1, kStiffness, kUnlimitedReach, kSpeeds};
  const auto ended = [&](const char* end) {
    result.end = shooting.ended() ? "budget" : end;
    return result;
  };
  if (shooting.solve(at, false, kFirstSteps) < 0) return ended("no_extremal");
  if (!lower_limits(shooting, problem, at)) return ended("no_extremal");
  if (!(at.nu > 0)) return ended("effortless");
  const double share = 1 / at.nu;
  for (Eigen::VectorXd& node : at.nodes) node.tail(node.size() / 2) *= share;
  at.index.epsilon *= share;
  at.index.stiffness *= share;
  seen(at);
  result.end = lower_epsilon(shooting, at, seen);
  result.extremal = at;
  result.speed_excess = excess_of_speeds(problem, at);
  return result;
}

std::vector<Eigen::MatrixXd> plans_of(Shooting& shooting, const Problem& problem,
                                      const Extremal& extremal) {
  const MotionTask& task = *problem.motion;
  const int given = task.k - 1, per_interval = task.instants_per_interval;
  // Each interval between knots has `each` nodes, and a sample at each instant.
  const int each = static_cast<int>(extremal.nodes.size()) / given;
  const std::vector<Eigen::VectorXd> states = shooting.sample(extremal, per_interval);
  if (states.empty()) return {};
  SplineMotion motion{make_scheme(task), Eigen::MatrixXd(task.k, problem.redundancy())};
  for (int k = 0; k <= given; ++k) {
    motion.Q.row(k) =
        states[static_cast<std::size_t>(k * each * per_interval)].head(motion.Q.cols());
  }
  motion.Q.row(given) = task.theta_T;
  std::vector<Eigen::MatrixXd> plans = {motion.Q.middleRows(1, given - 1)};
  Eigen::MatrixXd efforts(problem.robot.actuators(), motion.maps.instants());
  CanonicalEquations& equations = shooting.equations(extremal);
  Eigen::VectorXd z_dot;
  for (int i = 0; i < motion.maps.instants(); ++i) {
    equations.rates(states[static_cast<std::size_t>(i * each)], extremal.m, z_dot);
    efforts.col(i) = equations.efforts();
  }
  follow_efforts(problem, extremal.m, kPlanStiffness, efforts, motion);
  plans.push_back(motion.Q.middleRows(1, given - 1));
  return plans;
}

std::string describe_switching(Shooting& shooting, const Problem& problem, const Extremal& extremal,
                               int& switches) {
  switches = 0;
  const std::vector<Eigen::VectorXd> states = shooting.sample(extremal, kSwitchingSamples);
  if (states.empty()) return "unknown";
  CanonicalEquations& equations = shooting.equations(extremal);
  Eigen::MatrixXd s(problem.robot.actuators(), static_cast<Eigen::Index>(states.size()));
  Eigen::VectorXd z_dot;
  for (std::size_t i = 0; i < states.size(); ++i) {
    equations.rates(states[i], extremal.m, z_dot);
    s.col(static_cast<Eigen::Index>(i)) = equations.switching();
  }
  const double step = shooting.duration() / static_cast<double>(states.size() - 1);
  std::string text;
  for (Eigen::Index actuator = 0; actuator < s.rows(); ++actuator) {
    const auto side = [&](Eigen::Index i) { return s(actuator, i) > 0 ? "max" : "min"; };
    text += fmt::format("{}{} {}", actuator > 0 ? "; " : "", actuator_name(problem.robot, actuator),
                        side(0));
    for (Eigen::Index i = 1; i < s.cols(); ++i) {
      const double a = s(actuator, i - 1), b = s(actuator, i);
      if ((a > 0) == (b > 0)) continue;
      text +=
          fmt::format(", {} {:.4f}", side(i), step * (static_cast<double>(i - 1) + a / (a - b)));
      ++switches;
    }
  }
  return text;
}

}  // namespace maxwrench
