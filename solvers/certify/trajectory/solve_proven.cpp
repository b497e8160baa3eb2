#include <algorithm>
#include <cmath>

#include "maxwrench/trajectory_proof.h"
#include "verify/trajectory/verify_trajectory.h"

namespace maxwrench {
namespace {

/// Searches with tighter limits, until a trajectory keeps the task's own.
constexpr int kMostSearches = 5;
/// Extremes between knots are found on this many parts.
constexpr int kPartsOfCurve = 256;
/// Limits become tighter by this share more than needed.
constexpr double kTighterBy = 1e-4;

/// Makes the limits of a task tighter by what a trajectory exceeds the limits of `task`. Returns
/// whether it exceeds any.
bool tighten_limits(const Problem& task, const Eigen::MatrixXd& knots, Problem& tight) {
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
  require_provable(task);
  Problem tight = task;
  Options proof_options = options;
  proof_options.solver = "";
  proof_options.search = "";
  for (int search = 1;; ++search) {
    const Answer found = solve(tight, options);
    if (!found.has_posture() || !found.has_value()) {
      TrajectoryProof none;
      static_cast<Verdict&>(none) = found;
      none.answer = found;
      return none;
    }
    TrajectoryProof proof = certify_trajectory(task, found.trajectory.knots, proof_options, how);
    take_search(found, proof.answer);
    const bool again = proof.status == Status::kInvalidPosture && search < kMostSearches &&
                       !(options.interrupted && options.interrupted());
    if (!again || !tighten_limits(task, found.trajectory.knots, tight)) return proof;
  }
}

}  // namespace maxwrench
