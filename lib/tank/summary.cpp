#include "lib/tank/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

#include "lib/math/raise_to.h"
#include "maxwrench/problem.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Raises the largest errors of the summary to those of the sample.
void reach(const TankSample& sample, TankSummary& summary) {
  raise_to(summary.theta_r_error, sample.theta_r_error);
  raise_to(summary.configuration_error, sample.configuration_error);
  raise_to(summary.position_error, sample.position_error);
  raise_to(summary.deflection_error, sample.deflection_error);
}

void forget(TankSummary& summary, bool lost) {
  summary.across.setConstant(kNone);
  for (double* value : {&summary.mean, &summary.low, &summary.high, &summary.saturated,
                        &summary.relaxed, &summary.shortfall}) {
    *value = kNone;
  }
  if (lost) return;
  summary.theta_r_error = summary.configuration_error = summary.position_error =
      summary.deflection_error = kNone;
}

/// The part of the wrench across c that the task does not leave to the environment.
Vector6d unasked(const Problem& problem, const TargetWrench& target, const TankOptions& options,
                 const Vector6d& across) {
  if (target.wrench == Wrench::kPure || options.load > 0) return across;
  return across - problem.W_any * (problem.W_any.transpose() * across);  // orthonormal
}

void take_means(double count, TankSummary& summary) {
  summary.across /= count;
  for (double* mean : {&summary.mean, &summary.saturated, &summary.relaxed, &summary.shortfall}) {
    *mean /= count;
  }
}

/// [s] When the transient ends that an actuator's failure causes.
double end_of_transient(const TankOptions& options, const ActuatorDeath& death) {
  return death.t + options.noticed_after + kTransient / options.bandwidth;
}

/// Whether a sample is in the transient of a failure. Those at the failure itself come before it.
bool in_transient(const TankOptions& options, double t) {
  const double half = options.period / 2;
  return std::any_of(options.deaths.begin(), options.deaths.end(), [&](const ActuatorDeath& death) {
    return t > death.t + half && t < end_of_transient(options, death) + half;
  });
}

/// What the cell reads from the last failure before `end` to `end`, not before `start`; nothing if
/// no sample is there.
std::optional<AfterDeaths> read_after(const TankOptions& options, double start, double end,
                                      const TankRun& run) {
  const double half = options.period / 2;
  AfterDeaths after;
  bool any = false;
  for (const ActuatorDeath& death : options.deaths) {
    if (death.t + half > end) continue;  // after the hold
    after.t = std::max(after.t, death.t);
    any = true;
  }
  if (!any) return {};
  int count = 0, settled = 0;
  for (const TankSample& sample : run.samples) {
    if (sample.t < std::max(after.t + half, start - half) || sample.t > end + half) continue;
    after.low = count == 0 ? sample.reading : std::min(after.low, sample.reading);
    after.high = count == 0 ? sample.reading : std::max(after.high, sample.reading);
    after.last = sample.reading;
    raise_to(after.configuration_error, sample.configuration_error);
    ++count;
    if (in_transient(options, sample.t)) continue;
    after.mean += sample.reading;
    ++settled;
  }
  if (count == 0) return {};
  after.mean = settled > 0 ? after.mean / settled : kNone;
  return after;
}

/// Adds one sample of a task in time.
void add_sample(const TankSample& sample, TankSummary& summary) {
  MotionSummary& motion = *summary.motion;
  raise_to(summary.violation, sample.violation);
  raise_to(motion.speed, sample.speed);
  motion.violations += !(sample.violation <= kHeldViolation && sample.speed <= kHeldViolation);
  if (sample.reading < summary.low) motion.t_low = sample.t;
  if (sample.reading > summary.high) motion.t_high = sample.t;
  summary.low = std::min(summary.low, sample.reading);
  summary.high = std::max(summary.high, sample.reading);
  summary.mean += sample.reading;
  raise_to(motion.deviation, std::abs(sample.reading - sample.planned));
  raise_to(motion.off_axis_force, sample.off_axis_force);
  raise_to(motion.off_axis_torque, sample.off_axis_torque);
  reach(sample, summary);
  summary.shortfall += sample.shortfall;
  summary.saturated += sample.saturated;
  summary.relaxed += sample.relaxed;
}

/// Adds a condition to `missed`.
void miss(const char* what, TankSummary& summary) {
  if (!summary.missed.empty()) summary.missed += "; ";
  summary.missed += what;
}

/// Adds a value to `missed` if it exceeds its limit or is NaN.
void allow(double most, const char* what, double value, TankSummary& summary) {
  if (value <= most) return;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "%s %.3g, at most %.3g", what, value, most);
  miss(text.data(), summary);
}

/// The largest error of a reading that is held.
double room_of(const TargetWrench& target, const TankSummary& summary) {
  return kHeldWrenchError * std::abs(target.reference != 0 ? target.reference : summary.planned);
}

