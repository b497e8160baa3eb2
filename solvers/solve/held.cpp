#include "maxwrench/held.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lib/math/decompositions.h"
#include "maxwrench/objective.h"
#include "maxwrench/search.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/trajectory_proof.h"
#include "solvers/solve/method.h"
#include "solvers/solve/tank.h"
#include "verify/trajectory/provable.h"

namespace maxwrench {
namespace {

/// Knots move by at most this from the first trajectory, in each direction [rad, m].
constexpr double kMostMove = 0.05;
/// Limits of the share of the value that is planned.
constexpr double kLeastShare = 0.8, kMostShare = 1.05;
/// Shares of the value with which a first trajectory is tried, until one is held.
constexpr std::array kFirstShares = {1.0, 0.99, 0.97, 0.94, 0.9, 0.85};
/// The first and the last step by which the share of the best first trajectory rises.
constexpr double kFirstRise = 0.01, kLastRise = 0.001;
/// Two limits of a row that are nearer than this are an equation.
constexpr double kWidthOfEquation = 1e-12;
/// The search of the upper level.
constexpr const char* kUpperSearch = "cmaes";

/// What one experiment is run with.
struct Experimenter {
  const Problem& task;
  const Method& method;
  const HeldOptions& how;

  /// The experiment of knots with a planned share of their value. Empty samples: no plan.
  TankRun run(TrajectoryEvaluator& evaluator, const Eigen::MatrixXd& knots, double share) const {
    TankRun run;
    static_cast<Verdict&>(run) = evaluator.evaluate(knots);
    if (run.status != Status::kOptimal) return run;
    evaluator.evaluate_between_knots();
    ScriptOptions script;
    script.interpolation = usual_interpolation(task);
    script.margin = how.tank.margin;
    const Trajectory& trajectory = evaluator.trajectory();
    const double value = script.interpolation == Interpolation::kSpline
                             ? trajectory.value_between_knots
                             : trajectory.value;
    if (!(value > 0)) {
      run.conclude(Status::kInfeasible, "no wrench > 0 along c is possible");
      return run;
    }
    script.planned = share * value;
    return simulate_trajectory(task, trajectory, method.choice.wrench, *method.trajectory_solver,
                               script, how.integrator, how.tank)
        .run;
  }
};

/// The reading of an experiment that was held, else -infinity.
double held_reading(const TankRun& run) {
  return run.summary.held ? reading_of(run.summary) : -kInfinity;
}

/// A basis of the knots that satisfy the equations among the rows.
Eigen::MatrixXd free_moves(const KnotRows& rows, Eigen::Index size) {
  const Eigen::MatrixXd all(rows.R);
  std::vector<Eigen::Index> equations;
  for (Eigen::Index r = 0; r < all.rows(); ++r) {
    if (rows.r_max[r] - rows.r_min[r] <= kWidthOfEquation) equations.push_back(r);
  }
  if (equations.empty()) return Eigen::MatrixXd::Identity(size, size);
  const Eigen::MatrixXd E = all(equations, Eigen::all);
  return split(E.transpose(), 1e-9).complement;
}

/// The point with the largest reading that was held, and its experiment. The lesser point of two
/// that are equal, so the threads do not matter.
class BestRun {
 public:
  void offer(const Eigen::VectorXd& x, double reading, const TankRun& run) {
    const std::scoped_lock lock(mutex_);
    if (reading < reading_ || reading == -kInfinity) return;
    if (reading == reading_ &&
        !std::lexicographical_compare(x.begin(), x.end(), x_.begin(), x_.end()))
      return;
    x_ = x;
    reading_ = reading;
    run_ = run;
  }
  const Eigen::VectorXd& x() const { return x_; }
  double reading() const { return reading_; }
  const TankRun& run() const { return run_; }

