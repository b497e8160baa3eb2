#include <algorithm>

#include "solvers/search/knot_climber.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"
#include "solvers/search/slp_outcome.h"

namespace maxwrench {
namespace {

constexpr std::size_t kBatch = 8;  // climbs that compete
constexpr long kKicks = 24;        // tables near the best plan for a batch: many collide
constexpr int kIdleBatches = 3;    // without a better plan before the search ends
constexpr double kBetter = 1e-5;   // relative to 1 + |f|
/// The climbs that go on, and the evaluations of each by then.
constexpr std::pair<std::size_t, long> kClimbRounds[] = {{kBatch, 19}, {4, 33}, {2, 61}, {1, 400}};

/// Climbs that compete in rounds, side by side; all that they found, and the plan that is worth
/// most or, if none is worth anything, the best.
SlpOutcome compete(const Objective& objective, std::vector<Candidate> starts, long budget,
                   int threads, const SlpOutcome& best, EvaluationCounter& progress) {
  std::vector<std::unique_ptr<KnotClimber>> climbers;
  for (Candidate& start : starts) {
    climbers.push_back(std::make_unique<KnotClimber>(objective.clone(), start));
  }
  const long share = budget / static_cast<long>(climbers.size()) - kJudged;
  std::vector<KnotClimber*> running;
  for (const auto& climber : climbers) running.push_back(climber.get());
  const auto sort = [&] {
    std::stable_sort(running.begin(), running.end(),
                     [](const auto* a, const auto* b) { return a->value() > b->value(); });
  };
  SlpOutcome outcome = {{best.found.best, {}}, best.worth};
  for (const auto& [count, evaluations] : kClimbRounds) {
    running.resize(std::min(running.size(), count));
    parallel_for(threads, static_cast<long>(running.size()), [&, until = evaluations](long i) {
      KnotClimber& climber = *running[static_cast<std::size_t>(i)];
      const long before = climber.found().trace.evaluations();
      climber.climb(std::min(until, share));
      progress.add(climber.found().trace.evaluations() - before);
    });
    sort();
  }
  running.clear();
  for (const auto& climber : climbers) running.push_back(climber.get());
  sort();
  for (KnotClimber* climber : running) {
    if (climber->value() > outcome.worth) judge(*climber, progress, outcome);
  }
  std::vector<Trace> traces;
  for (const auto& climber : climbers) traces.push_back(climber->found().trace);
  outcome.found.trace.append(traces);
  return outcome;
}

/// Without the values above that of the plan that was chosen.
SearchResult make_result(const SlpOutcome& outcome, bool idle) {
  SearchResult result = make_result(outcome.found);
  result.stopped = idle ? "three batches of starts brought nothing better" : kBudgetSpent;
  std::erase_if(result.history, [&](const Improvement& i) { return i.value > result.value; });
  const bool complete = !result.history.empty() && result.history.back().value == result.value;
  if (result.status == Status::kBestFound && !complete) {
    result.history.push_back({result.evaluations, result.value});
  }
  return result;
}

/// Starts near the best plan, batch number `round` of them.
std::vector<Candidate> kick(Objective& objective, const SearchOptions& options, long round,
                            SlpOutcome& best, EvaluationCounter& progress) {
  const long left = options.budget - best.found.trace.evaluations();
  Part found = {best.found.best, {}};
  std::vector<Candidate> starts = kick_knots(objective, options, best.found.best, round * kKicks,
                                             std::min(kKicks, left), progress, found);
  best.found.trace.append(found.trace);
  return starts;
}

/// Sequential linear programming from many starts until a batch brings nothing better, then from
/// near the best plan until that brings nothing. Of the best start and the ends of all climbs it
/// takes the plan that is worth most at its instants and between them.
class Slp : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options);
    require_plans(objective, "slp");
    EvaluationCounter progress(options.progress);
    SlpOutcome best;
    std::vector<Candidate> starts = find_knot_starts(objective, options, progress, best.found);
    if (!starts.empty() && options.budget - best.found.trace.evaluations() >= kJudged) {
      KnotClimber climber(objective.clone(), best.found.best);
      judge(climber, progress, best);
      best.found.trace.append(climber.found().trace);
    }
    long kicks = 0;  // batches
    if (objective.dimension() == 0) starts.clear();
    int idle = 0;  // batches
    while (idle < kIdleBatches && !starts.empty() && !objective.ended()) {
      const long left = options.budget - best.found.trace.evaluations();
      const auto size = static_cast<std::ptrdiff_t>(std::min(kBatch, starts.size()));
      if (left < (kJudged + kFewestOfClimb) * size) break;
      SlpOutcome climbs = compete(objective, {starts.begin(), starts.begin() + size}, left,
                                  options.threads, best, progress);
      starts.erase(starts.begin(), starts.begin() + size);
      idle = best.improves(climbs.worth, climbs.found.best.value, kBetter) ? 0 : idle + 1;
      best.found.trace.append(climbs.found.trace);
      best.found.best = climbs.found.best;
      best.worth = climbs.worth;
      if (kicks > 0 || idle > 0 || starts.empty()) {
        starts = kick(objective, options, kicks++, best, progress);
      }
    }
    return make_result(best, idle == kIdleBatches);
  }
};

}  // namespace

std::unique_ptr<Search> make_slp() { return std::make_unique<Slp>(); }

}  // namespace maxwrench
