#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "maxwrench/batch.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "maxwrench/trajectory_proof.h"
#include "solvers/certify/trajectory/edge_program.h"
#include "solvers/search/slp_run.h"
#include "verify/trajectory/motion_clearance.h"
#include "verify/trajectory/provable.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

using SearchClock = std::chrono::steady_clock;

/// Proofs that are tried, each after the first with tighter limits.
constexpr int kMostProofs = 12;
/// Evaluations of a local search with tighter limits.
constexpr long kLocalEvaluations = 300;
/// How often the share is bisected that tighter limits leave of a motion.
constexpr int kHalvingsOfShare = 12;
constexpr int kMostInstantsOfSearch = 16;  // in an interval between knots
constexpr double kFirstSlower = 8e-3;      // share of the effort rates
constexpr double kFirstWeaker = 2.5e-4;    // share of the efforts
/// More instants are worth a round where a proof loses this share of the value.
constexpr double kLossOfInstants = 5e-4;
/// The whole search is repeated once within the tighter limits where what is proven is below what
/// the first one found by this share. A local search can end at a worse optimum.
constexpr double kLossOfSearch = 1e-3;
/// Extremes between knots are found on this many parts.
constexpr int kPartsOfCurve = 256;
/// Limits become tighter by this share more than needed.
constexpr double kTighterBy = 1e-4;
/// The margin of collisions becomes wider by this times the depth of the deepest one. Knots may be
/// farther apart than what is between them, so it is doubled while they do not move.
constexpr double kMoreThanDepth = 1.2;

/// A collision check with a larger margin, of the pairs whose distance is known.
class WiderMargin : public CollisionChecker {
 public:
  WiderMargin(std::shared_ptr<const CollisionChecker> inner, double wider)
      : inner_(std::move(inner)), wider_(wider) {}

  int colliding_pair(const std::vector<Pose<double>>& links) const override {
    const int colliding = inner_->colliding_pair(links);
    ClosestPoints near;
    for (int pair = 0; colliding < 0 && pair < pairs(); ++pair) {
      if (nearest(links, pair, near) && near.clearance < 0) return pair;
    }
    return colliding;
  }
  int pairs() const override { return inner_->pairs(); }
  bool nearest(const std::vector<Pose<double>>& links, int pair,
               ClosestPoints& result) const override {
    if (!inner_->nearest(links, pair, result)) return false;
    result.clearance -= wider_;
    return true;
  }
  std::string pair_name(int pair) const override { return inner_->pair_name(pair); }

 private:
  std::shared_ptr<const CollisionChecker> inner_;
  double wider_;
};

/// [m] By how much bodies come closer to each other than their margin along a trajectory, at so
/// many instants of each interval.
double deepest_collision(const TrajectoryModel& model, int parts) {
  const CollisionChecker* const checker = model.problem().robot.collision.get();
  double least = 0;
  ClosestPoints near;
  for (int i = 0; checker && i <= model.curve().intervals() * parts; ++i) {
    const int interval = std::min(i / parts, model.curve().intervals() - 1);
    const auto links = model.links(interval, i / static_cast<double>(parts) - interval);
    for (int pair = 0; pair < checker->pairs(); ++pair) {
      if (checker->nearest(links, pair, near)) least = std::min(least, near.clearance);
    }
  }
  return -least;
}

/// Makes the limits of a task tighter by what a trajectory exceeds the limits of `task`. Returns
/// whether it exceeds any.
bool tighten_limits(const Problem& task, const Eigen::MatrixXd& knots, double& wider,
                    Problem& tight) {
  const TrajectoryModel model(task, knots, dependent_places(task, knots));
  if (!model.lost().reason.empty()) return false;
  bool exceeds = false, possible = true;
  // Limits of the task, and those that become tighter.
  const auto tighten = [&](int index, const auto& jet_of, double q_min, double q_max, double& lower,
                           double& upper) {
    const auto joint = static_cast<std::size_t>(index);
    const double speed = task.robot.joints[joint].velocity_max;
    double fastest = 0, lowest = kInfinity, highest = -kInfinity;
    for (int i = 0; i < model.curve().intervals() * kPartsOfCurve; ++i) {
      const double x = i % kPartsOfCurve / double{kPartsOfCurve};
      const std::optional<Jet<3>> q = jet_of(i / kPartsOfCurve, Narrow(x, x + 1.0 / kPartsOfCurve));
      if (!q) continue;
      fastest = std::max(fastest, q->c[1].magnitude());
      lowest = std::min(lowest, q->c[0].low);
      highest = std::max(highest, q->c[0].high);
    }
    if (fastest > speed + kKnotTolerance) {
      tight.robot.joints[joint].velocity_max *= speed / fastest * (1 - kTighterBy);
      exceeds = true;
    }
    const double below = q_min - lowest, above = highest - q_max;
    if (below > kKnotTolerance) lower += below * (1 + kTighterBy);
    if (above > kKnotTolerance) upper -= above * (1 + kTighterBy);
    exceeds = exceeds || below > kKnotTolerance || above > kKnotTolerance;
  };
  for (int k = 0; k < task.redundancy(); ++k) {
    const auto jet_of = [&](int interval, const Narrow& x) {
      return std::optional(model.curve().at<3>(k, interval, x));
    };
    tighten(task.redundant[static_cast<std::size_t>(k)], jet_of, task.theta_r_min[k],
            task.theta_r_max[k], tight.theta_r_min[k], tight.theta_r_max[k]);
  }
  for (std::size_t k = 0; k < task.dependent.size(); ++k) {
    const auto jet_of = [&](int interval, const Narrow& x) -> std::optional<Jet<3>> {
      const auto dependent = model.dependent(interval, x);
      if (!dependent) return std::nullopt;
      return (*dependent)[k];
    };
    const auto index = static_cast<std::size_t>(task.dependent[k]);
    const Joint& joint = task.robot.joints[index];
    Joint& tighter = tight.robot.joints[index];
    tighten(task.dependent[k], jet_of, joint.q_min, joint.q_max, tighter.q_min, tighter.q_max);
    possible = possible && tighter.q_min <= tighter.q_max;
  }
  const double depth = deepest_collision(model, kPartsOfCurve);
  if (depth > kTouching) {
    exceeds = true;
    tight.motion->clear_at_instants = true;
    // The search keeps bodies apart at its instants; between them only a wider margin does.
    if (deepest_collision(model, tight.motion->instants_per_interval) <= kTouching) {
      wider = std::max(2 * wider, depth * kMoreThanDepth);
      tight.robot.collision = std::make_shared<WiderMargin>(task.robot.collision, wider);
    }
  }
  return exceeds && possible && (tight.theta_r_min.array() <= tight.theta_r_max.array()).all();
}