void judge_reading(const Problem& problem, const TargetWrench& target, const TankOptions& options,
                   TankSummary& summary) {
  const double room = room_of(target, summary);
  const double force = problem.c.head<3>().norm(), torque = problem.c.tail<3>().norm();
  const Vector6d across = unasked(problem, target, options, summary.across);
  allow(room, "reading off by", std::abs(summary.mean - summary.planned), summary);
  allow(room * (force + torque / kHeldLever), "force across c", across.head<3>().norm(), summary);
  allow(room * (torque + force * kHeldLever), "torque across c", across.tail<3>().norm(), summary);
}

/// `moved`: the largest allowed deviation of the posture from its reference.
void judge_posture(double moved, TankSummary& summary) {
  allow(moved, "posture off by", summary.configuration_error, summary);
  allow(kHeldPosition, "end effector displaced by", summary.deflection_error, summary);
}

/// After the last failure, the reading counts on its own.
void judge_after(double room, TankSummary& summary) {
  if (!summary.after) return;
  if (std::isnan(summary.after->mean)) {
    miss("nothing is left after the transient of the last failure", summary);
  } else {
    allow(room, "reading after the last failure off by",
          std::abs(summary.after->mean - summary.planned), summary);
  }
}

/// Call last: the wrench was held if the run reached its end and nothing was missed.
void conclude(const TankRun& run, bool lost, TankSummary& summary) {
  summary.lost = lost;
  if (lost) summary.missed = "the posture was lost";
  if (run.status != Status::kReached && summary.missed.empty()) summary.missed = run.reason.str();
  summary.held = run.status == Status::kReached && summary.missed.empty();
}

}  // namespace

TankSummary summarise(const Problem& problem, const TargetWrench& target,
                      const TankOptions& options, const TankRun& run, bool lost) {
  TankSummary summary;
  summary.planned = problem.c.dot(target.h);
  summary.across.setZero();
  int count = 0;
  for (const TankSample& sample : run.samples) {
    raise_to(summary.violation, sample.violation);
    const double into = sample.t - options.ramp;
    if (into < -options.period / 2 || into > options.hold + options.period / 2) continue;
    if (in_transient(options, sample.t)) continue;
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
  summary.after = read_after(options, options.ramp, options.ramp + options.hold, run);
  if (count == 0) {
    forget(summary, lost);
    summary.missed = "no hold";
  } else {
    take_means(count, summary);
    allow(kHeldViolation, "efforts or rates beyond their limits by", summary.violation, summary);
    judge_posture(kHeldThetaRError, summary);
    judge_reading(problem, target, options, summary);
    judge_after(room_of(target, summary), summary);
  }
  conclude(run, lost, summary);
  return summary;
}

TankSummary summarise(const TankScript& script, const TankOptions& options, const TankRun& run,
                      bool lost) {
  TankSummary summary;
  summary.planned = script.planned;
  summary.across.setConstant(kNone);  // see the off-axis wrenches
  summary.motion.emplace();
  MotionSummary& motion = *summary.motion;
  motion.at_peak = kNone;
  if (run.samples.empty()) {
    forget(summary, lost);
    summary.missed = "no sample";
    return summary;
  }
  summary.low = kInfinity;
  summary.high = -kInfinity;
  // If nothing is left beside the transients, the numbers are theirs, and it is not held.
  const bool settles =
      std::any_of(run.samples.begin(), run.samples.end(),
                  [&](const TankSample& sample) { return !in_transient(options, sample.t); });
  double nearest = kInfinity;
  bool peak_counts = true;
  int count = 0;
  for (const TankSample& sample : run.samples) {
    const bool transient = in_transient(options, sample.t);
    if (std::abs(sample.t - script.t_h) < nearest) {
      nearest = std::abs(sample.t - script.t_h);
      motion.at_peak = sample.reading;
      peak_counts = !transient;
    }
    if (transient && settles) continue;
    ++count;
    add_sample(sample, summary);
  }
  take_means(count, summary);
  summary.after = read_after(options, 0, run.samples.back().t, run);
  allow(0, "samples beyond a limit of effort, rate or joint speed:", motion.violations, summary);
  judge_posture(kTrackedConfigurationError, summary);
  const double room = kTrackedWrenchError * std::abs(script.planned);
  if (!peak_counts) {
    miss("the peak is in the transient of a failure", summary);
  } else if (std::isfinite(script.t_h)) {
    allow(room, "reading off by", std::abs(motion.at_peak - script.planned), summary);
  } else {
    allow(room, "reading off by", motion.deviation, summary);
    judge_after(room, summary);
  }
  conclude(run, lost, summary);
  return summary;
}

}  // namespace maxwrench