 private:
  std::mutex mutex_;
  Eigen::VectorXd x_;
  double reading_ = -kInfinity;
  TankRun run_;
};

/// The reading over x = (moves z of the knots, share), knots = first + Z z.
class HeldObjective final : public Objective {
 public:
  HeldObjective(const Experimenter& experimenter, Eigen::VectorXd first,
                std::shared_ptr<BestRun> best)
      : experimenter_(experimenter),
        best_(std::move(best)),
        evaluator_(experimenter.task, experimenter.method.choice.wrench,
                   experimenter.method.trajectory_solver->make),
        first_(std::move(first)),
        Z_(free_moves(evaluator_.rows(), first_.size())) {
    lower_.setConstant(Z_.cols() + 1, -kMostMove);
    upper_.setConstant(Z_.cols() + 1, kMostMove);
    lower_.tail<1>().setConstant(kLeastShare);
    upper_.tail<1>().setConstant(kMostShare);
  }

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  const Verdict& verdict() const override { return verdict_; }
  Eigen::MatrixXd knots(const Eigen::VectorXd& x) const {
    return unstacked(first_ + Z_ * x.head(Z_.cols()), evaluator_.knots());
  }

  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) override {
    if (gradient) gradient->setConstant(x.size(), std::numeric_limits<double>::quiet_NaN());
    const TankRun run = experimenter_.run(evaluator_, knots(x), x.tail<1>()[0]);
    verdict_ = run;
    const double reading = held_reading(run);
    if (reading > -kInfinity) {
      verdict_.conclude(Status::kOptimal);
      best_->offer(x, reading, run);
    } else if (run.status == Status::kReached) {
      verdict_.conclude(Status::kInfeasible, run.summary.missed);
    }
    return reading;
  }

  std::unique_ptr<Objective> clone() const override {
    return std::make_unique<HeldObjective>(experimenter_, first_, best_);
  }

 private:
  const Experimenter experimenter_;
  const std::shared_ptr<BestRun> best_;  // of all clones
  TrajectoryEvaluator evaluator_;
  Eigen::VectorXd first_, lower_, upper_;
  Eigen::MatrixXd Z_;
  Verdict verdict_;
};

/// The best trajectory that is found. The tank holds none whose joints are too fast between the
/// instants of a search, so it is a proven one, where proofs support the task.
Answer planned_trajectory(const Problem& task, const Options& options) {
  const bool provable = options.wrench == Wrench::kPure &&
                        usual_interpolation(task) == Interpolation::kSpline &&
                        why_unprovable(task).empty();
  return provable ? solve_proven(task, options).answer : solve(task, options);
}

/// A trajectory with the share that is held, and its experiment.
struct First {
  Eigen::VectorXd knots;
  double share = 1, reading = -kInfinity;
  TankRun run = {};
};

void require_supported(const Problem& task, const Options& options, const HeldOptions& how) {
  check(how.tank);
  if (!task.motion || task.motion->has_factor() || !task.scenarios.empty()) {
    const char* const got = !task.motion                ? "a static task"
                            : task.motion->has_factor() ? "a payload or a table of wrenches"
                                                        : "a list of scenarios";
    throw std::invalid_argument(task.name + ": got " + got +
                                ", expected a task in time with one wrench along c for the tank");
  }
  if (options.measure != Case().measure) {
    throw std::invalid_argument("measure: got " + options.measure + ", expected " + Case().measure +
                                " for a task in time");
  }
  if (how.simulations < 1) {
    throw std::invalid_argument("simulations: got " + std::to_string(how.simulations) +
                                ", expected 1 or more");
  }
  const std::vector<std::string> stiff = stiff_integrators();
  if (std::find(stiff.begin(), stiff.end(), how.integrator) == stiff.end()) {
    throw std::invalid_argument("integrator: got " + how.integrator +
                                ", expected one for stiff systems");
  }
}

/// The search, from the first trajectories to the result.
class HeldSearch {
 public:
  HeldSearch(const Problem& task, const Options& options, const HeldOptions& how)
      : plain_(task), task_(task), options_(options), how_(how) {
    task_.motion->thruster_lag = std::max(task_.motion->thruster_lag, how.tank.thruster_lag);
    how_.tank.interrupted = options.interrupted;
  }

  HeldTrajectory run() {
    const auto start = std::chrono::steady_clock::now();
    Case given = options_;
    given.search.clear();
    const Method method = resolve(task_, given);
    const Experimenter experimenter{task_, method, how_};
    HeldTrajectory held;
    held.conclude(Status::kNoneFound, "no experiment was held");
    TrajectoryEvaluator evaluator(task_, method.choice.wrench, method.trajectory_solver->make);
    First best;
    Options quiet = options_;  // the progress is that of the experiments
    quiet.progress = {};
    for (const Problem* planned : {&std::as_const(task_), &plain_}) {
      if (planned == &plain_ && plain_.motion->thruster_lag == task_.motion->thruster_lag) break;
      if (interrupted()) break;
      const Answer plan = planned_trajectory(*planned, quiet);
      if (!plan.has_posture()) continue;
      First first = try_shares(experimenter, evaluator, stacked(plan.trajectory.knots), held);
      if (best.knots.size() == 0 || first.reading > best.reading) best = std::move(first);
    }
    if (best.reading > -kInfinity) {
      held.first = best.reading;
      raise_share(experimenter, evaluator, best, held);
      improve(experimenter, best, held);
      report(evaluator, best, held);
    }
    if (interrupted()) {
      held.stopped = "interrupted";
      held.answer.stopped = held.stopped;
      held.conclude(Status::kBudgetExhausted, held.stopped);
      if (held.answer.task) held.answer.conclude(Status::kBudgetExhausted, held.stopped);
    }
    held.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return held;
  }

