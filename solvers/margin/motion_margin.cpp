#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "lib/robot/chain.h"
#include "maxwrench/interruption.h"
#include "maxwrench/margin.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/wrench_program.h"
#include "maxwrench/wrench_solver.h"
#include "solvers/margin/instant_scan.h"
#include "solvers/solve/format.h"

namespace maxwrench {
namespace {

/// The largest |margin - by_program|, relative to 1 + |margin|.
constexpr double kMarginAgreement = 1e-7;
/// The largest residual of a program, likewise and relative to 1 + |tau_d|.
constexpr double kMarginResidual = 1e-7;
/// Rates below this share of the largest are rounding.
constexpr double kMarginRate = 1e-9;

using MarginClock = std::chrono::steady_clock;

double margin_seconds_since(MarginClock::time_point start) {
  return std::chrono::duration<double>(MarginClock::now() - start).count();
}

void require_instants(const Problem& task, const std::vector<Instant>& instants) {
  if (instants.empty()) {
    throw std::invalid_argument("margin: got no instants, expected those of a motion");
  }
  const Eigen::Index n = task.robot.velocities();
  for (const Instant& instant : instants) {
    const bool fits = instant.tau_d.size() == n && instant.J.cols() == n;
    if (fits && instant.tau_d.allFinite() && instant.J.allFinite() && instant.c.allFinite() &&
        instant.end_effector.R.allFinite()) {
      continue;
    }
    throw std::invalid_argument(
        fmt::format("margin: got an instant at t = {:g} s whose forces are {}, expected those of a "
                    "motion of {}",
                    instant.t, fits ? "not finite" : "of another robot", task.robot.name));
  }
}

std::string words_of(const Problem& listed, const MarginSet& set) {
  if (set.of_task) return "the wrenches of the task";
  const Matrix6Xd& E = listed.scenarios.ball->E;
  std::vector<std::string> axes;
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    if (!E.row(axis).isZero(0)) axes.emplace_back(kWrenchAxes[static_cast<std::size_t>(axis)]);
  }
  return fmt::format("any direction of {}, axes of the {}", fmt::join(axes, " "),
                     set.in_end_effector ? "end effector" : "world");
}

/// Checks the margins by linear programs.
class MarginCheck {
 public:
  explicit MarginCheck(const Problem& task)
      : task_(task), solver_(find_wrench_solver("simplex").make()) {
    program_ = make_wrench_program(task, Wrench::kPure);
    program_.c_w.setOnes();
  }

  /// Solves for the largest factor of `worst` or, if the motion is infeasible, for that motion.
  /// False: the margin is not confirmed.
  bool verify(const Instant& instant, const InstantScan& scan, InstantMargin& at,
              MotionMargin& result) {
    const ScenarioChoice& choice = scan.choice();
    const bool feasible = scan.feasible();
    program_.actuation = &task_.scenarios.limits[static_cast<std::size_t>(choice.limits)].actuation;
    program_.W = feasible ? at.worst : Vector6d::Zero();
    program_.JtW = instant.J.transpose() * program_.W;
    program_.tau_d = instant.tau_d;
    program_.w_min.setConstant(feasible ? -kInfinity : 0);
    program_.w_max.setConstant(feasible ? kInfinity : 0);
    solver_->solve(program_, true, found_);
    if (!feasible) {
      const bool proved =
          found_.status == Status::kInfeasible && proves_infeasible(program_, found_.lambda);
      return proved && (at.margin == -kInfinity || agrees(by_limits(scan), at, result));
    }
    if (found_.status != Status::kOptimal) return false;
    at.by_program = found_.beta;
    at.u = found_.u;
    const Residual residual = recheck(program_, found_.u, found_.w, found_.lambda);
    raise(residual, result.residual);
    const double size = 1 + std::abs(at.margin) + instant.tau_d.lpNorm<Eigen::Infinity>();
    return agrees(found_.beta, at, result) && residual.within(kMarginResidual * size);
  }

 private:
  /// With y = -slope, for which the largest y'J'h over the set is one: the largest y'B u within the
  /// limits, less y'tau_d.
  double by_limits(const InstantScan& scan) const {
    const Zonotope& actuation = *program_.actuation;
    const Eigen::ArrayXd d = -(actuation.B.transpose() * scan.slope()).array();
    const Eigen::ArrayXd most = (d * actuation.u_max.array()).max(d * actuation.u_min.array());
    // An unlimited actuator that the facet does not load: 0 times infinity.
    return (d.abs() > kMarginRate * d.abs().maxCoeff()).select(most, 0).sum() +
           scan.slope().dot(program_.tau_d);
  }

