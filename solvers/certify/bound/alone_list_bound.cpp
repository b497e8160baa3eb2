#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lib/scenario/ball_across.h"
#include "lib/scenario/scenario_list.h"
#include "solvers/certify/bound/bounds.h"
#include "solvers/certify/bound/loop_posture.h"
#include "solvers/certify/trajectory/instant_bound.h"
#include "solvers/solve/scenario_alone.h"

namespace maxwrench {
namespace {

/// Each box may try all of them.
constexpr std::size_t kMostAlone = 64;

[[noreturn]] void reject_alone(const Problem& problem, const std::string& got,
                               const std::string& expected) {
  throw std::invalid_argument("certify: got " + got + ", expected " + expected + " (" +
                              problem.name + ")");
}

/// One scenario with its bound, which refers to the instant or its task.
struct Alone {
  std::shared_ptr<const PlanInstant> at;  ///< the task; x is the motion relative to the water
  double length = 1;                      ///< of the wrench for a factor of 1
  std::unique_ptr<Bound> bound;
};

/// The bound of a posture that rests in a current, in axes that move with the water: an instant of
/// a motion at -v_c without rates of theta_r.
class RestingBound final : public Bound {
 public:
  RestingBound(std::unique_ptr<Bound> instant, Eigen::Index r)
      : instant_(std::move(instant)), none_(Eigen::VectorXd::Zero(r)) {}

  double ceiling() const override { return instant_->ceiling(); }
  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    Eigen::VectorXd least(2 * none_.size()), most(2 * none_.size());
    least << lower, none_;
    most << upper, none_;
    instant_->evaluate(least, most, low, high, proof);
    if (proof.axis >= none_.size()) proof.axis = -1;
  }
  std::unique_ptr<Bound> clone() const override {
    return std::make_unique<RestingBound>(instant_->clone(), none_.size());
  }

 private:
  std::unique_ptr<Bound> instant_;
  Eigen::VectorXd none_;
};

/// The task of a ball: c is its first axis, and W has a column for each axis.
Problem with_ball(Problem task, const WrenchBall& ball) {
  const Matrix6Xd F = task.W_any.rightCols(task.W_any.cols() - 1);
  task.W_any.resize(6, ball.E.cols() + F.cols());
  task.W_any << ball.E, F;
  return task;
}

/// A ball of one axis is a wrench of each sign. One of two axes stands for its first axis.
Problem with_wrenches_of_ball(Problem problem) {
  ScenarioList& list = problem.scenarios;
  if (!list.ball) return problem;
  std::vector<ScenarioWrench> wrenches;
  for (const ScenarioWrench& each : list.wrenches) {
    wrenches.push_back(each);
    if (each.hold) continue;
    wrenches.back().c = list.ball->radius * list.ball->E.col(0);
    if (list.ball->E.cols() == 2) continue;
    wrenches.push_back(wrenches.back());
    wrenches.back().c *= -1;
  }
  list.wrenches = std::move(wrenches);
  return problem;
}

/// `disc` is a ball of two axes, or null.
std::unique_ptr<Bound> bound_alone(const PlanInstant& at, Wrench wrench, const WrenchBall* disc) {
  if (disc) return make_ball_any_bound(at.task, disc->E);
  if (wrench == Wrench::kAny) return make_any_wrench_bound(at.task);
  if (at.rests()) return make_pure_bound(at.task, "linf_polytope");
  return std::make_unique<RestingBound>(make_instant_bound(at), at.task.redundancy());
}

/// A task with the wet masses and first moments of the cases, and at -v_c of their current.
PlanInstant instant_with(const Problem& alone, const std::vector<const LoadCase*>& cases) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(alone.redundancy());
  PlanInstant at{
      alone, {}, {{alone.theta_r_min, alone.theta_r_max}, {none, none}, {none, none}}, false};
  at.x.pose = alone.pose;
  at.x.twist.setZero();
  at.x.acceleration.setZero();
  Robot& robot = at.task.robot;
  robot.parts.clear();
  robot.current.setZero();
  std::vector<LinkLoad> changes(robot.links.size());  // the sum of the cases' on each link
  for (const LoadCase* load : cases) {
    at.x.twist.head<3>() -= load->current;
    for (const LinkLoad& each : load->loads) {
      LinkLoad& change = changes[static_cast<std::size_t>(each.link)];
      change.mass += each.mass;
      change.moment += each.moment;
    }
  }
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const LinkLoad& change = changes[i];
    if (change.mass == 0 && change.moment.isZero(0)) continue;
    Link& link = robot.links[i];
    const Eigen::Vector3d moment = link.mass * link.com + change.moment;
    link.mass += change.mass;
    // Only its weight counts, so a link may weigh less than nothing, but not nothing.
    if (std::abs(link.mass) < 1e-6 * (1 + std::abs(change.mass))) {
      reject_alone(alone, "loads that take all mass of '" + link.name + "'", "a heavier link");
    }
    link.com = moment / link.mass;
  }
  return at;
}

