#include <algorithm>

#include "lib/math/random.h"
#include "solvers/search/makers.h"
#include "solvers/search/probe.h"

namespace maxwrench {
namespace {

/// The number of points evaluated at a time, which limits the memory.
constexpr long kBlock = 1L << 16U;

/// Uniformly random points within the bounds and nothing else: the reference that every other
/// search should improve on. Each point has its own stream.
class Sample final : public Search {
 public:
  SearchResult maximize(Objective& objective, const SearchOptions& options) override {
    check(options, objective);
    const Box box(objective);
    SearchRun run(options);
    const auto point = [&](long i) {
      Random random(options.seed, RandomUse::kSample, static_cast<std::uint64_t>(i));
      return random_point(box, random);
    };
    const long count = box.free() == 0 ? 1 : options.budget;
    Part found;
    for (long first = 0; first < count && !run.ended(); first += kBlock) {
      const long size = std::min(kBlock, count - first);
      const auto of_block = [&](long i) { return point(first + i); };
      std::vector<double> values = evaluate_all(objective, size, of_block, options.threads, run);
      add(values, of_block, found);
      for (long i = 0; options.starts_wanted > 0 && i < size; ++i) {
        if (values[i] > -kInfinity) found.starts.push_back({of_block(i), values[i]});
      }
      found.starts = select_apart(box, std::move(found.starts), kApart, options.starts_wanted);
    }
    return make_result(std::move(found), box, options, run);
  }
};

}  // namespace

std::unique_ptr<Search> make_sample() { return std::make_unique<Sample>(); }

}  // namespace maxwrench
