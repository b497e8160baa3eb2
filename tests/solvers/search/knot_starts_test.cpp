#include "solvers/search/knot_starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

#include "maxwrench/load.h"
#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "tests/support/drawn_starts.h"
#include "tests/support/objectives.h"

namespace maxwrench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// k×r: what each knot differs by from that of the start.
MatrixXd offsets(const Candidate& start, const SearchOptions& options, int knots) {
  return unstacked(start.theta_r - options.start, knots);
}

/// Whether a row of this coordinate is at its limit. The rows come coordinate by coordinate.
bool is_stopped(const KnotRows& rows, const VectorXd& x, Eigen::Index coordinate, Eigen::Index r) {
  const Eigen::Index each = rows.r_min.size() / r;
  const VectorXd at = (rows.R * x).segment(coordinate * each, each);
  const auto low = rows.r_min.segment(coordinate * each, each);
  const auto high = rows.r_max.segment(coordinate * each, each);
  // Equations are always at theirs.
  const auto bounds = (high - low).array() > 0;
  return (bounds && ((at - low).array() < 1e-9 || (high - at).array() < 1e-9)).any();
}

class KnotStartsOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tasks, KnotStartsOf,
                         testing::Values("planar/trajectory", "uvms/valve_trajectory",
                                         "uvms/valve_impulse"));

TEST_P(KnotStartsOf, AreTablesWithAValueWithinAllLimits) {
  const Problem problem = load_problem(GetParam());
  const auto objective = trajectories_to_draw(problem);
  const SearchOptions options = draw_options(problem, 300);
  const Drawn drawn(draw_knot_starts, *objective, options);
  // A tenth of the budget, the start among them.
  EXPECT_EQ(drawn.found.trace.evaluations(), 30);
  EXPECT_EQ(drawn.shown, 30);
  ASSERT_GT(drawn.starts.size(), 5U);
  EXPECT_LE(drawn.starts.size(), 30U);
  EXPECT_TRUE(std::any_of(drawn.starts.begin(), drawn.starts.end(),
                          [&](const Candidate& c) { return c.theta_r == options.start; }));
  const KnotRows& rows = objective->trajectories().rows();
  double best = -kInfinity;
  for (const Candidate& start : drawn.starts) {
    EXPECT_NEAR(objective->evaluate(start.theta_r), start.value, 1e-9);
    EXPECT_TRUE((start.theta_r.array() >= objective->lower().array()).all());
    EXPECT_TRUE((start.theta_r.array() <= objective->upper().array()).all());
    const VectorXd at = rows.R * start.theta_r;
    EXPECT_LE((at - rows.r_max).maxCoeff(), 1e-9);
    EXPECT_LE((rows.r_min - at).maxCoeff(), 1e-9);
    best = std::max(best, start.value);
  }
  EXPECT_EQ(drawn.starts.front().value, best);
  EXPECT_EQ(drawn.found.best.value, best);
}

/// Along a path all knots are moved alike. An impulse, whose start a row binds to knot 0, would not
/// leave it: its knots differ.
TEST_P(KnotStartsOf, MoveAlikeWhereTheyMay) {
  const Problem problem = load_problem(GetParam());
  const auto objective = trajectories_to_draw(problem);
  const SearchOptions options = draw_options(problem, 300);
  const Drawn drawn(draw_knot_starts, *objective, options);
  bool differ = false;
  for (const Candidate& start : drawn.starts) {
    const MatrixXd moved = offsets(start, options, knots_of(problem));
    differ = differ || (moved.rowwise() - moved.row(0)).norm() > 1e-9;
  }
  EXPECT_EQ(differ, problem.motion->impulse);
}

/// In the time of an impulse no joint moves as far as its limits, so the tables that are drawn move
/// most of them as fast as they can somewhere, not only the one that has the least time.
TEST(KnotStarts, MoveEachJointOfAnImpulseAsFarAsItsOwnLimits) {
  Problem problem = load_problem("uvms/valve_impulse");
  problem.motion->T = 1.2;
  const auto objective = trajectories_to_draw(problem);
  const KnotRows& rows = objective->trajectories().rows();
  const int r = problem.redundancy();
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    SearchOptions options = draw_options(problem, 300);
    options.seed = seed;
    const Drawn drawn(draw_knot_starts, *objective, options);
    int joints = 0, stopped = 0;
    for (const Candidate& start : drawn.starts) {
      if (start.theta_r == options.start) continue;
      for (int j = 0; j < r; ++j) stopped += is_stopped(rows, start.theta_r, j, r) ? 1 : 0;
      joints += r;
    }
    ASSERT_GT(joints, 5 * r);
    EXPECT_GT(stopped, 0.9 * joints) << seed;
    // From there half of all steps of a joint are against a limit, which stops this joint only.
    int moved = 0, all = 0;
    for (const Candidate& at : drawn.starts) {
      Part found;
      for (const Candidate& kick : kick_knots(*objective, options, at, 0, 4, quiet_run(), found)) {
        moved += (kick.theta_r - at.theta_r).norm() > 1e-6 ? 1 : 0;
        ++all;
      }
    }
    EXPECT_GT(moved, 0.6 * all) << seed;
  }
}