  static bool agrees(double value, const InstantMargin& at, MotionMargin& result) {
    const double difference = std::abs(value - at.margin);
    result.difference = std::max(result.difference, difference);
    return difference <= kMarginAgreement * (1 + std::abs(at.margin));
  }

  static void raise(const Residual& by, Residual& largest) {
    largest.balance = std::max(largest.balance, by.balance);
    largest.bounds = std::max(largest.bounds, by.bounds);
    largest.dual = std::max(largest.dual, by.dual);
    largest.gap = std::max(largest.gap, by.gap);
  }

  const Problem& task_;
  std::unique_ptr<WrenchSolver> solver_;
  WrenchProgram program_;
  Capability found_;
};

/// The limits of the actuators that bind, from d = -B'slope.
std::vector<LimitRate> limits_of_facet(const Robot& robot, const Zonotope& actuation,
                                       const Eigen::VectorXd& slope) {
  const Eigen::VectorXd d = -(actuation.B.transpose() * slope);
  const double least = kMarginRate * d.lpNorm<Eigen::Infinity>();
  std::vector<LimitRate> limits;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    if (!(std::abs(d[i]) > least)) continue;
    const bool upper = d[i] > 0;
    limits.push_back({actuator_name(robot, i), actuator_unit(robot, i),
                      upper ? LimitSide::kUpper : LimitSide::kLower,
                      upper ? actuation.u_max[i] : actuation.u_min[i], d[i]});
  }
  std::stable_sort(limits.begin(), limits.end(), [](const LimitRate& a, const LimitRate& b) {
    return std::abs(a.rate) > std::abs(b.rate);
  });
  return limits;
}

void conclude(MotionMargin& result, int unverified, bool unbounded) {
  const InstantMargin& worst = result.instants[static_cast<std::size_t>(result.worst)];
  if (unverified >= 0) {
    result.conclude(Status::kNumericalError,
                    fmt::format("the margin at {:g} s is not confirmed by the linear program",
                                result.instants[static_cast<std::size_t>(unverified)].t));
  } else if (result.infeasible > 0) {
    result.conclude(Status::kInfeasible,
                    fmt::format("the motion itself needs more than the actuators can exert at {} "
                                "of {} instants, most at {:g} s",
                                result.infeasible, result.instants.size(), worst.t));
  } else if (unbounded) {
    result.conclude(Status::kUnbounded, "no wrench of the set loads an actuator");
  } else {
    result.conclude(Status::kOptimal);
  }
}

}  // namespace

MotionMargin motion_margin(const Problem& task, const std::vector<Instant>& instants,
                           const MarginSet& set) {
  const Problem listed = task_of_margins(task, set);
  require_instants(task, instants);
  MotionMargin result;
  result.problem = task.name;
  result.set = words_of(listed, set);
  result.unit = listed.scenarios.unit;
  result.instants.resize(instants.size());
  InstantScan scan(listed, set);
  scan.scan(instants.front());  // sizes what it stores
  const MarginClock::time_point start = MarginClock::now();
  for (std::size_t i = 0; i < instants.size(); ++i) {
    end_if_interrupted();
    result.instants[i].margin = scan.scan(instants[i]);
  }
  result.wall_s = margin_seconds_since(start);
  const MarginClock::time_point checked = MarginClock::now();
  MarginCheck check(listed);
  int unverified = -1;
  bool unbounded = true;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    end_if_interrupted();
    InstantMargin& at = result.instants[i];
    scan.scan(instants[i]);
    const ScenarioLimits& limits =
        listed.scenarios.limits[static_cast<std::size_t>(scan.choice().limits)];
    at.t = instants[i].t;
    at.facet = scan.pair();
    at.limits = limits.name;
    if (std::isfinite(at.margin)) at.worst = scan.choice().c;
    at.binding = limits_of_facet(task.robot, limits.actuation, scan.slope());
    unbounded = unbounded && at.margin == kInfinity;
    if (at.margin == kInfinity) {
      at.conclude(Status::kUnbounded, "no wrench of the set loads an actuator");
    } else if (!check.verify(instants[i], scan, at, result)) {
      at.conclude(Status::kNumericalError, "not confirmed by the linear program");
      if (unverified < 0) unverified = static_cast<int>(i);
    } else if (scan.feasible()) {
      at.conclude(Status::kOptimal);
    } else {
      at.conclude(Status::kInfeasible, "the motion itself needs more than the actuators can exert");
      ++result.infeasible;
    }
    if (result.worst < 0 ||
        at.margin < result.instants[static_cast<std::size_t>(result.worst)].margin) {
      result.worst = static_cast<int>(i);
    }
  }
  result.checks_s = margin_seconds_since(checked);
  conclude(result, unverified, unbounded);
  return result;
}

}  // namespace maxwrench
