#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "lib/trajectory/task_of.h"
#include "maxwrench/problem.h"
#include "solvers/pontryagin/climb.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"

namespace maxwrench {
namespace {

constexpr std::size_t kClimbs = 4;
constexpr long kMostOfClimb = 400;  // evaluations
constexpr double kPlanRetreats[] = {0.9, 0.75, 0.5};
constexpr long kOfPlan = 2 * (1 + std::size(kPlanRetreats));  // evaluations, of both plans
constexpr long kLeastBudget = 1 + 2 * kOfPlan;                // of one climb, after one drawn table

/// Throws std::invalid_argument if the objective is not that of a transfer.
TrajectoryObjective& require_transfer_objective(Objective& objective) {
  TrajectoryObjective* const trajectories = as_trajectories(objective);
  if (trajectories) {
    const Problem& problem = task_of(*trajectories);
    if (problem.motion && problem.motion->transfer) return *trajectories;
  }
  throw std::invalid_argument(
      "search: got 'pontryagin', which supports only transfers, expected another search");
}

/// One climb and the plans of its extremals.
struct Ascent {
  Part part;
  Climb climb;
  double plan = -kInfinity;  ///< the best value of a plan
  std::string switching;
  int switches = 0;
};

/// The way of Hamilton and Pontryagin to the largest payload of a transfer. Each evaluation is one
/// integration of states, costates and sensitivities over the task, or the value of a plan: the
/// spline that samples an extremal, or one between that and the best plan so far if it has none.
class Pontryagin final : public Search {
 public:
  SearchResult maximize(Objective& given, const SearchOptions& options) override {
    check(options, given);
    TrajectoryObjective& objective = require_transfer_objective(given);
    const Problem& problem = task_of(objective);
    CanonicalEquations check_limits(problem);
    SearchRun run(options);
    Part found;
    const Eigen::VectorXd first = Box(objective).start(options.start);
    const bool fixed = objective.dimension() == 0;
    if (fixed || options.budget < kLeastBudget) {  // only the start
      Probe probe(objective, options.budget, run);
      probe.evaluate(first);
      found = probe.take();
      SearchResult result = make_result(found, run);
      result.stopped = fixed ? "there is nothing to choose" : "the budget is too small for a climb";
      return result;
    }
    std::vector<Candidate> starts = draw_knot_starts(objective, options, run, found);
    std::erase_if(starts, [&](const Candidate& start) { return start.theta_r == first; });
    starts.insert(starts.begin(), Candidate{first, 0});
    if (starts.size() > kClimbs) starts.resize(kClimbs);
    const long left = options.budget - found.trace.evaluations();
    while (!starts.empty() && left / static_cast<long>(starts.size()) < 2 * kOfPlan) {
      starts.pop_back();
    }
    std::vector<Ascent> ascents(starts.size());
    parallel_for(options.threads, static_cast<long>(starts.size()), [&](long i) {
      const long share = std::min(kMostOfClimb, left / static_cast<long>(starts.size()));
      ascents[static_cast<std::size_t>(i)] =
          ascend(objective, problem, starts[static_cast<std::size_t>(i)].theta_r, share, run);
    });
    return conclude(ascents, run, found);
  }

 private:
  static Ascent ascend(const TrajectoryObjective& objective, const Problem& problem,
                       const Eigen::VectorXd& start, long budget, SearchRun& run) {
    Ascent ascent;
    Probe probe(objective, budget, run);
    ascent.plan = probe.evaluate(start);
    Shooting shooting(problem, [&probe] {
      if (probe.left() <= kOfPlan) return false;
      probe.spend();
      return true;
    });
    const Eigen::MatrixXd knots = unstacked(start, knots_of(problem));
    Eigen::VectorXd best = start;
    const auto look = [&](const Eigen::VectorXd& x) {
      const double value = probe.left() > 0 ? probe.evaluate(x) : -kInfinity;
      if (value > ascent.plan) {
        ascent.plan = value;
        best = x;
      }
      return value > -kInfinity;
    };
    const auto seen = [&](const Extremal& extremal) {
      for (const Eigen::MatrixXd& plan : plans_of(shooting, problem, extremal)) {
        const Eigen::VectorXd x =
            stacked(plan).cwiseMax(objective.lower()).cwiseMin(objective.upper());
        const Eigen::VectorXd from = best;
        if (look(x)) continue;
        for (const double share : kPlanRetreats) {
          if (look(from + share * (x - from))) break;
        }
      }
    };
    const double lightest = std::max(0.0, ascent.plan);
    ascent.climb = climb(shooting, problem, knots, lightest, seen);
    if (ascent.climb.extremal.nodes.empty() && lightest > 0) {
      ascent.climb = climb(shooting, problem, knots, 0, seen);
    }
    if (!ascent.climb.extremal.nodes.empty()) {
      ascent.switching =
          describe_switching(shooting, problem, ascent.climb.extremal, ascent.switches);
    }
    ascent.part = probe.take();
    ascent.part.calls.push_back({"pontryagin", ascent.climb.end, ascent.part.trace.evaluations()});
    return ascent;
  }

  static SearchResult conclude(const std::vector<Ascent>& ascents, const SearchRun& run,
                               Part& found) {
    std::vector<Part> parts;
    const Ascent* largest = nullptr;
    for (const Ascent& ascent : ascents) {
      parts.push_back(ascent.part);
      const Climb& climb = ascent.climb;
      if (climb.extremal.nodes.empty()) continue;
      if (!largest || climb.extremal.m > largest->climb.extremal.m) largest = &ascent;
    }
    join(parts, found);
    SearchResult result = make_result(found, run);
    if (!largest) {
      result.stopped = "no extremal was found";
      return result;
    }
    const Climb& climb = largest->climb;
    result.stopped = fmt::format(
        "{}: the largest extremal carries {:.5f} kg, its plan {:.5f} kg; {} switches: {}",
        climb.end, climb.extremal.m, largest->plan, largest->switches, largest->switching);
    if (climb.speed_excess > 0) {
      result.stopped += fmt::format("; {:.2f} % too fast", 100 * climb.speed_excess);
    }
    return result;
  }
};

}  // namespace

std::unique_ptr<Search> make_pontryagin() { return std::make_unique<Pontryagin>(); }

}  // namespace maxwrench
