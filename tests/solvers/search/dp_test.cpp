#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/solve.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/search/dp_level.h"
#include "solvers/search/makers.h"
#include "solvers/solve/method.h"

namespace maxwrench {
namespace {

std::unique_ptr<TrajectoryObjective> dp_objective(const Problem& problem,
                                                  Wrench wrench = Wrench::kPure) {
  return make_trajectory_objective(problem, wrench, find_trajectory_solver("facets_or_ipm").make);
}

/// A grid of a task, and the motions between its cells.
class DpCase {
 public:
  explicit DpCase(const Problem& problem, int points, Wrench wrench = Wrench::kPure)
      : objective_(dp_objective(problem, wrench)), run_(options_) {
    const auto& source = dynamic_cast<const InstantSource&>(*objective_);
    for (int part = 0; part < 8; ++part) motions.emplace_back(source);
    const InstantEvaluator& instants = motions.front().instants();
    step.resize(problem.redundancy());
    for (Eigen::Index j = 0; j < step.size(); ++j) {
      const auto joint = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
      step[j] = problem.robot.joints[joint].velocity_max * instants.maps().dt;
    }
    const bool starts = instants.maps().starts;
    grid = std::make_unique<ControlGrid>(problem.theta_r_min, problem.theta_r_max, points, step,
                                         starts ? problem.motion->theta_0 : Eigen::VectorXd());
  }

  DpLevel::Result solve(int peak, double above = -kInfinity, long instants = 1'000'000'000,
                        int threads = 1) {
    for (DpMotion& motion : motions) motion.set_peak(peak);
    made = 0;
    DpLevel level(*grid, motions, threads, run_, [&](long more) { made += more; });
    return level.solve(above, instants);
  }

  /// The best value of all tables whose control points are on the grid and differ from each other
  /// by the largest step at most, by the task's own evaluation.
  double brute_force(int knots) {
    std::vector<int> cells(static_cast<std::size_t>(knots), 0);
    double best = -kInfinity;
    const std::function<void(int)> choose = [&](int i) {
      if (i == knots) {
        best = std::max(best, value(cells));
        return;
      }
      for (int cell = 0; cell < grid->cells(); ++cell) {
        const auto at = static_cast<std::size_t>(i);
        const bool near =
            i == 0 ||
            ((grid->at(cell) - grid->at(cells[at - 1])).array().abs() <= step.array()).all();
        if (!near) continue;
        cells[at] = cell;
        choose(i + 1);
      }
    };
    choose(0);
    return best;
  }

  /// That of the clamped spline with these control points. Slack does not count.
  double value(const std::vector<int>& cells) {
    const auto K = static_cast<int>(cells.size());
    Eigen::MatrixXd knots(K, step.size());
    const auto P = [&](int i) {
      return grid->at(cells[static_cast<std::size_t>(i < 0 ? 1 : i == K ? K - 2 : i)]);
    };
    for (int i = 0; i < K; ++i) knots.row(i) = (P(i - 1) + 4 * P(i) + P(i + 1)).transpose() / 6;
    const Trajectory& trajectory = objective_->trajectories().evaluate(knots);
    const bool valid = trajectory.status == Status::kOptimal && trajectory.collision.empty();
    return valid ? trajectory.value : -kInfinity;
  }

  Eigen::VectorXd step;
  std::vector<DpMotion> motions;
  std::unique_ptr<ControlGrid> grid;
  long made = 0;