/// All choices of one case from each group; with any wrenches, of those without a current.
std::vector<std::vector<const LoadCase*>> choices_of(const Problem& problem, Wrench wrench) {
  std::vector<std::vector<const LoadCase*>> all = {{}};
  for (const LoadGroup& group : problem.scenarios.loads) {
    std::vector<std::vector<const LoadCase*>> longer;
    for (const auto& some : all) {
      for (const LoadCase& load : group) {
        if (wrench == Wrench::kAny && !load.current.isZero(0)) continue;
        longer.push_back(some);
        longer.back().push_back(&load);
      }
      if (longer.size() > kMostAlone) break;  // rejected by its caller
    }
    if (longer.empty()) {
      reject_alone(problem, "any wrenches in a current, which have no bound", "wrench pure");
    }
    all = std::move(longer);
  }
  return all;
}

/// What makes a list that has its scenarios bounded one by one.
const char* kind_of(const Problem& problem, Wrench wrench) {
  if (wrench == Wrench::kAny) return "any wrenches";
  return problem.contact_columns() > 0 ? "forces of a second contact" : "a known current";
}

/// The scenarios with a wrench and finite limits. Those that have no bound are left out if others
/// have one: the least of some bounds is a bound of the list.
std::vector<Alone> scenarios_alone(const Problem& list_task, Wrench wrench) {
  const Problem problem = with_wrenches_of_ball(list_task);
  const std::optional<WrenchBall>& ball = problem.scenarios.ball;
  const WrenchBall* disc = ball && ball->E.cols() == 2 ? &*ball : nullptr;
  const auto choices = choices_of(problem, wrench);
  const int count = scenario_count(problem);
  if (static_cast<std::size_t>(count) * choices.size() > kMostAlone) {
    reject_alone(problem, std::string(kind_of(problem, wrench)) + " with many scenarios",
                 "at most " + std::to_string(kMostAlone) + " of them");
  }
  std::vector<Alone> all;
  std::string why;  // one has no bound
  for (int i = 0; i < count; ++i) {
    ScenarioTask one = scenario_alone(problem, i);
    if (disc && one.length > 0) one.task = with_ball(std::move(one.task), *disc);
    const Zonotope& set = one.task.robot.actuation;
    if (one.length == 0 || !set.u_min.allFinite() || !set.u_max.allFinite()) continue;
    for (const auto& cases : choices) {
      auto at = std::make_shared<const PlanInstant>(instant_with(one.task, cases));
      try {
        std::unique_ptr<Bound> bound = bound_alone(*at, wrench, disc);
        all.push_back({std::move(at), one.length, std::move(bound)});
      } catch (const std::invalid_argument& error) {
        why = error.what();
      }
    }
  }
  if (all.empty() && !why.empty()) throw std::invalid_argument(why);
  if (all.empty()) reject_alone(problem, "no scenario with finite limits", "one");
  return all;
}

/// The least of the bounds of the scenarios. The multiplier is [number of the scenario; its own].
///
/// The forces of a second contact differ between scenarios. So the coordinates of a box are those
/// that all scenarios share, then the shares of the contact forces of each scenario. Else a box
/// would bound each scenario with some of its forces only, and the least of these is no bound.
class AloneListBound final : public Bound {
 public:
  /// `shares` is the number of shares of one scenario.
  AloneListBound(std::vector<Alone> scenarios, Eigen::Index shares)
      : scenarios_(std::move(scenarios)), shares_(shares) {}

  void extend(Eigen::VectorXd& lower, Eigen::VectorXd& upper) const override {
    scenarios_.front().bound->extend(lower, upper);
    for (Eigen::VectorXd* limits : {&lower, &upper}) {
      const Eigen::VectorXd one = *limits;
      limits->resize(one.size() + others() * shares_);
      *limits << one, one.tail(shares_).replicate(others(), 1);
    }
  }

  bool shrink(Eigen::VectorXd& lower, Eigen::VectorXd& upper, std::vector<BoxCut>* cuts) override {
    Eigen::VectorXd least = part_of(lower, 0), most = part_of(upper, 0);
    if (!scenarios_.front().bound->shrink(least, most, cuts)) return false;
    lower.head(least.size()) = least;
    upper.head(most.size()) = most;
    return true;
  }

  double ceiling() const override {
    double least = kInfinity;
    for (const Alone& each : scenarios_) {
      least = std::min(least, up(each.bound->ceiling() / each.length));
    }
    return least;
  }

