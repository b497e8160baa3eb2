#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maxwrench/plan.h"
#include "solvers/search/knot_climber.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

constexpr std::size_t kBatch = 8;  // climbs that compete
constexpr long kFewest = 6;        // evaluations of a climb that are worth a batch
constexpr int kIdleBatches = 2;    // batches without a better plan before the search ends
constexpr double kBetter = 1e-5;   // relative to 1 + |f|
/// The climbs that go on, and the evaluations of each by then.
constexpr std::pair<std::size_t, long> kClimbRounds[] = {{kBatch, 19}, {4, 33}, {2, 61}, {1, 400}};

/// What was found, and whether its best plan is worth the same between its instants.
struct SlpOutcome {
  Part found;
  bool honest = false;

  bool beats(const SlpOutcome& other) const {
    if (honest != other.honest) return honest;
    return found.best.value > other.found.best.value;
  }
};

bool is_honest(KnotClimber& climber, EvaluationCounter& progress) {
  const long before = climber.found().trace.evaluations();
  const bool honest = climber.is_honest();
  progress.add(climber.found().trace.evaluations() - before);
  return honest;
}

/// Climbs that compete in rounds, side by side; all that they found, and the best honest plan or
/// else the best.
SlpOutcome compete(const Objective& objective, std::vector<Candidate> starts, long budget,
                   int threads, EvaluationCounter& progress) {
  std::vector<std::unique_ptr<KnotClimber>> climbers;
  for (Candidate& start : starts) {
    climbers.push_back(std::make_unique<KnotClimber>(objective.clone(), start));
  }
  const long share = budget / static_cast<long>(climbers.size()) - KnotClimber::kJudgement;
  std::vector<KnotClimber*> running;
  for (const auto& climber : climbers) running.push_back(climber.get());
  const auto sort = [&] {
    std::stable_sort(running.begin(), running.end(),
                     [](const auto* a, const auto* b) { return a->value() > b->value(); });
  };
  SlpOutcome outcome;
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
  outcome.found.best = running.front()->found().best;
  for (KnotClimber* climber : running) {
    if (!is_honest(*climber, progress)) continue;
    outcome.found.best = climber->found().best;
    outcome.honest = true;
    break;
  }
  std::vector<Trace> traces;
  for (const auto& climber : climbers) traces.push_back(climber->found().trace);
  outcome.found.trace.append(traces);
  return outcome;
}

/// Without the values above that of the plan that was chosen.
SearchResult make_result(const SlpOutcome& outcome) {
  SearchResult result = make_result(outcome.found);
  std::erase_if(result.history, [&](const Improvement& i) { return i.value > result.value; });
  const bool complete = !result.history.empty() && result.history.back().value == result.value;
  if (result.status == Status::kBestFound && !complete) {
    result.history.push_back({result.evaluations, result.value});
  }
  return result;
}

/// Sequential linear programming from many starts. Of the best start and the ends of all climbs it
/// takes the best plan that is worth the same between its instants (`KnotClimber::is_honest`), or
/// the best if there is none.
class Slp : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options);
    if (objective.plans() == nullptr) {
      throw std::invalid_argument(
          "search: got slp, which serves linf_polytope without a second contact or joints that "
          "follow, expected another one");
    }
    EvaluationCounter progress(options.progress);
    SlpOutcome best;
    std::vector<Candidate> starts = find_knot_starts(objective, options, progress, best.found);
    if (!starts.empty() &&
        options.budget - best.found.trace.evaluations() >= KnotClimber::kJudgement) {
      KnotClimber judge(objective.clone(), best.found.best);
      best.honest = is_honest(judge, progress);
      best.found.trace.append(judge.found().trace);
    }
    int idle = 0;
    while (!starts.empty() && idle < kIdleBatches && !objective.ended()) {
      const auto batch = static_cast<std::ptrdiff_t>(std::min(kBatch, starts.size()));
      const long left = options.budget - best.found.trace.evaluations();
      if (left < kFewest * batch) break;
      SlpOutcome climbs = compete(objective, {starts.begin(), starts.begin() + batch}, left,
                                  options.threads, progress);
      starts.erase(starts.begin(), starts.begin() + batch);
      const double wanted = best.found.best.value + kBetter * (1 + std::abs(best.found.best.value));
      const bool better = climbs.beats(best);
      idle = better && (!best.honest || climbs.found.best.value > wanted) ? 0 : idle + 1;
      best.found.trace.append(climbs.found.trace);
      if (!better) continue;
      best.found.best = climbs.found.best;
      best.honest = climbs.honest;
    }
    return make_result(best);
  }
};

}  // namespace

std::unique_ptr<Search> make_slp() { return std::make_unique<Slp>(); }

}  // namespace maxwrench
