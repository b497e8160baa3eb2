#include "lib/trajectory/window_evaluator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "lib/math/random.h"
#include "lib/trajectory/instant_evaluator.h"
#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "solvers/search/path_plan.h"
#include "solvers/trajectory/bordered_facets.h"

namespace maxwrench {
namespace {

constexpr const char* kWindowTasks[] = {"planar/trajectory", "uvms/valve_trajectory",
                                        "mobile/trajectory"};

std::unique_ptr<TrajectoryObjective> window_objective(const Problem& problem,
                                                      Wrench wrench = Wrench::kPure) {
  return make_trajectory_objective(problem, wrench, find_trajectory_solver("facets_or_ipm").make);
}

std::unique_ptr<WindowEvaluator> window_of(TrajectoryObjective& objective, SchemeMaps maps) {
  return dynamic_cast<const InstantSource&>(objective).make_window(std::move(maps));
}

/// Control points near the default.
Eigen::MatrixXd drawn_points(const Problem& problem, Eigen::Index count, double reach) {
  Random random(7);
  Eigen::MatrixXd P = problem.theta_r_default.transpose().replicate(count, 1);
  for (Eigen::Index i = 0; i < P.size(); ++i) P(i) += random.uniform(-reach, reach);
  return P;
}

/// The window of all knots is the whole task: its value is that of the task's own evaluation at the
/// spline's knots.
TEST(WindowEvaluator, OfAllKnotsIsTheTask) {
  for (const char* name : kWindowTasks) {
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      const Problem problem = load_problem(name);
      const auto objective = window_objective(problem, wrench);
      const int k = problem.motion->k;
      const auto window = window_of(*objective, make_spline_window(*problem.motion, 0, k - 1));
      const Eigen::MatrixXd P = drawn_points(problem, k, 0.05);
      const double value = window->evaluate(P);
      const Trajectory& whole = objective->trajectories().evaluate(knots_of_spline(P));
      ASSERT_EQ(whole.status, Status::kOptimal) << name << ": " << whole.reason.c_str();
      EXPECT_NEAR(value, whole.value, 1e-7 * (1 + std::abs(whole.value))) << name;
    }
  }
}

/// Where no efforts balance the motion, it is the elastic value of the whole task.
TEST(WindowEvaluator, HasThePriceOfMissingEfforts) {
  for (const char* name : kWindowTasks) {
    Problem problem = load_problem(name);
    Zonotope& set = problem.robot.actuation;
    set = with_limits(set, 0.01 * set.u_min, 0.01 * set.u_max);
    problem.motion->path = Path::screw(problem.pose, Eigen::Vector3d::UnitZ(), problem.pose.p, 0,
                                       Eigen::Vector3d(2, 0, 0), Timing::kLinear, 1);
    problem.motion->T = 1;
    const auto objective = window_objective(problem);
    const int k = problem.motion->k;
    const auto window = window_of(*objective, make_spline_window(*problem.motion, 0, k - 1));
    const Eigen::MatrixXd P = drawn_points(problem, k, 0.05);
    const double value = window->evaluate(P);
    const Eigen::MatrixXd knots = knots_of_spline(P);
    const double elastic = objective->trajectories().evaluate_elastic(knots, nullptr);
    ASSERT_EQ(objective->trajectories().evaluate(knots).status, Status::kInfeasible) << name;
    EXPECT_NEAR(value, elastic, 1e-7 * (1 + std::abs(elastic))) << name;
    EXPECT_TRUE(window->coupled());
  }
}

/// If a plan is at rest at the end of a window, each window of it has the positions, rates and
/// accelerations of the clamped spline through the knots of the whole plan.
TEST(WindowEvaluator, IsAStretchOfTheSpline) {
  const Problem problem = load_problem("uvms/valve_trajectory");
  const MotionTask& task = *problem.motion;
  const int k = task.k, per = task.instants_per_interval;
  const SchemeMaps dense = make_dense_spline(task, per);
  for (int last = 2; last < k; ++last) {
    Eigen::MatrixXd P = drawn_points(problem, k, 0.3);
    if (last + 1 < k) P.row(last + 1) = P.row(last - 1);
    const Eigen::MatrixXd knots = knots_of_spline(P);
    for (int first = 0; first < last - 1; ++first) {
      const SchemeMaps maps = make_spline_window(task, first, last);
      const int skipped = first == 0 ? 0 : 1, column_0 = first == 0 ? 0 : first - 1;
      ASSERT_EQ(maps.instants(), (last - first) * per + 1 - skipped);
      const Eigen::MatrixXd points = P.middleRows(column_0, maps.knots());
      for (int n = 0; n < maps.instants(); ++n) {
        const int whole = first * per + n + skipped;
        EXPECT_NEAR(maps.t[static_cast<std::size_t>(n)], dense.t[static_cast<std::size_t>(whole)],
                    1e-12);
        const auto expect_same = [&](const Eigen::MatrixXd& mine, const Eigen::MatrixXd& theirs) {
          EXPECT_LT((mine.row(n) * points - theirs.row(whole) * knots).norm(),
                    1e-9 * (1 + theirs.row(whole).norm()))
              << first << ' ' << last << ' ' << n;
        };
        expect_same(maps.P, dense.P);
        expect_same(maps.V, dense.V);
        expect_same(maps.A, dense.A);
      }
    }
  }
}

/// At rest at a constant pose the value of an instant is the static capability.
TEST(WindowEvaluator, OfAnInstantAtAConstantPoseIsStatic) {
  Problem moving = load_problem("planar/trajectory");
  moving.motion->path = Path::constant(moving.pose, moving.motion->T);
  Problem rest = moving;
  rest.motion.reset();
  const auto objective = window_objective(moving);
  const auto window = window_of(*objective, make_resting_instant(*moving.motion, 1.5));
  const Eigen::MatrixXd P = drawn_points(moving, 12, 0.5);
  for (const auto row : P.rowwise()) {
    const Answer answer = evaluate(rest, row.transpose(), {});
    const double value = window->evaluate(row);
    if (answer.capability.status == Status::kOptimal) {
      EXPECT_NEAR(value, answer.capability.beta, 1e-9);
    }
  }
}

/// By central differences. A step across a kink has another slope, so the two one-sided differences
/// must agree first.
TEST(WindowEvaluator, HasTheGradientOfItsValue) {
  constexpr double kStep = 1e-6;
  for (const char* name : kWindowTasks) {
    const Problem problem = load_problem(name);
    for (const Wrench wrench : {Wrench::kPure, Wrench::kAny}) {
      const auto objective = window_objective(problem, wrench);
      for (const bool one : {true, false}) {
        const auto window = window_of(*objective, one ? make_resting_instant(*problem.motion, 1.1)
                                                      : make_spline_window(*problem.motion, 2, 5));
        const Eigen::MatrixXd P = drawn_points(problem, window->maps().knots(), 0.05);
        const double value = window->evaluate(P);
        ASSERT_GT(value, -kInfinity) << name;
        Eigen::MatrixXd gradient;
        window->gradient(gradient);
        int smooth = 0;
        for (Eigen::Index i = 0; i < P.size(); ++i) {
          Eigen::MatrixXd up = P, down = P;
          up(i) += kStep;
          down(i) -= kStep;
          const double right = (window->evaluate(up) - value) / kStep;
          const double left = (value - window->evaluate(down)) / kStep;
          const double scale = 1 + std::abs(right) + std::abs(left);
          if (std::abs(right - left) > 1e-3 * scale) continue;
          ++smooth;
          EXPECT_NEAR(gradient(i), (left + right) / 2, 2e-4 * scale) << name << ' ' << i;
        }
        EXPECT_GE(2 * smooth, P.size()) << name;
      }
    }
  }
}

/// Steps |y| <= eps of the free control points raise the linearised value by eps |g|_1 where the
/// value is smooth, with g its gradient.
TEST(WindowEvaluator, LinearizesItsValue) {
  constexpr double kReach = 1e-5;
  for (const char* name : kWindowTasks) {
    const Problem problem = load_problem(name);
    const auto objective = window_objective(problem);
    const auto window = window_of(*objective, make_spline_window(*problem.motion, 2, 5));
    ASSERT_EQ(window->maps().before, 3);
    const Eigen::MatrixXd P = drawn_points(problem, window->maps().knots(), 0.05);
    const double value = window->evaluate(P);
    ASSERT_GT(value, -kInfinity) << name;
    TrajectoryProgram program = window->linearize();
    Eigen::MatrixXd gradient;
    window->gradient(gradient);
    const Eigen::Index free = (P.rows() - 3) * P.cols();
    program.y_max.setConstant(free, kReach);
    program.y_min = -program.y_max;
    program.R.resize(0, free);
    program.r_min.resize(0);
    program.r_max.resize(0);
    ASSERT_TRUE(BorderedFacets::suits(program));
    TrajectorySolution solution;
    ASSERT_TRUE(BorderedFacets().solve(program, solution)) << name;
    const double slope = gradient.bottomRows(P.rows() - 3).lpNorm<1>();
    ASSERT_GT(slope, 0) << name;
    EXPECT_NEAR((solution.value - value) / kReach, slope, 1e-3 * slope) << name;
  }
}

}  // namespace
}  // namespace maxwrench
