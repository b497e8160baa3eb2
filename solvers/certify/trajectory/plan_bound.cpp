#include "maxwrench/plan_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lib/math/random.h"
#include "lib/math/rotated.h"
#include "lib/robot/gears.h"
#include "lib/trajectory/limits.h"
#include "solvers/certify/certify.h"
#include "solvers/certify/trajectory/instant_bound.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

/// The number of boxes of the first look at each instant, which chooses the one to continue.
constexpr long kFirstBoxes = 400;
/// The branch and bound of an instant ends when it is this near to the best value found there.
constexpr double kInstantGap = 1e-3;

PlanInstant instant_of(const Problem& problem, const SchemeMaps& maps, int instant) {
  const auto at = static_cast<std::size_t>(instant);
  PlanInstant plan{problem, maps.x[at], {}, true};
  if (maps.smooth()) {
    plan.ranges = ranges_at(problem, maps, instant);
  } else {  // at rest: v = 0, and the differences that v_dot consists of are left out
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.redundancy());
    plan.ranges = {{problem.theta_r_min.array() - kTableTolerance,
                    problem.theta_r_max.array() + kTableTolerance},
                   {zero, zero},
                   {zero, zero}};
    plan.x.twist.setZero();
    plan.x.acceleration.setZero();
  }
  Problem& task = plan.task;
  plan.current = problem.robot.current;
  plan.x.twist.head<3>() -= plan.current;
  task.robot.current.setZero();
  if (problem.motion->c_turns) {
    const Eigen::Matrix3d turn = plan.x.pose.R * maps.x.front().pose.R.transpose();
    task.c = rotated(turn, problem.c);
  }
  task.motion.reset();
  task.pose = plan.x.pose;
  task.theta_r_min = plan.ranges.place.low;
  task.theta_r_max = plan.ranges.place.high;
  return plan;
}

/// The instants one of which limits a trajectory: the knots; of an impulse those of its peak. The
/// differences of `forward` and `ends` join instants, but at the last one both are zero.
std::vector<int> instants_of(const MotionTask& task, const SchemeMaps& maps) {
  if (!maps.smooth()) return {maps.instants() - 1};
  if (!task.impulse) return maps.knot_at;
  if (task.t_h > 0) return {maps.knot_at[static_cast<std::size_t>(task.t_h)]};
  return {maps.knot_at.begin() + 1, maps.knot_at.end()};
}

/// Bounds the instants of a task, and combines their bounds.
class PlanBounder {
 public:
  PlanBounder(const Problem& problem, double value, const CertifyOptions& options,
              PlanBound& result)
      : problem_(problem),
        value_(value),
        options_(options),
        result_(result),
        start_(std::chrono::steady_clock::now()),
        maps_(make_scheme(*problem.motion)),
        all_count_(problem.motion->impulse) {
    for (const int instant : instants_of(*problem.motion, maps_)) {
      looks_.push_back({.instant = instant, .t = maps_.t[static_cast<std::size_t>(instant)]});
    }
  }

  void run() {
    if (looks_.size() > 1) {
      for (Look& look : looks_) bound_one(look, kFirstBoxes, options_.seconds);
    }
    std::vector<Look*> order;
    for (Look& look : looks_) order.push_back(&look);
    // Along a path the least bound counts, and one instant is enough. Of an impulse any peak may be
    // the best: the highest bound counts, and all become lower.
    std::sort(order.begin(), order.end(), [this](const Look* a, const Look* b) {
      return all_count_ ? a->bound > b->bound : a->bound < b->bound;
    });
    if (!all_count_) order.resize(1);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double now = seconds();
      const double share = (options_.seconds - now) / static_cast<double>(order.size() - i);
      bound_one(*order[i], options_.boxes, now + share);
    }
    const auto below = [](const Look& a, const Look& b) { return a.bound < b.bound; };
    const Look& deciding = all_count_ ? *std::max_element(looks_.begin(), looks_.end(), below)
                                      : *std::min_element(looks_.begin(), looks_.end(), below);
    result_.bound = deciding.bound;
    if (deciding.bound < kInfinity) result_.t = deciding.t;
    result_.allowed = deciding.best.value;
    result_.seconds = seconds();
    conclude(deciding.how);
  }

 private:
  struct Look {
    int instant;
    double t;
    std::optional<PlanInstant> at = {};  ///< made by the first look: its ranges take time
    Candidate best = {};                 ///< of the relaxation
    double bound = kInfinity;            ///< also of an instant that was skipped
    Verdict how = {};                    ///< how the last look ended
  };

  bool is_interrupted() const { return options_.interrupted && options_.interrupted(); }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool is_over(double until) const { return seconds() > until || is_interrupted(); }

  /// Looks for a good motion at an instant: random ones, then steps from the best, which grow and
  /// shrink with their success.
  void look_around(Look& look, Objective& objective, double until) const {
    constexpr int kAtRandom = 600, kSteps = 1200;
    constexpr double kLarge = 0.2, kGrow = 1.5, kShrink = 0.98;
    Random random(1);
    const Eigen::VectorXd width = objective.upper() - objective.lower();
    double step = kLarge;
    Eigen::VectorXd x;
    for (int i = 0; i < kAtRandom + kSteps && !is_over(until); ++i) {
      const bool near = i >= kAtRandom && std::isfinite(look.best.value);
      x = near ? look.best.theta_r : (objective.lower() + objective.upper()) / 2;
      for (Eigen::Index k = 0; k < x.size(); ++k) {
        x[k] += (near ? step : 0.5) * width[k] * random.uniform(-1, 1);
      }
      x = x.cwiseMax(objective.lower()).cwiseMin(objective.upper());
      const double value = objective.evaluate(x);
      const bool better = value > look.best.value;
      if (better) look.best = {x, value};
      if (near) step = better ? std::min(kLarge, kGrow * step) : kShrink * step;
    }
  }

  /// Bounds one instant until a time since the start, or skips it if that is over. A later look
  /// begins anew.
  void bound_one(Look& look, long boxes, double until) {
    if (is_over(until)) {
      if (look.how.status == Status::kProven) return;
      look.how.conclude(Status::kBracket, is_interrupted() ? "interrupted" : "the time ran out");
      return;
    }
    if (!look.at) look.at = instant_of(problem_, maps_, look.instant);
    const auto bound = make_instant_bound(*look.at);
    const auto objective = make_instant_objective(*look.at);
    if (boxes > kFirstBoxes) look_around(look, *objective, until);
    CertifyOptions own = options_;
    own.gap = std::min(options_.gap, kInstantGap);
    own.boxes = boxes;
    own.seconds = std::max(0.0, until - seconds());
    // Bounds below the value of a known trajectory are impossible.
    Candidate known = look.best;
    if (value_ > known.value) {
      known = {(look.at->lower() + look.at->upper()) / 2, value_};
    }
    const CertifyResult result = certify(*objective, *bound, known, own);
    result_.boxes += result.boxes;
    look.bound = std::min(look.bound, result.bound);
    if (result.best.value > value_) look.best = result.best;
    look.how.conclude(result.status, result.reason.str());
  }

  void conclude(const Verdict& how) {
    const bool known = std::isfinite(value_);
    if (result_.bound == -kInfinity) {
      result_.conclude(Status::kInfeasible, "no trajectory has a value");
    } else if (known && result_.gap() <= options_.gap * (1 + 1e-6)) {
      result_.conclude(Status::kProven);
    } else if (how.status != Status::kProven && result_.bound > result_.allowed * (1 + 1e-2)) {
      result_.conclude(Status::kBracket, how.reason.str());
    } else {
      result_.conclude(Status::kBracket, fmt::format("the instant alone allows {:.5g}, whatever "
                                                     "happens before and after",
                                                     result_.allowed));
    }
  }

  const Problem& problem_;
  double value_;
  const CertifyOptions& options_;
  PlanBound& result_;
  std::chrono::steady_clock::time_point start_;
  SchemeMaps maps_;
  bool all_count_;
  std::vector<Look> looks_;
};

}  // namespace

