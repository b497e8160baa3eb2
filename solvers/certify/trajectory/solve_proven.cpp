#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "maxwrench/trajectory_proof.h"
#include "verify/trajectory/motion_clearance.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

/// Searches with tighter limits, until a trajectory keeps the task's own.
constexpr int kMostSearches = 5;
/// Extremes between knots are found on this many parts.
constexpr int kPartsOfCurve = 256;
/// Limits become tighter by this share more than needed.
constexpr double kTighterBy = 1e-4;
/// The margin of collisions becomes wider by this times the depth of the deepest one.
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

/// [m] By how much bodies come closer to each other than their margin along a trajectory.
double deepest_collision(const TrajectoryModel& model) {
  const CollisionChecker* const checker = model.problem().robot.collision.get();
  double least = 0;
  ClosestPoints near;
  for (int i = 0; checker && i <= model.curve().intervals() * kPartsOfCurve; ++i) {
    const int interval = std::min(i / kPartsOfCurve, model.curve().intervals() - 1);
    const auto links = model.links(interval, i / double{kPartsOfCurve} - interval);
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
  const TrajectoryModel model(task, knots);
  const KnotCurve& curve = model.curve();
  bool exceeds = false;
  for (int k = 0; k < task.redundancy(); ++k) {
    const auto joint = static_cast<std::size_t>(task.redundant[static_cast<std::size_t>(k)]);
    double fastest = 0, lowest = kInfinity, highest = -kInfinity;
    for (int i = 0; i < curve.intervals() * kPartsOfCurve; ++i) {
      const double x = i % kPartsOfCurve / double{kPartsOfCurve};
      const Narrow part(x, x + 1.0 / kPartsOfCurve);
      const Jet<3> q = curve.at<3>(k, i / kPartsOfCurve, part);
      fastest = std::max(fastest, q.c[1].magnitude());
      lowest = std::min(lowest, q.c[0].low);
      highest = std::max(highest, q.c[0].high);
    }
    const double speed = task.robot.joints[joint].velocity_max;
    if (fastest > speed + kKnotTolerance) {
      tight.robot.joints[joint].velocity_max *= speed / fastest * (1 - kTighterBy);
      exceeds = true;
    }
    const double below = task.theta_r_min[k] - lowest, above = highest - task.theta_r_max[k];
    if (below > kKnotTolerance) tight.theta_r_min[k] += below * (1 + kTighterBy);
    if (above > kKnotTolerance) tight.theta_r_max[k] -= above * (1 + kTighterBy);
    exceeds = exceeds || below > kKnotTolerance || above > kKnotTolerance;
  }
  const double depth = deepest_collision(model);
  if (depth > kTouching) {
    exceeds = true;
    wider += depth * kMoreThanDepth;
    tight.robot.collision = std::make_shared<WiderMargin>(task.robot.collision, wider);
  }
  return exceeds && (tight.theta_r_min.array() <= tight.theta_r_max.array()).all();
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
  Answer found;
  long evaluations = 0;  // of the searches before this one
  double wall_s = 0;     // likewise
  for (int search = 1; search <= kMostSearches; ++search) {
    Answer next = solve(tight, options);
    if (!next.has_value()) {
      if (search > 1) break;  // nothing keeps the tighter limits
      static_cast<Verdict&>(proof) = next;
      proof.answer = std::move(next);
      return proof;
    }
    found = std::move(next);
    proof = certify_trajectory(task, found.trajectory.knots, proof_options, how);
    take_search(found, proof.answer);
    proof.answer.evaluations += evaluations;
    proof.answer.wall_s += wall_s;
    evaluations += found.evaluations;
    wall_s += found.wall_s;
    if (proof.status != Status::kInvalidPosture || (options.interrupted && options.interrupted()) ||
        !tighten_limits(task, found.trajectory.knots, wider, tight)) {
      break;
    }
  }
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
  still.answer.evaluations = proof.answer.evaluations;
  still.answer.wall_s = proof.answer.wall_s;
  return still;
}

}  // namespace maxwrench
