#include "verify/trajectory/verify_trajectory.h"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <thread>

#include "maxwrench/interruption.h"
#include "verify/trajectory/motion_clearance.h"
#include "verify/trajectory/provable.h"

namespace maxwrench {
namespace {

/// Larger numbers are rejected, so that no product of them overflows.
constexpr double kLargestKnot = 1e6, kLargestEffort = 1e30;
constexpr int kMostEdges = 10'000'000;
constexpr int kMostPlacesInInterval = 64;  // of dependent joints
/// [s] Durations are within these.
constexpr double kShortest = 1e-6, kLongest = 1e9;

bool within(const Eigen::MatrixXd& M, double most) {
  return M.size() == 0 || (M.array().abs() <= most).all();  // false for NaN
}

std::string in_six_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6f", x);
  return text;
}

/// Empty, or why the certificate does not belong to the task or is not well formed.
std::string reject_sizes(const Problem& problem, const TrajectoryCertificate& proof) {
  const MotionTask& task = *problem.motion;
  if (proof.digest != motion_digest(problem)) return "it is for another robot or task";
  if (proof.collision != (problem.robot.collision != nullptr)) {
    return "it treats collisions differently";
  }
  if (!(task.T >= kShortest && task.T <= kLongest)) return "the task takes too long or too short";
  if (proof.knots.rows() != task.k || proof.knots.cols() != problem.redundancy()) {
    return "its knots have another size";
  }
  const Eigen::Index intervals = task.k - (task.impulse ? 0 : 1);
  const Eigen::Index places = proof.dependent.cols(), parts = (places - 1) / intervals;
  const bool fits = problem.dependent.empty() ? places == 0
                                              : parts >= 1 && parts <= kMostPlacesInInterval &&
                                                    places == parts * intervals + 1;
  if (proof.dependent.rows() != static_cast<Eigen::Index>(problem.dependent.size()) || !fits) {
    return "its dependent joints have another size";
  }
  if (proof.parts < 1 || proof.parts > kMostEdges / intervals) return "it has no edges or too many";
  const Eigen::Index edges = intervals * proof.parts + 1;
  const bool has_w = proof.w.size() == edges, may_lack_w = !task.impulse && proof.w.size() == 0;
  if (proof.y.rows() != problem.robot.actuators() || proof.y.cols() != edges ||
      !(has_w || may_lack_w)) {
    return "its efforts have another size";
  }
  if (!within(proof.knots, kLargestKnot) || !within(proof.dependent, kLargestKnot) ||
      !within(proof.y, kLargestEffort) || !within(proof.w, kLargestEffort) ||
      !(std::abs(proof.value) <= kLargestEffort)) {
    return "a number is not finite or is too large";
  }
  return "";
}

/// Empty, or why the wrenches of a path are not what the certificate claims. The B-spline is within
/// the range of its control points.
std::string reject_path(const TrajectoryCertificate& proof) {
  if (proof.t_h != 0) return "it has a peak";
  if (proof.w.size() > 0 && !(proof.w.minCoeff() >= proof.value)) {
    return "a wrench is below its value";
  }
  return "";
}

/// Empty, or why the wrenches of an impulse are not those that the task asks for. In balance at
/// rest, w_0 cannot exceed the static capability.
std::string reject_impulse(const Problem& problem, const TrajectoryCertificate& proof) {
  const MotionTask& task = *problem.motion;
  if (proof.t_h < 1 || proof.t_h > task.k || (task.t_h > 0 && proof.t_h != task.t_h)) {
    return "its peak is at another knot";
  }
  if (!(proof.w[Eigen::Index{proof.t_h} * proof.parts] >= proof.value)) {
    return "the wrench at its peak is below its value";
  }
  if (task.start == Start::kStatic && !(proof.w[0] >= 0)) return "it starts with a wrench below 0";
  if (task.start == Start::kRest && proof.w[0] != 0) return "it starts with a wrench";
  return "";
}

/// Empty, or why the certificate does not claim what the task asks for.
std::string reject_claim(const Problem& problem, const TrajectoryCertificate& proof) {
  std::string reason = reject_sizes(problem, proof);
  if (!reason.empty()) return reason;
  return problem.motion->impulse ? reject_impulse(problem, proof) : reject_path(proof);
}

/// All edges of all intervals, on several threads. The earliest fault counts.
MotionFault check_edges(const TrajectoryModel& model, const TrajectoryCertificate& proof,
                        int threads, TrajectoryVerification& result) {
  const EffortLaw law(model, proof);
  const int intervals = model.curve().intervals();
  const int edges = proof.parts + 1;
  const long all = long{intervals} * edges;
  std::atomic<long> next = 0, first_bad = all;
  std::mutex mutex;
  MotionFault fault;
  const auto work = [&, flag = Interruption::flag()] {
    const Interruption interruption(flag);
    long own = 0;
    for (long i = next++; i < all && i < first_bad && !is_interrupted(); i = next++) {
      MotionFault found = law.check(static_cast<int>(i / edges), static_cast<int>(i % edges), own);
      if (found.reason.empty()) continue;
      const std::lock_guard<std::mutex> guard(mutex);
      if (i >= first_bad) continue;
      first_bad = i;
      fault = std::move(found);
    }
    const std::lock_guard<std::mutex> guard(mutex);
    result.slices += own;
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& each : others) each.join();
  end_if_interrupted();
  return fault;
}

/// Why a dependent joint leaves its limits, or may do so, at some place of a stretch of an
/// interval.
std::string leaving(const TrajectoryModel& model, int interval, const Narrow& x) {
  const Problem& problem = model.problem();
  const std::optional<std::vector<Jet<3>>> jets = model.dependent(interval, x);
  if (!jets) return kNotEnclosed;
  for (std::size_t k = 0; k < jets->size(); ++k) {
    const Joint& joint = problem.robot.joints[static_cast<std::size_t>(problem.dependent[k])];
    const auto beyond = [&](const Narrow& at, double lower, double upper, const char* what,
                            const char* unit) -> std::string {
      if (at.low >= lower - kKnotTolerance && at.high <= upper + kKnotTolerance) return "";
      const bool above = !(at.high <= upper + kKnotTolerance);
      return joint.name + what + in_six_digits(above ? at.high : at.low) + ", beyond its limit " +
             in_six_digits(above ? upper : lower) +
             (joint.type == JointType::kRevolute ? " rad" : " m") + unit;
    };
    std::string reason = beyond((*jets)[k].c[0], joint.q_min, joint.q_max, " is at ", "");
    if (reason.empty()) {
      reason = beyond((*jets)[k].c[1], -joint.velocity_max, joint.velocity_max, " moves at ", "/s");
    }
    if (!reason.empty()) return reason;
  }
  return "";
}

/// The limits of dependent joints. Stretches that may leave them are cut in halves until a middle
/// certainly leaves them, or for the last time.
MotionFault check_dependent(const TrajectoryModel& model) {
  struct Stretch {
    double from, to;
    int halvings;
  };
  constexpr int kMostStretchCuts = 12;
  for (int interval = 0; interval < model.curve().intervals(); ++interval) {
    std::vector<Stretch> open = {{0, 1, 0}};
    while (!open.empty()) {
      end_if_interrupted();
      const Stretch stretch = open.back();
      open.pop_back();
      if (leaving(model, interval, {stretch.from, stretch.to}).empty()) continue;
      const double middle = (stretch.from + stretch.to) / 2;
      std::string reason = leaving(model, interval, Narrow(middle));
      if (reason.empty() && stretch.halvings == kMostStretchCuts) {
        reason = leaving(model, interval, {stretch.from, stretch.to});
      }
      if (!reason.empty()) return {std::move(reason), model.time(interval, middle)};
      open.push_back({middle, stretch.to, stretch.halvings + 1});
      open.push_back({stretch.from, middle, stretch.halvings + 1});
    }
  }
  return {};
}

}  // namespace

