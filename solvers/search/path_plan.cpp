#include "solvers/search/path_plan.h"

#include <fmt/format.h>

#include <stdexcept>

#include "lib/math/random.h"
#include "lib/trajectory/task_of.h"
#include "maxwrench/problem.h"
#include "solvers/search/knot_starts.h"

namespace maxwrench {

Eigen::MatrixXd knots_of_spline(const Eigen::MatrixXd& P) {
  const Eigen::Index K = P.rows();
  Eigen::MatrixXd knots(K, P.cols());
  for (Eigen::Index i = 0; i < K; ++i) {
    const Eigen::Index before = K == 1 ? 0 : i == 0 ? 1 : i - 1;
    const Eigen::Index after = K == 1 ? 0 : i == K - 1 ? K - 2 : i + 1;
    knots.row(i) = (P.row(before) + 4 * P.row(i) + P.row(after)) / 6;
  }
  return knots;
}

const InstantSource& require_path(Objective& objective, const char* search) {
  const TrajectoryObjective* trajectories = as_trajectories(objective);
  const auto* source = dynamic_cast<const InstantSource*>(trajectories);
  if (source == nullptr) {
    throw std::invalid_argument(
        fmt::format("search: got '{}' for a static task or an objective of another program, "
                    "expected a task along a path with two knots or more",
                    search));
  }
  const Problem& problem = task_of(*trajectories);
  const bool path = problem.motion && !problem.motion->impulse && !problem.motion->transfer;
  if (!path || problem.motion->k < 2) {
    throw std::invalid_argument(
        fmt::format("search: got '{}' for {}, expected a task along a path with two knots or more",
                    search, problem.name));
  }
  return *source;
}

Eigen::VectorXd drawn_posture(const PathContext& path, int i) {
  Random random(path.seed, RandomUse::kSample, static_cast<std::uint64_t>(i));
  Eigen::VectorXd theta_r(path.start.size());
  for (Eigen::Index j = 0; j < theta_r.size(); ++j) {
    theta_r[j] = random.uniform(path.problem.theta_r_min[j], path.problem.theta_r_max[j]);
  }
  return theta_r;
}

SearchResult search_path(Objective& objective, const SearchOptions& options, const char* search,
                         const std::function<std::string(const PathContext&)>& plan) {
  check(options, objective);
  const InstantSource& source = require_path(objective, search);
  const Problem& problem = task_of(dynamic_cast<TrajectoryObjective&>(objective));
  const Box box(objective);
  SearchRun run(options);
  Probe probe(objective, options.budget, run, options.starts_wanted > 0 ? &box : nullptr);
  const Eigen::VectorXd start = box.start(options.start);
  probe.evaluate(start);
  std::string stopped = kBudgetSpent;
  if (objective.dimension() == 0) {
    stopped = "there is nothing to choose";
  } else if (probe.left() > 1) {
    const MotionTask& task = *problem.motion;
    InstantCount count(probe, task.instants_per_interval * (task.k - 1) + 1, 1);
    stopped = plan(
        {source, problem, options.seed, unstacked(start, task.k).row(0).transpose(), count, probe});
  }
  SearchResult result = make_result(probe.take(), box, options, run);
  result.stopped = stopped;
  return result;
}

}  // namespace maxwrench
