#include "solvers/search/composition.h"

#include <algorithm>
#include <cmath>

#include "maxwrench/strategies.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

constexpr long kHandedOn = 256;  // points

class Composition final : public Search {
 public:
  explicit Composition(std::span<const SearchEntry* const> stages)
      : stages_(stages.begin(), stages.end()) {}

  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options, objective);
    const Box box(objective);
    SearchResult whole;
    std::vector<Candidate> peaks = options.starts;
    for (std::size_t i = 0;
         i < stages_.size() && whole.evaluations < options.budget && !whole.interrupted; ++i) {
      SearchOptions own = options;
      own.budget = share(i, options.budget - whole.evaluations);
      own.starts = peaks;
      own.peaks = i + 1 < stages_.size() ? kHandedOn : options.peaks;
      if (options.progress) {
        own.progress = [&options, before = whole.evaluations](long evaluations) {
          options.progress(before + evaluations);
        };
      }
      SearchResult result = stages_[i]->make()->maximize(objective, own);
      if (result.peaks.empty() && result.status == Status::kBestFound)
        result.peaks.push_back({result.theta_r, result.value});
      peaks.insert(peaks.end(), result.peaks.begin(), result.peaks.end());
      if (own.peaks > 0) peaks = select_apart(box, std::move(peaks), kApart, own.peaks);
      append(std::move(result), whole);
    }
    if (options.peaks > 0) whole.peaks = std::move(peaks);
    return whole;
  }

 private:
  long share(std::size_t i, long left) const {
    const auto behind = static_cast<double>(stages_.size() - i);
    const double own = stages_[i]->share > 0 ? stages_[i]->share : 1 / behind;
    if (i + 1 == stages_.size()) return left;
    return std::max(1L, std::lround(own * static_cast<double>(left)));
  }

  static void append(SearchResult result, SearchResult& whole) {
    for (const Improvement& rise : result.history) {
      const double before = whole.history.empty() ? -kInfinity : whole.history.back().value;
      if (rise.value <= before) continue;
      whole.history.push_back({whole.evaluations + rise.evaluations, rise.value});
    }
    whole.evaluations += result.evaluations;
    whole.interrupted = result.interrupted;
    whole.calls.insert(whole.calls.end(), result.calls.begin(), result.calls.end());
    if (result.value <= whole.value) return;
    static_cast<Verdict&>(whole) = result;
    whole.theta_r = std::move(result.theta_r);
    whole.value = result.value;
  }

  std::vector<const SearchEntry*> stages_;
};

}  // namespace

std::unique_ptr<Search> make_composition(std::span<const SearchEntry* const> stages) {
  return std::make_unique<Composition>(stages);
}

}  // namespace maxwrench
