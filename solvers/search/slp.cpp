#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"
#include "maxwrench/plan.h"
#include "solvers/search/knot_climber.h"
#include "solvers/search/makers.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

constexpr long kSamples = 96;      // at most, besides the start; at most a tenth of the budget
constexpr double kNear = 0.5;      // rad or m, around the start, of every other sample
constexpr std::size_t kBatch = 8;  // climbs that compete
constexpr long kFewest = 6;        // evaluations of a climb that are worth a batch
constexpr int kPatience = 2;       // batches without a better plan before the search ends
constexpr double kBetter = 1e-5;   // relative to 1 + |f|
/// The climbs that go on, and the evaluations of each by then.
constexpr std::pair<std::size_t, long> kRounds[] = {{kBatch, 13}, {4, 25}, {2, 45}, {1, 400}};

/// Tables around the start that keep the rows of the limits: an offset for all knots alike, or, as
/// such a one leaves the start of a heave at once, for each knot.
class Starts {
 public:
  Starts(const Objective& objective, const KnotRows& rows, int knots, const Eigen::VectorXd& start)
      : objective_(objective), rows_(rows), knots_(knots), start_(start) {
    std::vector<Eigen::Index> equations;
    for (Eigen::Index row = 0; row < rows.r_min.size(); ++row) {
      if (rows.r_min[row] == rows.r_max[row]) equations.push_back(row);
    }
    const Eigen::MatrixXd R = rows.R;
    equations_ = R(equations, Eigen::all);
    if (!equations.empty()) inverse_ = pseudo_inverse(equations_);
  }

  Eigen::VectorXd draw(Random random, bool near) const {
    const Eigen::Index r = start_.size() / knots_;
    Eigen::VectorXd offset(start_.size());
    const bool alike = equations_.rows() == 0;
    for (Eigen::Index i = 0; i < start_.size(); ++i) {
      if (alike && i >= r) {
        offset[i] = offset[i - r];
        continue;
      }
      const double down = objective_.lower()[i] - start_[i], up = objective_.upper()[i] - start_[i];
      offset[i] =
          near ? std::clamp(random.uniform(-kNear, kNear), down, up) : random.uniform(down, up);
    }
    if (equations_.rows() > 0) offset -= inverse_ * (equations_ * offset);
    return (start_ + share(offset) * offset)
        .cwiseMax(objective_.lower())
        .cwiseMin(objective_.upper());
  }

 private:
  /// The share of a step from the start that the rows allow.
  double share(const Eigen::VectorXd& offset) const {
    const Eigen::VectorXd at = rows_.R * start_, moved = rows_.R * offset;
    double share = 1;
    for (Eigen::Index row = 0; row < at.size(); ++row) {
      if (std::abs(moved[row]) < 1e-12) continue;
      const double room = moved[row] > 0 ? rows_.r_max[row] - at[row] : rows_.r_min[row] - at[row];
      share = std::min(share, std::max(0.0, room / moved[row]));
    }
    return share;
  }

  const Objective& objective_;
  const KnotRows& rows_;
  int knots_;
  const Eigen::VectorXd start_;
  Eigen::MatrixXd equations_, inverse_;
};

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
  for (const auto& [count, evaluations] : kRounds) {
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
    PlanEvaluator* const plans = objective.plans();
    if (plans == nullptr) {
      throw std::invalid_argument(
          "search: got slp, which serves linf_polytope without a second contact or joints that "
          "follow, expected another one");
    }
    const Box box(objective);
    const Starts draw(objective, plans->rows(), plans->knots(), box.start(options.start));
    EvaluationCounter progress(options.progress);
    SlpOutcome best;
    std::vector<Candidate> starts = sample(objective, options, draw, box, progress, best.found);
    if (!starts.empty() &&
        options.budget - best.found.trace.evaluations() >= KnotClimber::kJudgement) {
      KnotClimber judge(objective.clone(), best.found.best);
      best.honest = is_honest(judge, progress);
      best.found.trace.append(judge.found().trace);
    }
    int idle = 0;
    while (!starts.empty() && idle < kPatience && !objective.ended()) {
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

 private:
  /// The start and tables around it that have a value, best first.
  static std::vector<Candidate> sample(const Objective& objective, const SearchOptions& options,
                                       const Starts& draw, const Box& box,
                                       EvaluationCounter& progress, Part& found) {
    const long count = std::clamp(options.budget / 10, 1L, kSamples + 1);
    const auto point = [&](long i) {
      if (i == 0) return box.start(options.start);
      return draw.draw(Random(options.seed, RandomUse::kSample, static_cast<std::uint64_t>(i)),
                       i % 2 == 1);
    };
    const std::vector<double> values =
        evaluate_all(objective, count, point, options.threads, progress);
    std::vector<Candidate> starts;
    for (long i = 0; i < count; ++i) {
      const double value = values[static_cast<std::size_t>(i)];
      found.trace.add(value);
      if (value == -kInfinity) continue;
      starts.push_back({point(i), value});
      if (value > found.best.value) found.best = starts.back();
    }
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
    return starts;
  }
};

}  // namespace

std::unique_ptr<Search> make_slp() { return std::make_unique<Slp>(); }

}  // namespace maxwrench