 private:
  std::unique_ptr<TrajectoryObjective> objective_;
  SearchOptions options_;
  SearchRun run_;
};

Problem with_knots(const std::string& name, int k) {
  Problem problem = load_problem(name);
  problem.motion->k = k;
  problem.motion->rates = false;
  return problem;
}

/// The task's own evaluation of all plans on the grid has no better one, and the plan that the
/// program gives has its value.
TEST(Dp, SLOW_IsTheBestOfAllPathsOnTheGrid) {
  struct Given {
    const char* task;
    int k, points;
    Wrench wrench;
  };
  for (const Given& given : {Given{"planar/trajectory", 2, 5, Wrench::kPure},
                             Given{"planar/trajectory", 3, 4, Wrench::kPure},
                             Given{"planar/trajectory", 4, 3, Wrench::kPure},
                             Given{"planar/trajectory", 3, 3, Wrench::kAny},
                             Given{"mobile/trajectory", 3, 4, Wrench::kPure}}) {
    SCOPED_TRACE(std::string(given.task) + " k = " + std::to_string(given.k));
    const Problem problem = with_knots(given.task, given.k);
    DpCase dp(problem, given.points, given.wrench);
    const DpLevel::Result best = dp.solve(-1);
    const double all = dp.brute_force(given.k);
    ASSERT_TRUE(best.complete);
    ASSERT_GT(all, -kInfinity);
    EXPECT_NEAR(best.value, all, 1e-6 * (1 + std::abs(all)));
    EXPECT_NEAR(dp.value(best.cells), all, 1e-6 * (1 + std::abs(all)));
  }
}

/// What is known to be better leaves nothing; what is known to be worse changes nothing.
TEST(Dp, LeavesOutWhatCannotExceedAKnownValue) {
  const Problem problem = with_knots("planar/trajectory", 4);
  DpCase dp(problem, 5);
  const DpLevel::Result best = dp.solve(-1);
  const long all = dp.made;
  const DpLevel::Result above = dp.solve(-1, best.value - 1e-3);
  EXPECT_EQ(above.value, best.value);
  EXPECT_EQ(above.cells, best.cells);
  EXPECT_LT(dp.made, all);
  const DpLevel::Result none = dp.solve(-1, best.value);
  EXPECT_TRUE(none.complete);
  EXPECT_TRUE(none.cells.empty());
}

/// Each grid has the points of the one before.
TEST(Dp, SLOW_IsMonotoneInRefinement) {
  const Problem problem = with_knots("planar/trajectory", 4);
  double before = -kInfinity;
  for (const int points : {3, 5, 9}) {
    DpCase dp(problem, points);
    const DpLevel::Result best = dp.solve(-1);
    ASSERT_TRUE(best.complete);
    EXPECT_GE(best.value, before) << points;
    before = best.value;
  }
}

TEST(Dp, IsTheSameAtAnyNumberOfThreads) {
  for (const char* name : {"planar/trajectory", "mobile/trajectory"}) {
    const Problem problem = with_knots(name, 5);
    DpCase dp(problem, 5);
    const DpLevel::Result one = dp.solve(-1, -kInfinity, 1'000'000'000, 1);
    const long made = dp.made;
    for (const int threads : {2, 3, 8}) {
      const DpLevel::Result many = dp.solve(-1, -kInfinity, 1'000'000'000, threads);
      EXPECT_EQ(many.value, one.value) << name;
      EXPECT_EQ(many.cells, one.cells) << name;
      EXPECT_EQ(dp.made, made) << name;
    }
  }
}

/// With fewer instants than it takes, it says so, and never uses more.
TEST(Dp, KeepsToItsInstants) {
  const Problem problem = with_knots("planar/trajectory", 4);
  DpCase dp(problem, 5);
  ASSERT_TRUE(dp.solve(-1).complete);
  for (const long instants : {0L, 1L, 100L, dp.made / 2}) {
    const DpLevel::Result cut = dp.solve(-1, -kInfinity, instants);
    EXPECT_FALSE(cut.complete);
    EXPECT_TRUE(cut.cells.empty());
    EXPECT_LE(dp.made, instants);
  }
}

/// A joint that cannot move by a cell from knot to knot does not move: the best plan is the best
/// posture of the grid, held throughout.
TEST(Dp, SpeedLimitsBindOnTheGrid) {
  Problem problem = with_knots("planar/trajectory", 4);
  const double spacing = (problem.theta_r_max[0] - problem.theta_r_min[0]) / 4;
  const double dt = problem.motion->T / 3;
  for (Joint& joint : problem.robot.joints) joint.velocity_max = 0.99 * spacing / dt;
  DpCase dp(problem, 5);
  EXPECT_EQ(dp.grid->pairs(), 25);
  const DpLevel::Result best = dp.solve(-1);
  double constant = -kInfinity;
  for (int cell = 0; cell < 25; ++cell) {
    constant = std::max(constant, dp.value(std::vector<int>(4, cell)));
  }
  EXPECT_NEAR(best.value, constant, 1e-9);
  for (Joint& joint : problem.robot.joints) joint.velocity_max = 1.01 * spacing / dt;
  DpCase faster(problem, 5);
  EXPECT_EQ(faster.grid->pairs(), 13 * 13);  // 3 neighbours of 5 cells less 2 beyond the ends
  EXPECT_GT(faster.solve(-1).value, best.value);
}

TEST(Dp, GridSizesAreThoseOfTheGrid) {
  const Eigen::Vector3d lower(-1, 0, 2), upper(1, 3, 2), step(0.5, 10, 1);
  for (const int points : {2, 3, 5, 9}) {
    const ControlGrid grid(lower, upper, points, step, {});
    const ControlGrid::Size size = ControlGrid::size(lower, upper, points, step);
    EXPECT_EQ(grid.cells(), points * points);  // the third coordinate cannot move
    EXPECT_EQ(static_cast<double>(grid.cells()), size.cells);
    EXPECT_EQ(static_cast<double>(grid.pairs()), size.pairs);
    for (int a = 0; a < grid.cells(); ++a) {
      for (long p = grid.first(a); p < grid.first(a + 1); ++p) {
        EXPECT_TRUE(
            ((grid.at(a) - grid.at(grid.to(p))).array().abs() <= step.array() + 1e-9).all());
      }
    }
  }
}

SearchOptions dp_options(const Problem& problem, long budget) {
  SearchOptions options;
  options.budget = budget;
  options.start = stacked(default_knots(problem));
  return options;
}

/// The start is evaluated first, so it is what one evaluation gives; more never give less.
TEST(Dp, OneEvaluationIsTheStart) {
  for (const char* name : {"planar/trajectory", "uvms/valve_trajectory", "uvms/lift_impulse",
                           "mobile/trajectory", "planar/force"}) {
    const Problem problem = load_problem(name);
    const auto objective = dp_objective(problem);
    const SearchOptions options = dp_options(problem, 1);
    const SearchResult result = make_dp()->maximize(*objective, options);
    EXPECT_EQ(result.evaluations, 1) << name;
    EXPECT_EQ(result.value, objective->evaluate(options.start)) << name;
    for (const long budget : {2, 3, 40, 400}) {
      const SearchResult more = make_dp()->maximize(*objective, dp_options(problem, budget));
      EXPECT_LE(more.evaluations, budget) << name;
      EXPECT_GE(more.value, result.value) << name;
      EXPECT_EQ(more.value, objective->evaluate(more.theta_r)) << name;
    }
  }
}

/// An open peak is tried at each knot: the grids of all share the budget.
TEST(Dp, AnOpenPeakKeepsToTheBudget) {
  Problem problem = load_problem("uvms/lift_impulse");
  problem.motion->t_h = 0;
  const auto objective = dp_objective(problem);
  for (const long budget : {60, 200, 400}) {
    const SearchResult result = make_dp()->maximize(*objective, dp_options(problem, budget));
    EXPECT_LE(result.evaluations, budget);
  }
}

/// A start without a value is no obstacle: the grid has plans that have one.
TEST(Dp, DoesNotNeedAStartWithAValue) {
  Problem problem = load_problem("planar/trajectory");
  SearchOptions options = dp_options(problem, 4000);
  for (Eigen::Index i = 0; i < options.start.size(); ++i) {  // far too fast
    options.start[i] = i / 2 % 2 == 0 ? problem.theta_r_min[0] : problem.theta_r_max[0];
  }
  options.start *= 0.9;
  problem.robot.joints[0].velocity_max = 0.9;
  const auto limited = dp_objective(problem);
  ASSERT_EQ(limited->evaluate(options.start), -kInfinity);
  const SearchResult result = make_dp()->maximize(*limited, options);
  EXPECT_EQ(result.status, Status::kBestFound);
  EXPECT_GT(result.value, 0);
}

/// Effort rates are no limits of the grid's plans, but count in the value that is reported.
TEST(Dp, ReportsThePlansOwnValueWithEffortRates) {
  Problem problem = load_problem("planar/trajectory");
  problem.robot.u_rate_max.setConstant(0.02);
  const auto limited = dp_objective(problem);
  const SearchResult result = make_dp()->maximize(*limited, dp_options(problem, 4000));
  Problem free = problem;
  free.motion->rates = false;
  EXPECT_EQ(result.value, limited->evaluate(result.theta_r));
  EXPECT_LT(result.value, dp_objective(free)->evaluate(result.theta_r) - 1e-3);
}

/// An impulse has its start and its peak; the best of few plans on a coarse grid of a slow arm.
TEST(Dp, AnImpulseStartsWhereItIsGiven) {
  const Problem problem = load_problem("uvms/lift_impulse");
  DpCase dp(problem, 3);
  const DpLevel::Result best = dp.solve(problem.motion->k);
  ASSERT_TRUE(best.complete);
  ASSERT_EQ(best.cells.size(), static_cast<std::size_t>(problem.motion->k + 1));
  EXPECT_EQ(best.cells[0], dp.grid->given());
  EXPECT_EQ(best.cells[1], dp.grid->given());
  EXPECT_GT(best.value, 0);
}

/// The mass of a transfer is no least value of instants, so neither the list of its searches nor
/// the search itself accepts it.
TEST(Dp, RefusesATransfer) {
  const Problem problem = load_problem(MAXWRENCH_SOURCE_DIR "/examples/tasks/two_link/luus.toml");
  const auto names = supported_searches(problem, "linf_polytope", Wrench::kPure);
  EXPECT_EQ(std::count(names.begin(), names.end(), "dp"), 0);
  EXPECT_EQ(std::count(names.begin(), names.end(), "slp"), 1);
  const auto objective = dp_objective(problem);
  for (const long budget : {1L, 2L, 50L}) {
    EXPECT_THROW(make_dp()->maximize(*objective, dp_options(problem, budget)),
                 std::invalid_argument);
  }
}

/// slp continues from its plan.
TEST(Dp, SLOW_IsAStageBeforeSlp) {
  const Problem problem = load_problem("planar/trajectory");
  Options options;
  options.budget = 3000;
  options.search = "dp";
  const Answer alone = solve(problem, options);
  options.search = "dp+slp";
  const Answer repaired = solve(problem, options);
  ASSERT_TRUE(alone.has_value());
  EXPECT_GE(repaired.beta(), alone.beta() - 1e-9);
  EXPECT_LE(repaired.evaluations, 3000);
}

}  // namespace
}  // namespace maxwrench