/// A set with limits of efforts that are nearer to their mean by a share.
Zonotope shrunk(const Zonotope& set, double share) {
  const Eigen::VectorXd range = set.u_max - set.u_min;
  const Eigen::VectorXd less = share / 2 * range.array().isFinite().select(range, 0).matrix();
  return with_limits(set, set.u_min + less, set.u_max - less);
}

/// Efforts that change as fast as they must between the instants of a search do not at all times:
/// adds instants, and makes the rates slower by a share. Without rates it makes the efforts smaller
/// by a share: where a motion needs all of one, no wrench leaves the margin of a proof. Returns the
/// share.
double tighten_efforts(const Problem& task, double before, Problem& tight) {
  int& instants = tight.motion->instants_per_interval;
  instants = std::min(2 * instants, kMostInstantsOfSearch);
  const bool rates = task.motion->rates && (task.robot.u_rate_max.array() < kInfinity).any();
  const double share = std::max(2 * before, rates ? kFirstSlower : kFirstWeaker);
  if (rates) {
    tight.robot.u_rate_max = (1 - share) * task.robot.u_rate_max;
    return share;
  }
  tight.robot.actuation = shrunk(task.robot.actuation, share);
  for (std::size_t i = 0; i < task.scenarios.limits.size(); ++i) {
    tight.scenarios.limits[i].actuation = shrunk(task.scenarios.limits[i].actuation, share);
  }
  return share;
}

/// The answer of the trajectory nearest to `knots`, on the way to them from a posture that is held,
/// that has a value within the limits of `tight`. Bodies that collide on the way are moved apart.
/// Without a value if this posture has none.
Answer nearest_with_value(const Problem& tight, const TrajectoryObjective& objective,
                          const Eigen::MatrixXd& knots, const Options& options) {
  const MotionTask& motion = *tight.motion;
  Eigen::RowVectorXd held = knots.row(0);
  if (!motion.impulse) held = knots.colwise().mean();
  if (motion.impulse && motion.theta_0.size() > 0) held = motion.theta_0.transpose();
  const Eigen::MatrixXd still = held.replicate(knots.rows(), 1);
  Answer nearest;
  const auto copy = objective.copy(objective.counts());
  const auto has_value = [&](const Eigen::MatrixXd& moving) {
    const Eigen::VectorXd apart = moved_apart(copy->trajectories(), *copy, stacked(moving));
    Answer answer = evaluate(tight, unstacked(apart, knots.rows()), options);
    const bool has = answer.has_value() && answer.trajectory.collision.empty();
    if (has) nearest = std::move(answer);
    return has;
  };
  if (has_value(knots) || !has_value(still)) return nearest;
  double low = 0, high = 1;  // shares of the way
  for (int i = 0; i < kHalvingsOfShare; ++i) {
    const double middle = (low + high) / 2;
    (has_value(still + middle * (knots - still)) ? low : high) = middle;
  }
  return nearest;
}

