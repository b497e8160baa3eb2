#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "maxwrench/certify.h"
#include "maxwrench/pareto.h"
#include "maxwrench/strategies.h"
#include "solvers/pareto/weighted.h"
#include "solvers/search/starts.h"
#include "solvers/solve/method.h"
#include "verify/certificate.h"
#include "verify/trajectory/provable.h"

namespace maxwrench {
namespace {

/// The budget of the second search of a weight, as a divisor of that of the first.
constexpr long kAgain = 4;
/// Weights below this share of a value are zero: cos of 90 degrees is not exactly.
constexpr double kLeastWeight = 1e-12;
constexpr double kSamePlace = 1e-12;
/// A task's own best is replaced by values that are larger by this share.
constexpr double kMoreThanOwn = 1e-6;
/// How often the front is made again with better ones.
constexpr int kMostAgain = 3;

[[noreturn]] void throw_unlike(const Problem& a, const Problem& b, const char* what) {
  throw std::invalid_argument(fmt::format(
      "against: got {}, expected a static task with the same {} as {}", b.name, what, a.name));
}

/// The digest of everything but the wrench: of the robot's data, the pose and theta_r.
std::uint64_t digest_without_wrench(Problem problem) {
  problem.c.setZero();
  problem.W_any.resize(6, 0);
  problem.scenarios = {};
  problem.free.wrench_turns = false;
  return digest(problem);
}

void require_alike(const Problem& a, const Problem& b) {
  if (a.motion || b.motion) throw_unlike(b.motion ? a : b, b.motion ? b : a, "kind of task");
  if (a.robot.name != b.robot.name || a.robot.actuation.B.rows() != b.robot.actuation.B.rows() ||
      a.robot.actuation.B.cols() != b.robot.actuation.B.cols() ||
      a.robot.actuation.B != b.robot.actuation.B) {
    throw_unlike(a, b, "robot");
  }
  if (a.end_effector != b.end_effector) throw_unlike(a, b, "end effector");
  if ((a.pose.R - b.pose.R).norm() + (a.pose.p - b.pose.p).norm() > kSamePlace) {
    throw_unlike(a, b, "pose");
  }
  if (a.redundant != b.redundant || a.free.axes != b.free.axes ||
      a.theta_r_min.size() != b.theta_r_min.size() || a.theta_r_min != b.theta_r_min ||
      a.theta_r_max != b.theta_r_max) {
    throw_unlike(a, b, "theta_r");
  }
  if (digest_without_wrench(a) != digest_without_wrench(b)) throw_unlike(a, b, "robot");
}

Case case_of(const Goal& goal, const Options& options) {
  Case c = options;
  c.measure = goal.measure;
  c.wrench = goal.wrench;
  c.solver = goal.solver;
  return c;
}

class FrontMaker {
 public:
  FrontMaker(const std::vector<Goal>& goals, const FrontPlan& plan, const Options& options)
      : goals_(goals), plan_(plan), given_(options), options_(options) {
    if (options_.search.empty()) options_.search = general_search();
    if (options_.budget == 0) options_.budget = kUsualBudget;
    how_.threads = thread_count(options.threads);
    how_.interrupted = options.interrupted;
    methods_.reserve(goals.size());
    for (const Goal& goal : goals) {
      methods_.push_back(resolve(goal.task, case_of(goal, options_)));
      if (methods_.back().trajectory_solver != nullptr) {
        throw std::invalid_argument(
            fmt::format("search: got '{}', which searches trajectories, expected another search",
                        options_.search));
      }
      objectives_.push_back(make_objective(goal.task, methods_.back()));
    }
  }

  Front make() {
    const auto start = std::chrono::steady_clock::now();
    if (find_own()) {
      find_all();
      find_compromise();
      bool raised = raise_own();
      for (int again = 0; raised && again < kMostAgain; ++again) {
        find_all();
        find_compromise();
        raised = raise_own();
      }
      for (FrontPoint& point : front_.points) point.weights = weights_at(point.phi);
      front_.compromise.weights = own_values();
      // Where no posture has a value of all tasks that count, there is no point.
      std::erase_if(front_.points,
                    [](const FrontPoint& point) { return point.theta_r.size() == 0; });
      for (FrontPoint& point : front_.points) finish(point);
      drop_dominated();
      front_.conclude(Status::kNoneFound, "no posture that was found supports all tasks");
      if (front_.compromise.theta_r.size() > 0) {
        finish(front_.compromise);
        front_.conclude(Status::kBestFound);
      }
      if (interrupted_) front_.conclude(Status::kBudgetExhausted, "interrupted");
    }
    front_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(front_);
  }

