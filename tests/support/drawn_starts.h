#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "maxwrench/problem.h"
#include "maxwrench/strategies.h"
#include "maxwrench/trajectory.h"
#include "solvers/search/probe.h"

namespace maxwrench {

inline std::unique_ptr<TrajectoryObjective> trajectories_to_draw(const Problem& problem) {
  return make_trajectory_objective(problem, Wrench::kPure,
                                   find_trajectory_solver("facets_or_ipm").make);
}

inline SearchOptions draw_options(const Problem& problem, long budget, int threads = 2) {
  SearchOptions options;
  options.budget = budget;
  options.threads = threads;
  options.start = stacked(default_knots(problem));
  return options;
}

/// What was drawn, and what that took.
struct Drawn {
  using Draw = std::vector<Candidate>(TrajectoryObjective&, const SearchOptions&, SearchRun&,
                                      Part&);
  Drawn(Draw* draw, TrajectoryObjective& objective, SearchOptions options) {
    options.progress = [this](long count) { shown = std::max<long>(shown, count); };
    SearchRun run(options);
    starts = draw(objective, options, run, found);
  }
  std::vector<Candidate> starts;
  Part found;
  std::atomic<long> shown = 0;
};

inline void expect_same(const Drawn& one, const Drawn& other) {
  ASSERT_EQ(one.starts.size(), other.starts.size());
  for (std::size_t i = 0; i < one.starts.size(); ++i) {
    EXPECT_EQ(one.starts[i].theta_r, other.starts[i].theta_r);
    EXPECT_EQ(one.starts[i].value, other.starts[i].value);
  }
  EXPECT_EQ(one.found.trace.evaluations(), other.found.trace.evaluations());
}

}  // namespace maxwrench