TEST_P(KnotStartsOf, SLOW_AreTheSameAtAnyThreadCount) {
  const Problem problem = load_problem(GetParam());
  const auto objective = trajectories_to_draw(problem);
  const Drawn one(find_knot_starts, *objective, draw_options(problem, 300, 1));
  const Drawn four(find_knot_starts, *objective, draw_options(problem, 300, 4));
  expect_same(one, four);
  SearchOptions other = draw_options(problem, 300);
  other.seed = 2;
  const Drawn elsewhere(find_knot_starts, *objective, other);
  EXPECT_NE(one.starts.back().theta_r, elsewhere.starts.back().theta_r);
}

/// Before the tables that were drawn come the ends of local searches with all knots alike: they are
/// no worse, of one posture, and no two of a family. Impulses have none.
TEST_P(KnotStartsOf, BeginWithTheEndsOfLocalSearches) {
  const Problem problem = load_problem(GetParam());
  const auto objective = trajectories_to_draw(problem);
  const SearchOptions options = draw_options(problem, 600);
  const Drawn drawn(draw_knot_starts, *objective, options);
  const Drawn found(find_knot_starts, *objective, options);
  EXPECT_LE(found.found.trace.evaluations(), 60 + 120);  // a tenth and a fifth of the budget
  EXPECT_EQ(found.shown, found.found.trace.evaluations());
  const std::size_t heads = found.starts.size() - drawn.starts.size();
  EXPECT_EQ(heads == 0, problem.motion->impulse);
  for (std::size_t i = 0; i < drawn.starts.size(); ++i) {
    EXPECT_EQ(found.starts[heads + i].theta_r, drawn.starts[i].theta_r);
  }
  EXPECT_GE(found.found.best.value, drawn.found.best.value);
  if (heads == 0) return;
  EXPECT_GT(found.starts.front().value, drawn.starts.front().value);
  for (std::size_t i = 0; i < heads; ++i) {
    const MatrixXd moved = offsets(found.starts[i], options, knots_of(problem));
    EXPECT_LT((moved.rowwise() - moved.row(0)).norm(), 1e-9);
    EXPECT_NEAR(objective->evaluate(found.starts[i].theta_r), found.starts[i].value, 1e-9);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(found.starts[j].value, found.starts[i].value);
      EXPECT_GT((found.starts[j].theta_r - found.starts[i].theta_r).norm(), 0.05);
    }
  }
}

/// A start whose knots differ, and one knot with narrow bounds: offsets are within the bounds of
/// all knots, so that they are the same for all and the differences stay.
TEST(KnotStarts, AlikeMeansWithinTheBoundsOfAllKnots) {
  const Problem problem = load_problem("planar/trajectory");
  const auto whole = trajectories_to_draw(problem);
  const int r = problem.redundancy();
  SearchOptions options = draw_options(problem, 2000);
  VectorXd lower = whole->lower(), upper = whole->upper();
  upper.segment(3 * r, r).setConstant(0.1);
  options.start.tail(r).array() -= 0.2;
  OtherBounds objective(trajectories_to_draw(problem), lower, upper);
  for (Drawn::Draw* draw : {draw_knot_starts, find_knot_starts}) {
    const Drawn drawn(draw, objective, options);
    ASSERT_GT(drawn.starts.size(), 20U);
    for (const Candidate& start : drawn.starts) {
      const MatrixXd moved = offsets(start, options, knots_of(problem));
      EXPECT_LT((moved.rowwise() - moved.row(0)).norm(), 1e-7);
      EXPECT_LE(moved.maxCoeff(), 0.1 + 1e-7);
    }
  }
}

