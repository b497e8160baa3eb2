#include "lib/tank/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maxwrench/plan.h"
#include "maxwrench/problem.h"

namespace maxwrench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The furthest from the reference that the summary or the sample was.
void reach(const TankSample& sample, TankSummary& summary) {
  summary.drift = std::max(summary.drift, sample.drift);
  summary.moved = std::max(summary.moved, sample.moved);
  summary.position_error = std::max(summary.position_error, sample.position_error);
  summary.displaced = std::max(summary.displaced, sample.displaced);
}

void forget(TankSummary& summary, bool lost) {
  summary.across.setConstant(kNone);
  for (double* value : {&summary.mean, &summary.low, &summary.high, &summary.saturated,
                        &summary.relaxed, &summary.shortfall}) {
    *value = kNone;
  }
  if (lost) return;
  summary.drift = summary.moved = summary.position_error = summary.displaced = kNone;
}

/// The part of the wrench across c that the task does not leave to the environment.
Vector6d unasked(const Problem& problem, const TankPlan& plan, const TankOptions& options,
                 const Vector6d& across) {
  if (plan.wrench == Wrench::kPure || options.load > 0) return across;
  return across - problem.W_any * (problem.W_any.transpose() * across);  // orthonormal
}

void take_means(double count, TankSummary& summary) {
  summary.across /= count;
  for (double* mean : {&summary.mean, &summary.saturated, &summary.relaxed, &summary.shortfall}) {
    *mean /= count;
  }
}

/// One sample of a task in time.
void add_sample(const TankSample& sample, TankSummary& summary) {
  MotionSummary& motion = *summary.motion;
  summary.violation = std::max(summary.violation, sample.violation);
  motion.speed = std::max(motion.speed, sample.speed);
  motion.violations += sample.violation > kHeldViolation || sample.speed > kHeldViolation;
  if (sample.reading < summary.low) motion.t_low = sample.t;
  if (sample.reading > summary.high) motion.t_high = sample.t;
  summary.low = std::min(summary.low, sample.reading);
  summary.high = std::max(summary.high, sample.reading);
  summary.mean += sample.reading;
  motion.deviation = std::max(motion.deviation, std::abs(sample.reading - sample.planned));
  motion.stray_force = std::max(motion.stray_force, sample.stray_force);
  motion.stray_torque = std::max(motion.stray_torque, sample.stray_torque);
  reach(sample, summary);
  summary.shortfall += sample.shortfall;
  summary.saturated += sample.saturated;
  summary.relaxed += sample.relaxed;
}

bool reads_as_planned(const Problem& problem, const TankPlan& plan, const TankOptions& options,
                      const TankSummary& summary) {
  const double room = kHeldShare * std::abs(summary.planned);
  const double force = problem.c.head<3>().norm(), torque = problem.c.tail<3>().norm();
  const Vector6d across = unasked(problem, plan, options, summary.across);
  return std::abs(summary.mean - summary.planned) <= room &&
         across.head<3>().norm() <= room * (force + torque / kHeldLever) &&
         across.tail<3>().norm() <= room * (torque + force * kHeldLever);
}

}  // namespace

TankSummary summarise(const Problem& problem, const TankPlan& plan, const TankOptions& options,
                      const TankRun& run, bool lost) {
  TankSummary summary;
  summary.planned = problem.c.dot(plan.h);
  summary.across.setZero();
  int count = 0;
  for (const TankSample& sample : run.samples) {
    summary.violation = std::max(summary.violation, sample.violation);
    const double into = sample.t - options.ramp;
    if (into < -options.period / 2 || into > options.hold + options.period / 2) continue;
    const double reading = problem.c.dot(sample.h_e);
    summary.low = count == 0 ? reading : std::min(summary.low, reading);
    summary.high = count == 0 ? reading : std::max(summary.high, reading);
    ++count;
    summary.mean += reading;
    summary.across += sample.h_e - reading * problem.c;
    reach(sample, summary);
    summary.shortfall += sample.shortfall;
    summary.saturated += sample.saturated;
    summary.relaxed += sample.relaxed;
  }
  if (lost) reach(run.samples.back(), summary);
  if (count == 0) {
    forget(summary, lost);
    return summary;
  }
  take_means(count, summary);
  summary.held = run.status == Status::kReached && !lost && summary.violation <= kHeldViolation &&
                 summary.moved <= kHeldDrift && summary.displaced <= kHeldPosition &&
                 reads_as_planned(problem, plan, options, summary);
  return summary;
}

TankSummary summarise(const TankScript& script, const TankRun& run, bool lost) {
  TankSummary summary;
  summary.planned = script.planned;
  summary.across.setConstant(kNone);  // see the stray wrenches
  summary.motion.emplace();
  MotionSummary& motion = *summary.motion;
  motion.at_peak = kNone;
  if (run.samples.empty()) {
    forget(summary, lost);
    return summary;
  }
  summary.low = kInfinity;
  summary.high = -kInfinity;
  double nearest = kInfinity;
  for (const TankSample& sample : run.samples) {
    add_sample(sample, summary);
    if (!(std::abs(sample.t - script.t_h) < nearest)) continue;
    nearest = std::abs(sample.t - script.t_h);
    motion.at_peak = sample.reading;
  }
  take_means(static_cast<double>(run.samples.size()), summary);
  const double missed =
      std::isfinite(script.t_h) ? std::abs(motion.at_peak - script.planned) : motion.deviation;
  summary.held = run.status == Status::kReached && !lost && motion.violations == 0 &&
                 summary.moved <= kFollowedMoved && summary.displaced <= kHeldPosition &&
                 missed <= kFollowedShare * std::abs(script.planned);
  return summary;
}

}  // namespace maxwrench
