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
    std::vector<Candidate> starts = options.starts;
    for (std::size_t i = 0;
         i < stages_.size() && whole.evaluations < options.budget && !whole.interrupted; ++i) {
      SearchOptions own = options;
      own.budget = share(i, options.budget - whole.evaluations);
      own.starts = starts;
      own.starts_wanted = i + 1 < stages_.size() ? kHandedOn : options.starts_wanted;
      if (options.progress) {
        own.progress = [&options, before = whole.evaluations](long evaluations) {
          options.progress(before + evaluations);
        };
      }
      SearchResult result = stages_[i]->make()->maximize(objective, own);
      if (result.starts.empty() && result.status == Status::kBestFound)
        result.starts.push_back({result.theta_r, result.value});
      starts.insert(starts.end(), result.starts.begin(), result.starts.end());
      if (own.starts_wanted > 0)
        starts = select_apart(box, std::move(starts), kApart, own.starts_wanted);
      append(std::move(result), whole);
    }
    if (options.starts_wanted > 0) whole.starts = std::move(starts);
    return whole;
  }

 private:
  long share(std::size_t i, long left) const {
    const auto behind = static_cast<double>(stages_.size() - i);
    const double own = stages_[i]->budget_fraction > 0 ? stages_[i]->budget_fraction : 1 / behind;
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
