#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/trajectory/task_of.h"
#include "maxwrench/problem.h"
#include "solvers/search/dp_level.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"
#include "solvers/search/path_plan.h"

namespace maxwrench {
namespace {

constexpr int kParts = 32;      // of a batch; not the number of threads
constexpr int kMostLevel = 20;  // 2^20 + 1 points
// Of larger grids, the values of pairs would take gigabytes.
constexpr double kMostGridCells = 1e6, kMostPairs = 4e6;
constexpr double kMostValues = 8 * kMostPairs;  // of all knots; half a gigabyte with their order

/// Dynamic programming over grids of control points, each with half the spacing of the one before.
class Dp final : public Search {
 public:
  SearchResult maximize(Objective& given, const SearchOptions& options) override {
    check(options, given);
    TrajectoryObjective& objective = require_trajectories(given, "dp");
    const auto* source = dynamic_cast<const InstantSource*>(&objective);
    if (source == nullptr) {
      throw std::invalid_argument(
          "search: got 'dp' for an objective of another program, expected "
          "that of make_trajectory_objective");
    }
    const Problem& problem = task_of(objective);
    if (problem.motion && problem.motion->transfer) {
      throw std::invalid_argument(
          "search: got 'dp', which does not support a transfer, expected another search");
    }
    const Box box(objective);
    SearchRun run(options);
    Probe probe(objective, options.budget, run, options.starts_wanted > 0 ? &box : nullptr);
    probe.evaluate(box.start(options.start));
    std::string stopped = kBudgetSpent;
    if (objective.dimension() == 0) {
      stopped = "there is nothing to choose";
    } else if (probe.left() > 1) {
      stopped = refine(*source, options, run, probe);
    }
    SearchResult result = make_result(probe.take(), box, options, run);
    result.stopped = stopped;
    return result;
  }

 private:
  /// The limits of the control points.
  struct Limits {
    explicit Limits(const InstantEvaluator& instants)
        : lower(instants.problem().theta_r_min),
          upper(instants.problem().theta_r_max),
          step(lower.size()),
          given(instants.maps().starts ? instants.task().theta_0 : Eigen::VectorXd()) {
      const Problem& problem = instants.problem();
      for (Eigen::Index j = 0; j < step.size(); ++j) {
        const auto joint = static_cast<std::size_t>(problem.redundant[static_cast<std::size_t>(j)]);
        const double speed = problem.robot.joints[joint].velocity_max;
        // With one knot there is no move.
        step[j] = instants.maps().dt > 0 ? speed * instants.maps().dt : 0;
      }
    }
    ControlGrid::Size size(int level) const {
      return ControlGrid::size(lower, upper, points(level), step);
    }
    static int points(int level) { return (1 << level) + 1; }

    Eigen::VectorXd lower, upper, step, given;
  };

  /// The coarsest grid; at rest, where a cell takes one evaluation, the finest one.
  static int first_level(const Limits& limits, int knots, long instants) {
    int level = 1;
    while (knots == 1 && level < kMostLevel) {
      const double cells = limits.size(level + 1).cells;
      if (cells > kMostGridCells || cells > static_cast<double>(instants)) break;
      ++level;
    }
    return level;
  }

  /// Returns why it ended.
  static std::string refine(const InstantSource& source, const SearchOptions& options,
                            SearchRun& run, Probe& probe) {
    std::vector<DpMotion> motions;
    for (int part = 0; part < kParts; ++part) motions.emplace_back(source);
    const InstantEvaluator& instants = motions.front().instants();
    const MotionTask& task = instants.task();
    const Limits limits(instants);
    const long per_evaluation = instants.maps().instants();
    long over = 0;  // instants that no evaluation has counted yet
    const auto spend = [&](long made) {
      over += made;
      for (; over >= per_evaluation && probe.left() > 1; over -= per_evaluation) probe.spend();
    };
    // One evaluation is kept for the trajectory that a grid gives.
    const auto left = [&] { return (probe.left() - 1) * per_evaluation - over; };
    int done = 0;
    for (int level = first_level(limits, motions.front().knots(), left()); level <= kMostLevel;
         ++level) {
      const ControlGrid::Size size = limits.size(level);
      const bool fits = size.pairs <= std::min(static_cast<double>(left()), kMostPairs) &&
                        size.pairs * motions.front().knots() <= kMostValues;
      if (!fits || size.cells > kMostGridCells) return describe(done, Limits::points(level));
      const ControlGrid grid(limits.lower, limits.upper, Limits::points(level), limits.step,
                             limits.given);
      for (const int peak : peaks(task)) {
        if (probe.left() <= 1) return kBudgetSpent;
        for (DpMotion& motion : motions) motion.set_peak(peak);
        DpLevel dp(grid, motions, options.threads, run, spend);
        const DpLevel::Result best = dp.solve(probe.found().best.value, left());
        if (!best.complete) return describe(done, grid.points());
        if (best.cells.empty()) continue;
        if (probe.left() < 1) return kBudgetSpent;
        probe.evaluate(knots(grid, instants, best.cells));
      }
      done = grid.points();
      if (motions.front().knots() == 1 && probe.left() < 2) return kBudgetSpent;
    }
    return describe(done, Limits::points(kMostLevel + 1));
  }

  /// -1: there is none.
  static std::vector<int> peaks(const MotionTask& task) {
    if (!task.impulse) return {-1};
    if (task.t_h > 0) return {task.t_h};
    std::vector<int> knots(static_cast<std::size_t>(task.k));
    for (int knot = 1; knot <= task.k; ++knot) knots[static_cast<std::size_t>(knot) - 1] = knot;
    return knots;
  }

  /// The stacked knots of a curve with these control points.
  static Eigen::VectorXd knots(const ControlGrid& grid, const InstantEvaluator& instants,
                               const std::vector<int>& cells) {
    const auto K = static_cast<int>(cells.size());
    const int before = instants.maps().before;
    Eigen::MatrixXd P(K, instants.problem().redundancy());
    for (int i = 0; i < K; ++i) P.row(i) = grid.at(cells[static_cast<std::size_t>(i)]).transpose();
    return stacked(knots_of_spline(P).bottomRows(K - before));
  }

  static std::string describe(int done, int next) {
    if (done == 0) return fmt::format("a grid of {} points takes more evaluations or memory", next);
    return fmt::format(
        "best spline of a grid of {} points for each coordinate, without effort rates or thruster "
        "lag; {} take more evaluations or memory",
        done, next);
  }
};

}  // namespace

std::unique_ptr<Search> make_dp() { return std::make_unique<Dp>(); }

}  // namespace maxwrench