 private:
  /// The best posture of each task alone, by the default search of its own or the given one. False:
  /// one has no positive value, or the search for it was interrupted before.
  bool find_own() {
    bool all = true;
    for (const Goal& goal : goals_) {
      Options own = given_;
      static_cast<Case&>(own) = case_of(goal, given_);
      own.progress = {};
      Answer answer = solve(goal.task, own);
      front_.evaluations += answer.evaluations;
      interrupted_ = interrupted_ || answer.status == Status::kBudgetExhausted;
      if (!answer.has_value() || !(answer.beta() > 0)) {
        all = false;
        front_.conclude(Status::kNoneFound,
                        fmt::format("{} has no positive value", goal.task.name));
        if (interrupted_) front_.conclude(Status::kBudgetExhausted, "interrupted");
      }
      if (answer.has_value()) postures_.push_back(answer.posture.theta_r);
      front_.own.push_back(std::move(answer));
    }
    return all;
  }

  /// Searches for each weight of two tasks, twice: at first the starts are the best postures of the
  /// tasks, then those of all weights.
  void find_all() {
    front_.points.clear();
    if (plan_.points == 0) return;
    for (int i = 0; i < plan_.points; ++i) {
      FrontPoint point;
      point.phi = std::numbers::pi / 2 * i / (plan_.points - 1);
      point.weights = weights_at(point.phi);
      improve(point, options_.budget);
      front_.points.push_back(std::move(point));
    }
    add_postures();
    for (FrontPoint& point : front_.points) {
      improve(point, std::max(1L, options_.budget / kAgain));
    }
    postures_.resize(goals_.size());
    add_postures();
  }