/// Each pair of kicks has a reach of its own, and the first of a pair moves all knots alike, unless
/// limits are in the way.
TEST_P(KnotStartsOf, KicksStayNearTheTrajectoryAndWithinAllLimits) {
  const Problem problem = load_problem(GetParam());
  const auto objective = trajectories_to_draw(problem);
  const SearchOptions options = draw_options(problem, 300);
  const Candidate trajectory = {options.start, objective->evaluate(options.start)};
  const KnotRows& rows = objective->trajectories().rows();
  Part found;
  const auto kicks = kick_knots(*objective, options, trajectory, 0, 16, quiet_run(), found);
  EXPECT_EQ(found.trace.evaluations(), 16);
  ASSERT_GT(kicks.size(), 2U);  // many collide
  for (const Candidate& kick : kicks) {
    EXPECT_NEAR(objective->evaluate(kick.theta_r), kick.value, 1e-9);
    EXPECT_TRUE((kick.theta_r.array() >= objective->lower().array()).all());
    EXPECT_TRUE((kick.theta_r.array() <= objective->upper().array()).all());
    const VectorXd at = rows.R * kick.theta_r;
    EXPECT_LE((at - rows.r_max).maxCoeff(), 1e-9);
    EXPECT_LE((rows.r_min - at).maxCoeff(), 1e-9);
    const double moved = (kick.theta_r - trajectory.theta_r).norm();
    EXPECT_GT(moved, 0);
    EXPECT_LE(moved, 0.8 * std::sqrt(static_cast<double>(trajectory.theta_r.size())));
  }
  // Others of the series differ, the same ones do not.
  const auto again = kick_knots(*objective, options, trajectory, 0, 16, quiet_run(), found);
  const auto later = kick_knots(*objective, options, trajectory, 16, 16, quiet_run(), found);
  EXPECT_EQ(again.front().theta_r, kicks.front().theta_r);
  EXPECT_NE(later.front().theta_r, kicks.front().theta_r);
}

TEST(KnotStarts, NoneOnceTheRunHasEnded) {
  const Problem problem = load_problem("planar/trajectory");
  SearchOptions options = draw_options(problem, 500);
  options.interrupted = [] { return true; };
  const Drawn drawn(find_knot_starts, *trajectories_to_draw(problem), options);
  EXPECT_TRUE(drawn.starts.empty());
  EXPECT_EQ(drawn.found.best.value, -kInfinity);
  EXPECT_EQ(drawn.found.trace.evaluations(), 0);
}

/// To an objective to which more counts, their values are guides: none is its own.
TEST(KnotStarts, AreTheSameWhateverCounts) {
  const Problem problem = load_problem("planar/trajectory");
  const auto objective = trajectories_to_draw(problem);
  const auto throughout = objective->copy(TrajectoryValue::kThroughout);
  std::atomic<long> values = 0;
  SearchOptions options = draw_options(problem, 600);
  const Drawn by_instants(find_knot_starts, *objective, options);
  options.evaluated = [&](double value) { values += value > -kInfinity ? 1 : 0; };
  const Drawn guided(find_knot_starts, *throughout, options);
  ASSERT_EQ(guided.starts.size(), by_instants.starts.size());
  for (std::size_t i = 0; i < guided.starts.size(); ++i) {
    EXPECT_EQ(guided.starts[i].theta_r, by_instants.starts[i].theta_r);
    EXPECT_EQ(guided.starts[i].value, by_instants.starts[i].value);
  }
  EXPECT_EQ(guided.found.trace.evaluations(), by_instants.found.trace.evaluations());
  EXPECT_TRUE(guided.found.trace.improvements().empty());
  EXPECT_EQ(guided.found.best.value, -kInfinity);
  EXPECT_EQ(values, 0);
}

TEST(KnotStarts, OneEvaluationIsTheStart) {
  const Problem problem = load_problem("planar/trajectory");
  const auto objective = trajectories_to_draw(problem);
  for (const long budget : {1, 19}) {
    const Drawn drawn(find_knot_starts, *objective, draw_options(problem, budget));
    EXPECT_EQ(drawn.found.trace.evaluations(), 1);
    EXPECT_EQ(drawn.found.best.theta_r, draw_options(problem, budget).start);
  }
}

TEST(KnotStarts, RequireTrajectories) {
  const Problem problem = load_problem("planar/force");
  const auto posture = make_capability_objective(problem, Wrench::kPure, [&] {
    return find_measure("linf_polytope").make(problem, find_wrench_solver("facets").make());
  });
  try {
    require_trajectories(*posture, "a_search");
    FAIL() << "expected std::invalid_argument";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("got 'a_search',"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(require_trajectories(*trajectories_to_draw(problem), "a_search"));
}

}  // namespace
}  // namespace maxwrench