MotionFault check_motion(const TrajectoryModel& model) {
  if (!model.lost().reason.empty()) return model.lost();
  const Problem& problem = model.problem();
  const KnotCurve& curve = model.curve();
  for (int k = 0; k < problem.redundancy(); ++k) {
    const double speed =
        problem.robot
            .joints[static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(k)])]
            .velocity_max;
    for (const bool rate : {false, true}) {
      const double lower = rate ? -speed : problem.theta_r_min[k];
      const double upper = rate ? speed : problem.theta_r_max[k];
      const KnotCurve::Outside where = curve.leaves(k, rate, lower, upper, kKnotTolerance);
      if (!where.found) continue;
      const bool above = where.value > upper;
      return {problem.theta_r_name(k) + (rate ? " moves at " : " is at ") +
                  in_six_digits(where.value) + ", beyond its limit " +
                  in_six_digits(above ? upper : lower) + " " + problem.theta_r_unit(k) +
                  (rate ? "/s" : ""),
              model.time(where.interval, where.x)};
    }
    if (!problem.motion->impulse) continue;
    const Narrow bend = 2.0 * curve.at<3>(k, 0, Narrow(0.0)).c[2] / (curve.rate() * curve.rate());
    if (!(bend.magnitude() <= 2 * kKnotTolerance)) {
      return {problem.theta_r_name(k) + " starts with an acceleration; at rest there is none", 0};
    }
  }
  if (!problem.dependent.empty()) return check_dependent(model);
  return {};
}

MotionFault check_motion_and_clearance(const TrajectoryModel& model,
                                       TrajectoryVerification& result) {
  MotionFault fault = check_motion(model);
  if (fault.reason.empty()) fault = check_clearance(model, result);
  return fault;
}

MotionFault check_efforts(const TrajectoryModel& model, const TrajectoryCertificate& proof,
                          int threads, TrajectoryVerification& result) {
  std::string reason = reject_claim(model.problem(), proof);
  if (!reason.empty()) return {std::move(reason)};
  return check_edges(model, proof, threads, result);
}

TrajectoryVerification verify(const Problem& problem, const TrajectoryCertificate& proof,
                              int threads) {
  require_provable(problem);
  TrajectoryVerification result;
  result.rejection = reject_claim(problem, proof);
  if (!result.rejection.empty()) return result;
  const TrajectoryModel model(problem, proof.knots, proof.dependent);
  MotionFault fault = check_motion_and_clearance(model, result);
  if (fault.reason.empty()) fault = check_edges(model, proof, threads, result);
  result.rejection = fault.reason;
  result.t = fault.t;
  return result;
}

}  // namespace maxwrench
