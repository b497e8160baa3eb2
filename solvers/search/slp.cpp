#include <algorithm>
#include <span>

#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"
#include "solvers/search/slp_outcome.h"
#include "solvers/search/slp_run.h"

namespace maxwrench {
namespace {

constexpr std::size_t kBatch = 8;        // local searches that compete
constexpr std::size_t kRankedBatch = 4;  // from starts that a coarser objective has ranked
constexpr long kKicks = 24;  // tables near the best trajectory for a batch, of which many collide
constexpr int kIdleBatches = 3;   // batches without a better trajectory before the search ends
constexpr double kBetter = 1e-5;  // relative to 1 + |f|
/// The numbers of local searches that continue, and the evaluations of each by then.
constexpr std::pair<std::size_t, long> kLocalSearchRounds[] = {
    {kBatch, 19}, {4, 33}, {2, 61}, {1, 400}};

/// Runs local searches that compete in rounds, in parallel. Returns all that they found, and the
/// trajectory with the largest value of the objective; if none has such a value, the one with the
/// largest value at its instants.
SlpOutcome compete(const TrajectoryObjective& objective, std::span<const Candidate> starts,
                   long budget, int threads, const SlpOutcome& best, SearchRun& run) {
  std::vector<std::unique_ptr<SlpRun>> slp_runs;
  for (const Candidate& start : starts) {
    slp_runs.push_back(std::make_unique<SlpRun>(objective, start, run));
  }
  const long share = budget / static_cast<long>(slp_runs.size()) - kJudged;
  std::vector<SlpRun*> running;
  for (const auto& slp_run : slp_runs) running.push_back(slp_run.get());
  const auto sort = [&] {
    std::stable_sort(running.begin(), running.end(),
                     [](const auto* a, const auto* b) { return a->value() > b->value(); });
  };
  SlpOutcome outcome = {{}, best.trajectory, best.worth};
  for (const auto& [count, evaluations] : kLocalSearchRounds) {
    running.resize(std::min(running.size(), count));
    parallel_for(threads, static_cast<long>(running.size()), [&, until = evaluations](long i) {
      SlpRun& slp_run = *running[static_cast<std::size_t>(i)];
      const long before = slp_run.found().trace.evaluations();
      slp_run.optimise(std::min(until, share));
      run.add(slp_run.found().trace.evaluations() - before);
    });
    sort();
  }
  running.clear();
  for (const auto& slp_run : slp_runs) running.push_back(slp_run.get());
  parallel_for(threads, static_cast<long>(running.size()), [&](long i) {
    SlpRun& slp_run = *running[static_cast<std::size_t>(i)];
    const long before = slp_run.found().trace.evaluations();
    slp_run.polish(share);
    run.add(slp_run.found().trace.evaluations() - before);
  });
  sort();
  for (SlpRun* slp_run : running) {
    if (slp_run->value() > outcome.worth) judge(*slp_run, run, outcome);
  }
  std::vector<Part> parts;
  for (const auto& slp_run : slp_runs) parts.push_back(slp_run->found());
  join(parts, outcome.found);
  return outcome;
}

/// Sequential linear programming from many starts until a batch finds nothing better, then from
/// near the best trajectory until that finds nothing better. The local searches maximise the value
/// at the instants. If the objective uses another value, it is evaluated at the best start and at
/// the ends of local searches.
class Slp : public Search {
 public:
  SearchResult maximize(Objective& given, const SearchOptions& options) override {
    check(options, given);
    TrajectoryObjective& objective = require_trajectories(given, "slp");
    SearchRun run(options);
    SlpOutcome best;
    const auto left = [&] { return options.budget - best.found.trace.evaluations(); };
    std::vector<Candidate> starts = earlier_starts(objective, options, run, best.found);
    std::vector<Candidate> own;
    if (left() > 0) own = find_coarse_starts(objective, options, run, best.found);
    const std::size_t batch = own.empty() ? kBatch : kRankedBatch;
    if (own.empty() && left() > 0) own = find_knot_starts(objective, options, run, best.found);
    starts.insert(starts.end(), own.begin(), own.end());
    if (!starts.empty() && left() >= SlpRun::kJudgement) {
      SlpRun slp_run(objective, *std::max_element(starts.begin(), starts.end(), is_less), run);
      best.trajectory = slp_run.best();
      judge(slp_run, run, best);
      join({slp_run.found()}, best.found);
    }
    long kicks = 0;  // batches
    if (objective.dimension() == 0) starts.clear();
    int idle = 0;  // batches
    while (idle < kIdleBatches && !starts.empty() && !run.ended()) {
      const std::size_t size = std::min(batch, starts.size());
      if (left() < (kJudged + kFewestOfLocalSearch) * static_cast<long>(size)) break;
      const SlpOutcome local_searches =
          compete(objective, std::span(starts).first(size), left(), options.threads, best, run);
      starts.erase(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(size));
      idle = best.improves(local_searches.worth, local_searches.trajectory.value, kBetter)
                 ? 0
                 : idle + 1;
      join({local_searches.found}, best.found);
      best.trajectory = local_searches.trajectory;
      best.worth = local_searches.worth;
      if (kicks > 0 || idle > 0 || starts.empty()) {
        starts = kick_knots(objective, options, best.trajectory, kicks++ * kKicks,
                            std::min(kKicks, left()), run, best.found);
      }
    }
    SearchResult result = make_result(best.found, run);
    result.stopped =
        idle == kIdleBatches ? "three batches of starts gave no improvement" : kBudgetSpent;
    return result;
  }

 private:
  static bool is_less(const Candidate& a, const Candidate& b) { return a.value < b.value; }
};

}  // namespace

std::unique_ptr<Search> make_slp() { return std::make_unique<Slp>(); }

}  // namespace maxwrench
