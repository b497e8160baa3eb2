#include <algorithm>
#include <span>

#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"
#include "solvers/search/slp_outcome.h"
#include "solvers/search/slp_run.h"

namespace maxwrench {
namespace {

constexpr std::size_t kBatch = 8;  // climbs that compete
constexpr long kKicks = 24;        // tables near the best plan for a batch: many collide
constexpr int kIdleBatches = 3;    // without a better plan before the search ends
constexpr double kBetter = 1e-5;   // relative to 1 + |f|
/// The climbs that go on, and the evaluations of each by then.
constexpr std::pair<std::size_t, long> kClimbRounds[] = {{kBatch, 19}, {4, 33}, {2, 61}, {1, 400}};

/// Climbs that compete in rounds, side by side; all that they found, and the plan that is worth
/// most or, if none is worth anything, the one of highest value at its instants.
SlpOutcome compete(const PlanObjective& objective, std::span<const Candidate> starts, long budget,
                   int threads, const SlpOutcome& best, SearchRun& run) {
  std::vector<std::unique_ptr<KnotClimber>> climbers;
  for (const Candidate& start : starts) {
    climbers.push_back(std::make_unique<KnotClimber>(objective, start, run));
  }
  const long share = budget / static_cast<long>(climbers.size()) - kJudged;
  std::vector<KnotClimber*> running;
  for (const auto& climber : climbers) running.push_back(climber.get());
  const auto sort = [&] {
    std::stable_sort(running.begin(), running.end(),
                     [](const auto* a, const auto* b) { return a->value() > b->value(); });
  };
  SlpOutcome outcome = {{}, best.plan, best.worth};
  for (const auto& [count, evaluations] : kClimbRounds) {
    running.resize(std::min(running.size(), count));
    parallel_for(threads, static_cast<long>(running.size()), [&, until = evaluations](long i) {
      KnotClimber& climber = *running[static_cast<std::size_t>(i)];
      const long before = climber.found().trace.evaluations();
      climber.climb(std::min(until, share));
      run.add(climber.found().trace.evaluations() - before);
    });
    sort();
  }
  running.clear();
  for (const auto& climber : climbers) running.push_back(climber.get());
  sort();
  for (KnotClimber* climber : running) {
    if (climber->value() > outcome.worth) judge(*climber, run, outcome);
  }
  std::vector<Part> parts;
  for (const auto& climber : climbers) parts.push_back(climber->found());
  join(parts, outcome.found);
  return outcome;
}

/// Sequential linear programming from many starts until a batch brings nothing better, then from
/// near the best plan until that brings nothing. It climbs by the value at the instants. If that is
/// not all that its objective counts, the objective is evaluated at the best start and at the ends
/// of climbs.
class Slp : public Search {
 public:
  SearchResult maximize(Objective& given, const SearchOptions& options) override {
    check(options, given);
    PlanObjective& objective = require_plans(given, "slp");
    SearchRun run(options);
    SlpOutcome best;
    const auto left = [&] { return options.budget - best.found.trace.evaluations(); };
    std::vector<Candidate> starts = find_knot_starts(objective, options, run, best.found);
    if (!starts.empty() && left() >= KnotClimber::kJudgement) {
      KnotClimber climber(objective, *std::max_element(starts.begin(), starts.end(), is_less), run);
      best.plan = climber.best();
      judge(climber, run, best);
      join({climber.found()}, best.found);
    }
    long kicks = 0;  // batches
    if (objective.dimension() == 0) starts.clear();
    int idle = 0;  // batches
    while (idle < kIdleBatches && !starts.empty() && !run.ended()) {
      const std::size_t size = std::min(kBatch, starts.size());
      if (left() < (kJudged + kFewestOfClimb) * static_cast<long>(size)) break;
      const SlpOutcome climbs =
          compete(objective, std::span(starts).first(size), left(), options.threads, best, run);
      starts.erase(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(size));
      idle = best.improves(climbs.worth, climbs.plan.value, kBetter) ? 0 : idle + 1;
      join({climbs.found}, best.found);
      best.plan = climbs.plan;
      best.worth = climbs.worth;
      if (kicks > 0 || idle > 0 || starts.empty()) {
        starts = kick_knots(objective, options, best.plan, kicks++ * kKicks,
                            std::min(kKicks, left()), run, best.found);
      }
    }
    SearchResult result = make_result(best.found, run);
    result.stopped =
        idle == kIdleBatches ? "three batches of starts brought nothing better" : kBudgetSpent;
    return result;
  }

 private:
  static bool is_less(const Candidate& a, const Candidate& b) { return a.value < b.value; }
};

}  // namespace

std::unique_ptr<Search> make_slp() { return std::make_unique<Slp>(); }

}  // namespace maxwrench
