#include "solvers/margin/instant_scan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/math/rotated.h"
#include "lib/scenario/current_load.h"

namespace maxwrench {
namespace {

constexpr double kOrthonormal = 1e-9;  // of E'E
/// [N, N m] What rounding may make of a motion that just meets its limits, relative to its size.
constexpr double kFeasible = 1e-9;

[[noreturn]] void reject(const char* key, const std::string& got, const std::string& expected) {
  throw std::invalid_argument(fmt::format("{}: got {}, expected {}", key, got, expected));
}

void require_axes(const Matrix6Xd& E) {
  const Eigen::Index d = E.cols();
  const bool finite = E.allFinite() && d >= 1 && d <= 3;
  if (!finite || !(E.transpose() * E).isIdentity(kOrthonormal)) {
    reject("margin", "E that is not orthonormal", "one to three orthonormal axes");
  }
  if (!E.topRows<3>().isZero(kOrthonormal) && !E.bottomRows<3>().isZero(kOrthonormal)) {
    reject("margin", "axes of forces and torques", "axes of forces or of torques");
  }
}

}  // namespace

MarginSet margin_ball(const std::vector<std::string>& axes, bool in_end_effector) {
  MarginSet set;
  set.E = Matrix6Xd::Zero(6, static_cast<Eigen::Index>(axes.size()));
  set.in_end_effector = in_end_effector;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const auto found = std::find(kWrenchAxes.begin(), kWrenchAxes.end(), axes[k]);
    if (found == kWrenchAxes.end()) {
      reject("ball", axes[k], fmt::format("some of {}", fmt::join(kWrenchAxes, " ")));
    }
    if (std::count(axes.begin(), axes.end(), axes[k]) > 1) {
      reject("ball", axes[k] + " twice", "each axis once");
    }
    set.E(found - kWrenchAxes.begin(), static_cast<Eigen::Index>(k)) = 1;
  }
  if (axes.empty())
    reject("ball", "no axes", fmt::format("some of {}", fmt::join(kWrenchAxes, " ")));
  if (!set.E.topRows<3>().isZero(0) && !set.E.bottomRows<3>().isZero(0)) {
    reject("ball", fmt::format("{}", fmt::join(axes, " ")), "axes of forces or of torques");
  }
  return set;
}

Problem task_of_margins(const Problem& task, const MarginSet& set) {
  if (task.contact) reject("contact", "a second contact", "a task with one contact");
  if (!task.robot.actuation.has_facets) {
    reject("robot", task.robot.name, "a robot whose actuators have few facets");
  }
  const ScenarioList& own = task.scenarios;
  const auto is_known = [](const LoadGroup& cases) {
    return cases.size() == 1 && cases.front().name.empty() && has_current(cases);
  };
  if (std::any_of(own.loads.begin(), own.loads.end(), is_known)) {
    reject("environment.current", "a known current in " + task.name + ", a static task",
           "still water, or a task in time, whose motion it belongs to");
  }
  if (!own.loads.empty()) {
    reject("uncertainty", "uncertain loads or a current, which are loads at rest",
           "a task without them: --nominal leaves out uncertain ones");
  }
  Problem result = task;
  ScenarioList& list = result.scenarios;
  if (list.limits.empty()) list.limits.push_back({"", task.robot.actuation});
  list.non_negative = false;
  list.payload.reset();
  list.F = Matrix6Xd(6, 0);
  if (!set.of_task) {
    require_axes(set.E);
    list.wrenches = {{"", Vector6d::Zero()}};
    list.ball = WrenchBall{set.E, 1};
    list.unit = set.E.topRows<3>().isZero(kOrthonormal) ? "N m" : "N";
    return result;
  }
  if (own.payload) {
    reject("payload", "a load at rest", "a payload of a task in time, or a ball of wrenches");
  }
  if (!own.empty()) return result;
  list.wrenches = {{"", task.c}};
  list.ball.reset();
  list.unit = task.unit();
  return result;
}

InstantForces::InstantForces(const Problem& task, const MarginSet& set)
    : task_(task),
      turns_(set.of_task ? task.wrench_in_end_effector : set.in_end_effector),
      of_task_(set.of_task) {}

/// Wrenches of a task are given at its pose, E in axes of the end effector itself.
void InstantForces::set(const Instant& instant) {
  instant_ = &instant;
  if (!turns_) return;
  turn_ = instant.end_effector.R;
  if (of_task_) turn_ *= task_.pose.R.transpose();
}

Vector6d InstantForces::wrench(int i) const {
  if (of_task_ && task_.motion && task_.motion->has_factor()) return instant_->c;
  const Vector6d& c = task_.scenarios.wrenches[static_cast<std::size_t>(i)].c;
  return turns_ ? Vector6d(rotated(turn_, c)) : c;
}

Vector6d InstantForces::ball_axis(Eigen::Index i) const {
  const WrenchBall& ball = *task_.scenarios.ball;
  const Vector6d axis = ball.radius * ball.E.col(i);
  return turns_ ? Vector6d(rotated(turn_, axis)) : axis;
}

InstantScan::InstantScan(const Problem& task, const MarginSet& set)
    : task_(task), forces_(task, set), facets_(task) {
  slope_.setZero(task.robot.velocities());
}

double InstantScan::scan(const Instant& instant) {
  forces_.set(instant);
  facets_.scan(forces_);
  pair_ = -1;
  choice_.c.setZero();
  choice_.limits = 0;
  slope_.setZero();
  const double help = std::max(facets_.missed ? kInfinity : facets_.low, -facets_.high);
  const double rounding = kFeasible * (1 + instant.tau_d.lpNorm<Eigen::Infinity>());
  feasible_ = !facets_.missed && !(facets_.high < -rounding) && !(facets_.low > rounding);
  if (!feasible_ && !(help == -facets_.high)) {
    facets_.low_scenario(forces_, choice_);
    pair_ = facets_.low_pair();
    bind_low(instant);
    return -help;
  }
  if (facets_.high_scenario(forces_, choice_)) {
    pair_ = facets_.high_pair();
    facets_.fill_slope(slope_);
  }
  return feasible_ ? std::max(0.0, facets_.high) : facets_.high;
}

/// Sets the slope to the facet that the motion violates, scaled as that of an upper end.
void InstantScan::bind_low(const Instant& instant) {
  const Zonotope& set = task_.scenarios.limits[static_cast<std::size_t>(choice_.limits)].actuation;
  double value = 0;
  for (Eigen::Index i = 0; i < instant.tau_d.size(); ++i) {
    slope_[i] = -set.N(i, pair_);
    value += set.N(i, pair_) * instant.tau_d[i];
  }
  if (value < set.b_min[pair_]) slope_ = -slope_;
  if (facets_.missed) return;
  slope_ /= std::abs(choice_.c.dot(instant.J.lazyProduct(slope_)));
}

}  // namespace maxwrench