/// Where sequential linear programming leads from there, as an answer of `tight`. Without a value
/// if it has no start.
Answer continue_search(const Problem& tight, const Eigen::MatrixXd& knots, const Options& options) {
  const auto before = SearchClock::now();
  const auto objective = make_trajectory_objective(
      tight, options.wrench, trajectory_solvers().front().make, options.check_collision);
  Answer start = nearest_with_value(tight, *objective, knots, options);
  if (!start.has_value()) return start;
  SearchOptions search;
  search.interrupted = options.interrupted;
  SearchRun run(search);
  SlpRun slp(*objective, {stacked(start.trajectory.knots), start.beta()}, run);
  slp.optimise(kLocalEvaluations);
  // The best elastic value may be one that efforts reach almost.
  Answer answer =
      nearest_with_value(tight, *objective, unstacked(slp.best().theta_r, knots.rows()), options);
  if (!answer.has_value() || start.beta() > answer.beta()) answer = std::move(start);
  answer.evaluations = slp.found().trace.evaluations();
  answer.wall_s = std::chrono::duration<double>(SearchClock::now() - before).count();
  answer.calls = {{"slp", "continued", 1, answer.evaluations}};
  return answer;
}

/// What the search did, for the answer of its trajectory.
void take_search(const Answer& found, Answer& answer) {
  if (answer.status == Status::kOptimal) static_cast<Verdict&>(answer) = found;
  answer.choice = found.choice;
  answer.evaluations += found.evaluations;
  answer.calls = found.calls;
  answer.stopped = found.stopped;
  answer.wall_s += found.wall_s;
}

/// What a proof says of the trajectory that the first search found, for the proof of another one.
struct FirstTrajectory {
  explicit FirstTrajectory(const TrajectoryProof& proof)
      : value(proof.answer.trajectory.value_between_knots) {
    rejection =
        proof.status == Status::kProven
            ? fmt::format("only {:.5f} {} is proven of it", proof.guaranteed, proof.answer.unit)
            : fmt::format("{}: {}", to_string(proof.status), proof.reason.c_str());
  }
  void tell(TrajectoryProof& proof) const {
    proof.searched = value;
    proof.rejection = rejection;
  }

  double value;  ///< between knots
  std::string rejection;
};

}  // namespace

TrajectoryProof solve_proven(const Problem& task, const Options& options,
                             const TrajectoryProofOptions& how) {
  require_provable_task(task);
  Problem tight = task;
  double wider = 0;
  Options proof_options = options;
  proof_options.solver = "";
  proof_options.search = "";
  TrajectoryProof proof;
  Answer found = solve(task, options);
  if (!found.has_value()) {
    static_cast<Verdict&>(proof) = found;
    proof.answer = std::move(found);
    return proof;
  }
  Eigen::MatrixXd knots = found.trajectory.knots;
  double share_of_efforts = 0;
  bool repeated = false;
  std::optional<FirstTrajectory> first;
  // Whether limits are tighter or instants more than before.
  const auto tighten = [&](Status status) {
    int& instants = tight.motion->instants_per_interval;
    if (status == Status::kInvalidPosture) return tighten_limits(task, knots, wider, tight);
    if (status == Status::kProven && instants >= kMostInstantsOfSearch) return false;
    if (status == Status::kProven) {
      instants *= 2;
    } else {
      share_of_efforts = tighten_efforts(task, share_of_efforts, tight);
    }
    return true;
  };
  for (int round = 1;; ++round) {
    TrajectoryProof next = certify_trajectory(task, knots, proof_options, how);
    const Status status = next.status;
    if (round == 1) first.emplace(next);
    const bool enough =
        status == Status::kProven && next.guaranteed >= next.answer.beta() * (1 - kLossOfInstants);
    if (proof.status != Status::kProven ||
        (status == Status::kProven && next.guaranteed > proof.guaranteed)) {
      proof = std::move(next);
      if (round > 1) first->tell(proof);
    }
    if (round == kMostProofs) break;
    if (options.interrupted && options.interrupted()) break;
    const bool tightened = !enough && tighten(status);
    const bool repeats = !tightened && !repeated && proof.status == Status::kProven &&
                         proof.guaranteed < first->value * (1 - kLossOfSearch);
    if (!tightened && !repeats) break;
    repeated = repeated || repeats;
    Answer continued;
    if (!repeats) continued = continue_search(tight, knots, proof_options);
    if (!continued.has_value()) continued = solve(tight, options);
    if (!continued.has_value()) break;
    found.evaluations += continued.evaluations;
    found.wall_s += continued.wall_s;
    found.calls.insert(found.calls.end(), continued.calls.begin(), continued.calls.end());
    knots = continued.trajectory.knots;
  }
  take_search(found, proof.answer);
  if (options.interrupted && options.interrupted()) return proof;
  // A posture that is held can be better than what keeps the tighter limits.
  const Eigen::MatrixXd held = task.theta_r_default.transpose().replicate(task.motion->k, 1);
  const Answer at_rest = evaluate(task, held, proof_options);
  const bool proven = proof.status == Status::kProven;
  if (!at_rest.has_value() || (proven && !(at_rest.beta() > proof.guaranteed))) return proof;
  TrajectoryProof still = certify_trajectory(task, held, proof_options, how);
  if (still.status != Status::kProven || (proven && !(still.guaranteed > proof.guaranteed))) {
    return proof;
  }
  take_search(found, still.answer);
  first->tell(still);
  still.held = true;
  still.answer.evaluations = proof.answer.evaluations;
  still.answer.wall_s = proof.answer.wall_s;
  return still;
}

}  // namespace maxwrench