 private:
  bool interrupted() const { return options_.interrupted && options_.interrupted(); }

  void count(HeldTrajectory& held) const {
    ++held.simulations;
    if (options_.progress) options_.progress(held.simulations);
  }

  First try_shares(const Experimenter& experimenter, TrajectoryEvaluator& evaluator,
                   const Eigen::VectorXd& knots, HeldTrajectory& held) const {
    First first{knots};
    for (const double share : kFirstShares) {
      if (held.simulations == how_.simulations || interrupted()) break;
      first.run = experimenter.run(evaluator, unstacked(knots, evaluator.knots()), share);
      count(held);
      first.share = share;
      first.reading = held_reading(first.run);
      if (first.reading > -kInfinity) break;
    }
    return first;
  }

  /// Raises the planned wrench of the same knots while the reading grows.
  void raise_share(const Experimenter& experimenter, TrajectoryEvaluator& evaluator, First& best,
                   HeldTrajectory& held) const {
    const Eigen::MatrixXd knots = unstacked(best.knots, evaluator.knots());
    for (double rise = kFirstRise; rise >= kLastRise;) {
      const double share = best.share + rise;
      if (share > kMostShare) {
        rise /= 2;
        continue;
      }
      if (held.simulations == how_.simulations || interrupted()) return;
      TankRun run = experimenter.run(evaluator, knots, share);
      count(held);
      const double reading = held_reading(run);
      if (reading > best.reading) {
        best.share = share;
        best.reading = reading;
        best.run = std::move(run);
      } else {
        rise /= 2;
      }
    }
  }

  /// The upper level; replaces `best` if it finds a larger reading.
  void improve(const Experimenter& experimenter, First& best, HeldTrajectory& held) const {
    SearchOptions search;
    search.budget = how_.simulations - held.simulations;
    held.stopped = kBudgetSpent;
    if (search.budget < 1) return;
    const auto found = std::make_shared<BestRun>();
    HeldObjective objective(experimenter, best.knots, found);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(objective.dimension());
    x.tail<1>().setConstant(best.share);
    search.seed = options_.seed;
    search.threads = thread_count(options_.threads);
    search.start = x;
    search.starts = {{x, best.reading}};
    if (options_.progress) {
      search.progress = [this, before = held.simulations](long evaluations) {
        options_.progress(before + evaluations);
      };
    }
    search.interrupted = options_.interrupted;
    const SearchResult result = find_search(kUpperSearch).make()->maximize(objective, search);
    held.simulations += result.evaluations;
    held.stopped = result.stopped.empty() ? kBudgetSpent : result.stopped;
    if (!(found->reading() > best.reading)) return;
    const Eigen::VectorXd& best_x = found->x();
    best = {stacked(objective.knots(best_x)), best_x.tail<1>()[0], found->reading(), found->run()};
  }

  /// Evaluates the trajectory, also after an interruption.
  void report(const TrajectoryEvaluator& evaluator, First& best, HeldTrajectory& held) const {
    const Eigen::MatrixXd knots = unstacked(best.knots, evaluator.knots());
    Options how = options_;
    how.search.clear();
    how.interrupted = {};
    held.answer = evaluate(task_, knots, how);
    held.run = std::move(best.run);
    held.share = best.share;
    held.reading = best.reading;
    held.conclude(Status::kBestFound);
    held.answer.conclude(Status::kBestFound);
    held.answer.evaluations = held.simulations;
    held.answer.stopped = held.stopped;
  }

  const Problem plain_;
  Problem task_;
  const Options options_;
  HeldOptions how_;
};

}  // namespace

HeldTrajectory solve_held(const Problem& task, const Options& options, const HeldOptions& how) {
  require_supported(task, options, how);
  return HeldSearch(task, options, how).run();
}

}  // namespace maxwrench