std::string why_no_trajectory_bound(const Problem& task, const Options& options) {
  const auto unlike = [](const std::string& what, const std::string& got, const char* expected) {
    return what + ": got " + got + ", expected " + expected + " for a bound on trajectories";
  };
  if (!task.motion) return unlike(task.name, "a static task", "a trajectory or an impulse");
  const MotionTask& motion = *task.motion;
  const bool spline = motion.scheme == Scheme::kSpline;
  const std::vector<std::pair<bool, std::pair<const char*, const char*>>> cases = {
      {task.contact.has_value(), {"a second contact", "one contact"}},
      {!task.dependent.empty(), {"dependent joints", "a base whose pose has a closed form"}},
      {!task.scenarios.empty(), {"a list of scenarios", "one wrench of the nominal robot"}},
      {motion.transfer, {"a transfer", "a trajectory or an impulse"}},
      {motion.has_factor(), {"a payload or a table of wrenches", "one wrench"}},
      {motion.k < 2, {"k = 1", "k >= 2"}},
      {motion.impulse && !spline, {"an impulse with another scheme", "scheme spline"}},
      {!gears_at(task.robot, task.end_effector).empty(), {"a gear in the chain", "none"}},
      {!task.robot.no_dynamics.empty(), {"a robot without dynamics", "complete inertias"}}};
  for (const auto& [is, texts] : cases) {
    if (is) return unlike(task.name, texts.first, texts.second);
  }
  if (options.measure != "linf_polytope") {
    return unlike("measure", options.measure, "linf_polytope");
  }
  if (options.wrench != Wrench::kPure) return unlike("wrench", "any", "pure");
  return "";
}

double PlanBound::gap() const {
  if (!answer.has_value()) return kInfinity;
  return bound == answer.beta() ? 0 : (bound - answer.beta()) / std::abs(answer.beta());
}

PlanBound bound_trajectories(const Problem& task, const Options& options, const ProofOptions& how,
                             const Eigen::MatrixXd& knots) {
  Problem own = task;
  if (!options.check_collision) own.robot.collision = nullptr;
  if (const std::string why = why_no_trajectory_bound(own, options); !why.empty()) {
    throw std::invalid_argument(why);
  }
  if (how.keep_certificate) {
    throw std::invalid_argument("keep_certificate: got a bound on trajectories, expected false");
  }
  CertifyOptions limits;
  limits.gap = how.gap;
  limits.seconds = how.seconds;
  limits.threads = thread_count(options.threads);
  limits.interrupted = options.interrupted;
  require_valid(limits);
  PlanBound result;
  result.answer = knots.size() > 0 ? evaluate(own, knots, options) : solve(own, options);
  result.search_s = result.answer.wall_s;
  const double value = result.answer.has_value() ? result.answer.beta() : -kInfinity;
  if (how.progress) limits.progress = how.progress;
  PlanBounder(own, value, limits, result).run();
  if (!result.answer.has_value() && result.status != Status::kInfeasible) {
    static_cast<Verdict&>(result) = result.answer;
  }
  return result;
}

}  // namespace maxwrench
