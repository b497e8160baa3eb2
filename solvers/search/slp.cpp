#include <algorithm>
#include <cmath>
#include <iterator>

#include "maxwrench/plan.h"
#include "solvers/search/knot_climber.h"
#include "solvers/search/knot_starts.h"
#include "solvers/search/makers.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

constexpr std::size_t kBatch = 8;  // climbs that compete
constexpr int kIdleBatches = 2;    // batches without a better plan before the search ends
constexpr double kBetter = 1e-5;   // relative to 1 + |f|
/// How far a plan that is worth nothing keeps away from one that is worth something.
constexpr double kRetreats[] = {0.97, 0.9, 0.75, 0.5};
/// Evaluations of one judgement.
constexpr long kJudged =
    KnotClimber::kJudgement + std::size(kRetreats) * (1 + KnotClimber::kJudgement);
/// The climbs that go on, and the evaluations of each by then.
constexpr std::pair<std::size_t, long> kClimbRounds[] = {{kBatch, 19}, {4, 33}, {2, 61}, {1, 400}};

/// What was found, and what its best plan is worth, see `KnotClimber::worth`.
struct SlpOutcome {
  Part found;
  double worth = -kInfinity;

  /// Whether a plan is better, by more than `margin` relative to 1 + |what counts|; of two that are
  /// worth nothing the one of higher value.
  bool improves(double its_worth, double its_value, double margin) const {
    const bool nothing = worth == -kInfinity && its_worth == -kInfinity;
    const double mine = nothing ? found.best.value : worth;
    const double other = nothing ? its_value : its_worth;
    return mine == -kInfinity ? other > mine : other > mine + margin * (1 + std::abs(mine));
  }
};

/// Makes the best plan of a climber the outcome's if it is worth more. One that is worth nothing
/// goes back some of the way from the outcome's.
void judge(KnotClimber& climber, EvaluationCounter& progress, SlpOutcome& outcome) {
  const long before = climber.found().trace.evaluations();
  Candidate plan = climber.found().best;
  double worth = climber.worth(plan);
  if (worth == -kInfinity && outcome.worth > -kInfinity) {
    const Eigen::VectorXd base = outcome.found.best.theta_r, way = plan.theta_r - base;
    for (const double share : kRetreats) {
      const Candidate between = climber.look(base + share * way);
      if (!(between.value > outcome.worth)) continue;
      worth = climber.worth(between);
      plan = between;
      if (worth > outcome.worth) break;
    }
  }
  progress.add(climber.found().trace.evaluations() - before);
  if (!outcome.improves(worth, plan.value, 0)) return;
  outcome.worth = worth;
  outcome.found.best = plan;
}

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
    int idle = 0;
    while (!starts.empty() && idle < kIdleBatches && !objective.ended()) {
      const auto batch = static_cast<std::ptrdiff_t>(std::min(kBatch, starts.size()));
      const long left = options.budget - best.found.trace.evaluations();
      if (left < (kJudged + kFewestOfClimb) * batch) break;
      SlpOutcome climbs = compete(objective, {starts.begin(), starts.begin() + batch}, left,
                                  options.threads, best, progress);
      starts.erase(starts.begin(), starts.begin() + batch);
      const bool better = best.improves(climbs.worth, climbs.found.best.value, kBetter);
      idle = better ? 0 : idle + 1;
      best.found.trace.append(climbs.found.trace);
      best.found.best = climbs.found.best;
      best.worth = climbs.worth;
    }
    return make_result(best);
  }
};

}  // namespace

std::unique_ptr<Search> make_slp() { return std::make_unique<Slp>(); }

}  // namespace maxwrench
