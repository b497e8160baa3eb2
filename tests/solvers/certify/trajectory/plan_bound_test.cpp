#include "maxwrench/plan_bound.h"

#include <gtest/gtest.h>

#include <atomic>

#include "maxwrench/load.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

/// Of the schemes `forward` and `ends`, the last instant is at rest, so no trajectory exceeds the
/// best static value, 35.40830 N m by an independent model. The best known trajectory attains it.
TEST(PlanBound, SLOW_IsTheStaticOptimumWhereTheSchemeRests) {
  for (const Scheme scheme : {Scheme::kForward, Scheme::kEnds}) {
    Problem task = load_problem("uvms/valve_trajectory");
    task.motion->scheme = scheme;
    const PlanBound bound = bound_trajectories(task, {}, {.gap = 5e-3, .seconds = 600});
    EXPECT_EQ(bound.status, Status::kProven) << bound.reason.c_str();
    EXPECT_GE(bound.bound, 35.408299);
    EXPECT_LE(bound.bound, 35.4084 * 1.006);
    EXPECT_EQ(bound.t, scheme == Scheme::kEnds ? 5 : 4.5);
  }
}

/// The best known values are 35.8234 and 39.8788 N m; an independent search of motions at the
/// instants alone reached 39.2 at t = 0 of the turn, and 40.5 at the peak of the impulse.
TEST(PlanBound, SLOW_IsAboveTheBestKnownTrajectories) {
  const Problem turn = load_problem("uvms/valve_trajectory");
  const Eigen::MatrixXd shipped = load_knots(
      MAXWRENCH_SOURCE_DIR "/results/trajectories/uvms_valve_trajectory_spline.csv", turn);
  const PlanBound bound = bound_trajectories(turn, {}, {.gap = 1e-2, .seconds = 600}, shipped);
  EXPECT_EQ(bound.status, Status::kBracket);
  EXPECT_NEAR(bound.answer.beta(), 35.8234, 1e-3);
  EXPECT_GE(bound.bound, 39.2146);
  EXPECT_GE(bound.bound, bound.allowed);
  EXPECT_LE(bound.bound, 41.5);
  EXPECT_EQ(bound.t, 0);
  std::atomic<int> rounds = 0;  // of boxes
  Options options;
  options.interrupted = [&rounds] { return rounds >= 15; };
  ProofOptions limits{.seconds = 600};
  limits.progress = [&rounds](double, double) { ++rounds; };
  const PlanBound peak = bound_trajectories(load_problem("uvms/valve_impulse"), options, limits);
  EXPECT_GE(peak.bound, 40.5338);
  EXPECT_LT(peak.bound, kInfinity);
  EXPECT_NEAR(peak.t, 1.875, 1e-12);
}

/// An open peak counts all knots, so its bound is not below that of a given one.
TEST(PlanBound, SLOW_OfAnOpenPeakIsThatOfTheBestOne) {
  Problem task = load_problem("uvms/lift_impulse");
  task.motion->t_h = 0;
  Options options;
  options.check_collision = false;
  // Once all knots have a bound, motions are tried at the one with the highest. This asks without
  // any progress more often than the 512 halves of a round of boxes.
  std::atomic<int> asked = -1;  // since the last progress; negative: there was none
  options.interrupted = [&asked] { return asked >= 0 && ++asked > 1000; };
  ProofOptions limits{.seconds = 600};
  limits.progress = [&asked](double, double) { asked = 0; };
  const PlanBound open = bound_trajectories(
      task, options, limits,
      Eigen::MatrixXd(task.theta_r_default.transpose().replicate(task.motion->k, 1)));
  EXPECT_LT(open.bound, kInfinity);
  EXPECT_GE(open.bound, 114.5);  // that of the best known trajectory, whose peak is the third knot
}

/// What was skipped bounds nothing.
TEST(PlanBound, OfAnInterruptedRunIsInfinite) {
  for (const char* name : {"uvms/valve_trajectory", "uvms/lift_impulse"}) {
    const Problem task = load_problem(name);
    Options options;
    options.interrupted = [] { return true; };
    const PlanBound bound = bound_trajectories(
        task, options, {},
        Eigen::MatrixXd(task.theta_r_default.transpose().replicate(task.motion->k, 1)));
    EXPECT_EQ(bound.bound, kInfinity);
    EXPECT_EQ(bound.boxes, 0);
    EXPECT_NE(bound.status, Status::kProven);
  }
}

TEST(PlanBound, RejectsWhatItDoesNotSupport) {
  EXPECT_THROW(bound_trajectories(load_problem("planar/force")), std::invalid_argument);
  EXPECT_THROW(bound_trajectories(load_problem("mobile/trajectory")), std::invalid_argument);
  const Problem task = load_problem("planar/trajectory");
  Options any;
  any.wrench = Wrench::kAny;
  EXPECT_THROW(bound_trajectories(task, any), std::invalid_argument);
  Options ellipsoid;
  ellipsoid.measure = "ellipsoid";
  EXPECT_THROW(bound_trajectories(task, ellipsoid), std::invalid_argument);
  EXPECT_THROW(bound_trajectories(task, {}, {.gap = 0}), std::invalid_argument);
  EXPECT_THROW(bound_trajectories(task, {}, {.keep_certificate = true}), std::invalid_argument);
  Problem other = load_problem("uvms/valve_impulse");
  other.motion->scheme = Scheme::kBackward;
  EXPECT_THROW(bound_trajectories(other), std::invalid_argument);
}

/// The reason is what a bound is refused with; an option out of range is no such reason.
TEST(PlanBound, SaysWhyThereIsNone) {
  const Problem task = load_problem("planar/trajectory"), moved = load_problem("mobile/trajectory");
  EXPECT_EQ(why_no_trajectory_bound(task), "");
  EXPECT_THROW(bound_trajectories(task, {}, {.seconds = -1}), std::invalid_argument);
  try {
    bound_trajectories(moved);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(why_no_trajectory_bound(moved), error.what());
  }
}

}  // namespace
}  // namespace maxwrench
