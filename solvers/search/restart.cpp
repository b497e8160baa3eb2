#include "solvers/search/restart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "maxwrench/batch.h"
#include "maxwrench/objective.h"
#include "maxwrench/strategies.h"
#include "solvers/search/composition.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

constexpr long kSideBySide = 8;  // runs between two checks of the rule
constexpr double kSameOptimum = 1e-6;
constexpr long kGridRun = 1;        // after the run with the search's own start
constexpr double kGridShare = 0.4;  // of the evaluations of that run

/// The options of a run. All runs but the first begin at a random point.
SearchOptions options_of(const SearchOptions& whole, const Box& box, long run) {
  SearchOptions own = whole;
  own.threads = 1;
  if (run == 0) return own;
  Random random(whole.seed, RandomUse::kRestart, static_cast<std::uint64_t>(run));
  own.seed = random.next();
  own.start = random_point(box, random);
  return own;
}

/// The number of different values. Runs without a value count as one optimum.
long count_optima(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  long optima = 1;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double low = values[i - 1], high = values[i];
    optima += low != high && !(high - low <= kSameOptimum * (1 + std::abs(high))) ? 1 : 0;
  }
  return optima;
}

class Restart final : public Search {
 public:
  explicit Restart(const NamedSearch& of) : of_(of) {}

  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options, objective);
    const Box box(objective);
    SearchResult whole;
    Trace trace;
    std::vector<double> ends;
    const long size = restart_budget(objective.dimension());
    SearchRun run(options);
    while (trace.evaluations() < options.budget && !whole.interrupted) {
      const long left = options.budget - trace.evaluations();
      const long count = std::clamp(left / size, 1L, kSideBySide);
      std::vector<SearchResult> results(static_cast<std::size_t>(count));
      std::vector<std::unique_ptr<Objective>> objectives;
      for (long i = 0; i < count; ++i) objectives.push_back(objective.clone());
      parallel_for(options.threads, count, [&](long i) {
        SearchOptions own = options_of(options, box, static_cast<long>(ends.size()) + i);
        own.budget = std::min(size, left);
        own.progress = [&, before = 0L](long evaluations) mutable {
          run.add(evaluations - std::exchange(before, evaluations));
        };
        const auto at = static_cast<std::size_t>(i);
        results[at] = search_of(static_cast<long>(ends.size()) + i, options, box)
                          ->maximize(*objectives[at], own);
      });
      join(std::move(results), trace, ends, whole);
      const long optima = count_optima(ends);
      if (!enough_restarts(static_cast<long>(ends.size()), optima)) continue;
      whole.stopped = fmt::format("{} restarts ended in {} optim{}, another one is unlikely",
                                  ends.size(), optima, optima == 1 ? "um" : "a");
      break;
    }
    whole.starts = select_apart(box, std::move(whole.starts), kApart, options.starts_wanted);
    whole.evaluations = trace.evaluations();
    whole.history = trace.improvements();
    return whole;
  }

 private:
  /// The search of a run: over a line, one run continues from the peaks of a grid, so that a peak
  /// of half a percent of the line is found whatever the random starts are.
  std::unique_ptr<Search> search_of(long run, const SearchOptions& whole, const Box& box) const {
    static const SearchEntry grid = [] {
      SearchEntry entry = *find_search("grid").stages.front();
      entry.budget_fraction = kGridShare;
      return entry;
    }();
    if (run != kGridRun || box.free() != 1 || !whole.starts.empty()) return of_.make();
    std::vector<const SearchEntry*> stages{&grid};
    for (const SearchEntry* stage : of_.stages) {
      if (stage->accepts_starts) stages.push_back(stage);
    }
    return stages.size() == 1 ? of_.make() : make_composition(stages);
  }

  static void join(std::vector<SearchResult> results, Trace& trace, std::vector<double>& ends,
                   SearchResult& whole) {
    std::vector<Trace> traces;
    for (SearchResult& result : results) {
      traces.emplace_back(result.history, result.evaluations);
      ends.push_back(result.value);
      whole.interrupted = whole.interrupted || result.interrupted;
      whole.calls.insert(whole.calls.end(), result.calls.begin(), result.calls.end());
      whole.starts.insert(whole.starts.end(), result.starts.begin(), result.starts.end());
      if (result.value <= whole.value) continue;
      static_cast<Verdict&>(whole) = result;
      whole.theta_r = std::move(result.theta_r);
      whole.value = result.value;
    }
    trace.append(traces);
  }

  NamedSearch of_;
};

}  // namespace

bool enough_restarts(long runs, long optima) {
  return runs > optima + 2 && optima * (runs - 1) < (optima + 0.5) * (runs - optima - 2);
}

std::unique_ptr<Search> make_restart(const NamedSearch& of) {
  return std::make_unique<Restart>(of);
}

}  // namespace maxwrench
