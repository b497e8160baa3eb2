#include "solvers/search/mpc_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"

namespace maxwrench {
namespace {

/// A horizon of a task, with as many evaluations as given.
class HorizonCase {
 public:
  HorizonCase(const Problem& problem, int first, int last, long budget = 1'000'000)
      : objective(make_trajectory_objective(problem, Wrench::kPure,
                                            find_trajectory_solver("facets_or_ipm").make)),
        run_(options_),
        probe_(*objective, budget, run_),
        count_(probe_, problem.motion->instants_per_interval * (problem.motion->k - 1) + 1, 0),
        window(dynamic_cast<const InstantSource&>(*objective), problem, first, last, count_) {}

  std::unique_ptr<TrajectoryObjective> objective;

 private:
  SearchOptions options_;
  SearchRun run_;
  Probe probe_;
  InstantCount count_;

 public:
  MpcWindow window;
};

Eigen::MatrixXd held_points(const Problem& problem, Eigen::Index count) {
  return problem.theta_r_default.transpose().replicate(count, 1);
}

/// In this current no efforts hold the default posture throughout, but other plans have efforts.
TEST(MpcWindow, SLOW_LeavesAPlanWithoutEfforts) {
  Problem problem = load_problem("uvms/valve_trajectory");
  problem.robot.current = {1.4, 0, 0};
  const int k = problem.motion->k;
  HorizonCase whole(problem, 0, k - 1);
  const Eigen::MatrixXd start = held_points(problem, k);
  const auto status = [&](const Eigen::MatrixXd& P) {
    return whole.objective->trajectories().evaluate(knots_of_spline(P)).status;
  };
  ASSERT_EQ(status(start), Status::kInfeasible);
  whole.window.set(start);
  EXPECT_GT(whole.window.value(), -kInfinity);
  whole.window.optimise(60);
  EXPECT_EQ(status(whole.window.points()), Status::kOptimal) << whole.window.value();
}

/// The horizon of the whole path: its value is that of the task, and not above the best plan that
/// `slp` finds from many starts.
TEST(MpcWindow, OfTheWholePathIsALocalOptimum) {
  const Problem problem = load_problem("planar/trajectory");
  const int k = problem.motion->k;
  HorizonCase whole(problem, 0, k - 1);
  const Eigen::MatrixXd start = held_points(problem, k);
  whole.window.set(start);
  const double before = whole.window.value();
  EXPECT_NEAR(before, whole.objective->evaluate(stacked(start)), 1e-9);
  whole.window.optimise(40);
  const double after = whole.window.value();
  EXPECT_GT(after, before + 0.1 * std::abs(before));
  EXPECT_NEAR(after, whole.objective->evaluate(stacked(knots_of_spline(whole.window.points()))),
              1e-7);
  SearchOptions options;
  options.budget = 3000;
  options.start = stacked(start);
  EXPECT_LE(after, find_search("slp").make()->maximize(*whole.objective, options).value + 1e-6);
}

/// The given control points stay, the others keep limits and speeds, and no step lowers the value.
TEST(MpcWindow, KeepsTheStateAndTheLimits) {
  for (const char* name : {"planar/trajectory", "uvms/valve_trajectory", "mobile/trajectory"}) {
    Problem problem = load_problem(name);
    for (Joint& joint : problem.robot.joints) {
      joint.velocity_max = std::min(joint.velocity_max, 0.3);
    }
    problem.robot.collision = nullptr;  // some defaults are where bodies nearly touch
    problem.theta_r_min = problem.theta_r_default.array() - 0.2;
    problem.theta_r_max = problem.theta_r_default.array() + 0.2;
    HorizonCase horizon(problem, 2, 6);
    Eigen::MatrixXd P = held_points(problem, 6);  // P_1 .. P_6
    P.row(0).array() += 0.01;                     // the state moves
    P.row(2).array() -= 0.01;
    for (int i = 3; i < 6; ++i) P.row(i) = P.row(2);
    ASSERT_EQ(horizon.window.given(), 3);
    horizon.window.set(P);
    const double dt = problem.motion->T / (problem.motion->k - 1);
    double before = horizon.window.value();
    ASSERT_GT(before, -kInfinity) << name;
    const double first = before;
    for (int round = 0; round < 8; ++round) {
      horizon.window.optimise(1);
      EXPECT_GE(horizon.window.value(), before) << name;
      before = horizon.window.value();
    }
    EXPECT_GT(before, first) << name;
    const Eigen::MatrixXd& points = horizon.window.points();
    EXPECT_EQ(points.topRows(3), P.topRows(3)) << name;
    EXPECT_NE(points.bottomRows(3), P.bottomRows(3)) << name;
    for (Eigen::Index j = 0; j < points.cols(); ++j) {
      const auto joint = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
      const double speed = problem.robot.joints[joint].velocity_max;
      for (Eigen::Index i = 3; i < points.rows(); ++i) {
        EXPECT_GE(points(i, j), problem.theta_r_min[j]) << name;
        EXPECT_LE(points(i, j), problem.theta_r_max[j]) << name;
        EXPECT_LE(std::abs(points(i, j) - points(i - 1, j)), speed * dt + 1e-9) << name;
      }
    }
  }
}

/// Where effort rates bind, the linear programs have them too.
TEST(MpcWindow, HasEffortRates) {
  Problem problem = load_problem("planar/trajectory");
  HorizonCase free(problem, 0, 4);
  free.window.set(held_points(problem, 5));
  problem.robot.u_rate_max.setConstant(0.1);
  HorizonCase limited(problem, 0, 4);
  limited.window.set(held_points(problem, 5));
  const double before = limited.window.value();
  EXPECT_LT(before, free.window.value() - 1e-3);
  limited.window.optimise(20);
  EXPECT_GT(limited.window.value(), before);
}

TEST(MpcWindow, StopsWhenEvaluationsRunOut) {
  const Problem problem = load_problem("planar/trajectory");
  HorizonCase horizon(problem, 0, 4, 3);
  horizon.window.set(held_points(problem, 5));
  EXPECT_FALSE(horizon.window.stopped());
  horizon.window.optimise(40);
  EXPECT_TRUE(horizon.window.stopped());
  EXPECT_GT(horizon.window.value(), -kInfinity);
}

}  // namespace
}  // namespace maxwrench