  Eigen::VectorXd own_values() const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(goals_.size()));
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      values[k] = front_.own[static_cast<std::size_t>(k)].beta();
    }
    return values;
  }

  /// The weights of two tasks.
  Eigen::VectorXd weights_at(double phi) const {
    const Eigen::VectorXd own = own_values();
    Eigen::Vector2d weights(own[0] * std::cos(phi), own[1] * std::sin(phi));
    if (weights[0] < kLeastWeight * own[0]) weights[0] = 0;
    return weights;
  }

  /// Searches for one posture for all tasks.
  void find_compromise() {
    front_.compromise.weights = own_values();
    front_.compromise.phi =
        goals_.size() == 2 ? std::numbers::pi / 4 : std::numeric_limits<double>::quiet_NaN();
    improve(front_.compromise, options_.budget);
  }

  /// Replaces the own best of each task by what the front has found, if that is more. Returns
  /// whether any is.
  bool raise_own() {
    if (interrupted_) return false;
    bool raised = false;
    for (std::size_t k = 0; k < goals_.size(); ++k) {
      Answer& own = front_.own[k];
      const auto take = [&](const FrontPoint& point) {
        if (point.theta_r.size() == 0) return;
        Answer answer = answer_at(k, point.theta_r);
        if (!answer.has_value() || !(answer.beta() > own.beta() * (1 + kMoreThanOwn))) return;
        postures_[k] = point.theta_r;
        own = std::move(answer);
        raised = true;
      };
      std::for_each(front_.points.begin(), front_.points.end(), take);
      take(front_.compromise);
    }
    return raised;
  }

  /// The value of a task at a posture, verified from its data.
  Answer answer_at(std::size_t k, const Eigen::VectorXd& theta_r) const {
    Options here = options_;
    static_cast<Case&>(here) = case_of(goals_[k], options_);
    return evaluate(goals_[k].task, theta_r.transpose(), here);
  }

  void add_postures() {
    for (const FrontPoint& point : front_.points) {
      if (point.theta_r.size() > 0) postures_.push_back(point.theta_r);
    }
  }

  /// Searches from `postures_` and the point's own one; keeps what is better.
  void improve(FrontPoint& point, long budget) {
    const auto objective = make_weighted_objective(objectives_, point.weights);
    std::vector<Eigen::VectorXd> near = postures_;
    if (point.theta_r.size() > 0) near.push_back(point.theta_r);
    SearchOptions how = how_;
    how.seed = options_.seed;
    how.budget = budget;
    how.start = goals_.front().task.theta_r_default;
    how.starts = starts_among(near, *objective, how.budget);
    SearchResult result = methods_.front().search->make()->maximize(*objective, how);
    include_starts(how.starts, result);
    front_.evaluations += budget - how.budget + result.evaluations;
    interrupted_ = interrupted_ || result.interrupted;
    if (result.status == Status::kBestFound) point.theta_r = result.theta_r;
  }

  /// Evaluates all tasks at the posture, verified from their data, and proves a bound.
  void finish(FrontPoint& point) const {
    const auto count = static_cast<Eigen::Index>(goals_.size());
    point.beta.resize(count);
    point.t = kInfinity;
    for (Eigen::Index k = 0; k < count; ++k) {
      const Answer answer = answer_at(static_cast<std::size_t>(k), point.theta_r);
      point.beta[k] = answer.has_value() ? answer.beta() : std::numeric_limits<double>::quiet_NaN();
      if (point.weights[k] > 0) point.t = std::min(point.t, point.beta[k] / point.weights[k]);
    }
    if (plan_.bound && !interrupted_) point.bound = bound_of(point);
  }

  /// A bound of min beta_k / w_k, as that of the list {w_k c_k}.
  double bound_of(const FrontPoint& point) const {
    Problem list = goals_.front().task;
    list.scenarios = {};
    for (std::size_t k = 0; k < goals_.size(); ++k) {
      const double weight = point.weights[static_cast<Eigen::Index>(k)];
      if (weight > 0) {
        list.scenarios.wrenches.push_back({goals_[k].task.name, weight * goals_[k].task.c});
      }
    }
    list.scenarios.limits = {{"", list.robot.actuation}};
    list.scenarios.unit = "-";
    list.c = list.scenarios.wrenches.front().c.normalized();
    Options options = options_;
    options.measure = Case().measure;
    options.wrench = Wrench::kPure;
    options.solver.clear();
    options.progress = {};
    ProofOptions how;
    how.gap = plan_.gap;
    how.seconds = plan_.seconds;
    return certify(list, options, how).bound;
  }

  void drop_dominated() {
    const auto dominates = [](const FrontPoint& a, const FrontPoint& b) {
      return (a.beta.array() >= b.beta.array()).all() && (a.beta.array() > b.beta.array()).any();
    };
    const std::vector<FrontPoint> all = front_.points;
    std::erase_if(front_.points, [&](const FrontPoint& point) {
      return std::any_of(all.begin(), all.end(),
                         [&](const FrontPoint& other) { return dominates(other, point); });
    });
    front_.dominated = static_cast<long>(all.size() - front_.points.size());
  }

  const std::vector<Goal>& goals_;
  const FrontPlan& plan_;
  const Options& given_;
  Options options_;
  SearchOptions how_;
  std::vector<Method> methods_;
  std::vector<std::unique_ptr<Objective>> objectives_;
  std::vector<Eigen::VectorXd> postures_;
  Front front_;
  bool interrupted_ = false;
};

/// Bounds are those of lists of wrenches of one robot.
void require_provable(const std::vector<Goal>& goals) {
  for (const Goal& goal : goals) {
    if (goal.measure == Case().measure && goal.wrench == Wrench::kPure &&
        goal.task.scenarios.empty() && !goal.task.contact) {
      continue;
    }
    throw std::invalid_argument(fmt::format(
        "certify: got {} with measure {} and wrench {}, expected {} with one pure wrench of one "
        "contact",
        goal.task.name, goal.measure, to_string(goal.wrench), Case().measure));
  }
}

}  // namespace

Front pareto(const std::vector<Goal>& goals, const FrontPlan& plan, const Options& options) {
  if (goals.size() < 2) {
    throw std::invalid_argument(
        fmt::format("against: got {} tasks, expected two or more", goals.size()));
  }
  for (const Goal& goal : goals) require_alike(goals.front().task, goal.task);
  const bool front = plan.points != 0;
  if (plan.points < 0 || plan.points == 1 || plan.points > kMostFrontPoints) {
    throw std::invalid_argument(fmt::format("points: got {}, expected 2 to {}, or 0 for none",
                                            plan.points, kMostFrontPoints));
  }
  if (front && goals.size() > 2) {
    throw std::invalid_argument(
        fmt::format("points: got {}, expected 0 for {} tasks: only two have a front", plan.points,
                    goals.size()));
  }
  if (plan.bound) require_provable(goals);
  return FrontMaker(goals, plan, options).make();
}

}  // namespace maxwrench