  void evaluate(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double low, double high,
                BoxProof& proof) override {
    const bool known = proof.multiplier.size() > 0;
    const auto first = static_cast<std::size_t>(known ? proof.multiplier[0] : 0);
    BoxProof larger;  // what is known of the scenario that bounded the larger box
    if (known) larger.multiplier = proof.multiplier.tail(proof.multiplier.size() - 1);
    larger.basis = std::exchange(proof.basis, {});
    larger.axis = proof.axis;
    proof.forget(high);
    // A value of the list may be below the lower end of a scenario by kEndTolerance (1 + |high|).
    const double most = high + 2 * kEndTolerance * (1 + std::abs(high));
    std::size_t decides = first;
    for (std::size_t k = 0; k < scenarios_.size() && proof.high > low; ++k) {
      const std::size_t s = (first + k) % scenarios_.size();
      const Alone& each = scenarios_[s];
      BoxProof own;
      if (s == first) own = larger;
      each.bound->evaluate(part_of(lower, s), part_of(upper, s), down(low * each.length),
                           up(most * each.length), own);
      if (own.kind == BoxProof::Kind::kNoPosture) {
        proof.exclude(own.nu);
        return;
      }
      const double factor = up(own.high / each.length);
      if (!(factor < proof.high)) continue;
      Eigen::VectorXd numbers(own.multiplier.size() + 1);
      numbers << static_cast<double>(s), own.multiplier;
      proof.improve(factor, numbers);
      proof.basis = own.basis;
      decides = s;
    }
    if (shares_ > 0 && proof.axis < 0) proof.axis = widest(upper - lower, decides);
  }

  std::unique_ptr<Bound> clone() const override {
    std::vector<Alone> copies;
    for (const Alone& each : scenarios_) {
      copies.push_back({each.at, each.length, each.bound->clone()});
    }
    return std::make_unique<AloneListBound>(std::move(copies), shares_);
  }

 private:
  Eigen::Index others() const { return static_cast<Eigen::Index>(scenarios_.size()) - 1; }

  /// Where the shares of a scenario begin in the coordinates x of a box.
  Eigen::Index shares_of(Eigen::Index coordinates, std::size_t scenario) const {
    const Eigen::Index after = others() + 1 - static_cast<Eigen::Index>(scenario);
    return coordinates - after * shares_;
  }

  /// The coordinates of a scenario alone.
  Eigen::VectorXd part_of(const Eigen::VectorXd& x, std::size_t scenario) const {
    Eigen::VectorXd part(x.size() - others() * shares_);
    part << x.head(shares_of(x.size(), 0)), x.segment(shares_of(x.size(), scenario), shares_);
    return part;
  }

  /// The widest coordinate of a scenario.
  int widest(const Eigen::VectorXd& widths, std::size_t scenario) const {
    const Eigen::Index shared = shares_of(widths.size(), 0);
    Eigen::Index axis = 0;
    part_of(widths, scenario).maxCoeff(&axis);
    if (axis >= shared) axis += shares_of(widths.size(), scenario) - shared;
    return static_cast<int>(axis);
  }

  /// Beyond the rounding of a product or quotient.
  static constexpr double kFactorRounding = 4 * std::numeric_limits<double>::epsilon();
  static double up(double x) { return std::isfinite(x) ? x + kFactorRounding * std::abs(x) : x; }
  static double down(double x) { return std::isfinite(x) ? x - kFactorRounding * std::abs(x) : x; }

  std::vector<Alone> scenarios_;
  Eigen::Index shares_;
};

/// Rejects lists whose scenarios have no bound of a base that follows in closed form.
void require_closed_form(const Problem& problem, Wrench wrench) {
  const ScenarioList& list = problem.scenarios;
  const std::string kind = kind_of(problem, wrench);
  const bool any_ball = wrench == Wrench::kAny && BallAcross::supports(list);
  if (list.payload || (list.ball && !any_ball)) {
    reject_alone(problem, kind + " with a ball or a payload", "wrenches one by one");
  }
  if (problem.contact || !problem.dependent.empty() || problem.free.count() > 0) {
    reject_alone(problem, kind + " at a pose that is partly free, or with dependent joints",
                 "a fixed pose and a base that follows in closed form");
  }
}

/// Rejects lists with forces of a second contact whose scenarios are no ordinary tasks.
void require_wrenches(const Problem& problem, Wrench wrench) {
  const ScenarioList& list = problem.scenarios;
  const std::string kind = kind_of(problem, wrench);
  if (list.ball && !(BallAcross::supports(list) && list.ball->E.cols() == 1)) {
    reject_alone(problem, kind + " with a ball of several axes", "wrenches one by one");
  }
  if (list.payload && problem.free.count() > 0) {
    reject_alone(problem, kind + " with a payload at a pose that is partly free", "a fixed pose");
  }
}

}  // namespace

bool has_still_water(const ScenarioList& list) {
  return std::all_of(list.loads.begin(), list.loads.end(), [](const LoadGroup& group) {
    return std::any_of(group.begin(), group.end(),
                       [](const LoadCase& load) { return load.current.isZero(0); });
  });
}

std::unique_ptr<Bound> make_alone_list_bound(const Problem& problem, Wrench wrench) {
  const bool of_base = base_determines_forces(problem);  // as the bounds of ordinary tasks
  const Eigen::Index shares = of_base ? 0 : problem.contact_columns();
  if (problem.contact_columns() > 0) {
    require_wrenches(problem, wrench);
  } else {
    require_closed_form(problem, wrench);
  }
  return std::make_unique<AloneListBound>(scenarios_alone(problem, wrench), shares);
}

}  // namespace maxwrench
