#include "solvers/search/local_search.h"

#include <algorithm>

namespace maxwrench {
namespace {

/// The start of local search `number` if the earlier search has left none: `options.start`
/// for the first local search, random points for the others. Has no value if the probe's
/// evaluations run out first.
Candidate draw_start(Probe& probe, const Box& box, const SearchOptions& options, long number,
                     Random& random) {
  Candidate start;
  const auto evaluate = [&](const Eigen::VectorXd& theta_r) {
    start = {theta_r, probe.evaluate(theta_r)};
  };
  if (number == 0 && options.starts.empty()) evaluate(box.start(options.start));
  while (start.value == -kInfinity && probe.left() > 0) {
    evaluate(random_point(box, random));
  }
  return start;
}

/// Local search `number`, with all evaluations that the probe has left.
Part optimise_once(Probe& probe, const Box& box, const SearchOptions& options,
                   const LocalSearch& local_search, long number) {
  Random random(options.seed, RandomUse::kLocalSearch, static_cast<std::uint64_t>(number));
  const auto index = static_cast<std::size_t>(number);
  const Candidate start = index < options.starts.size()
                              ? options.starts[index]
                              : draw_start(probe, box, options, number, random);
  Call call{local_search.method, kBudgetUsed};
  const long drawn = probe.found().trace.evaluations();
  if (start.value > -kInfinity && probe.left() > 0)
    call.status = local_search.optimise(probe, box, start, random);
  Part part = probe.take();
  call.evaluations = part.trace.evaluations() - drawn;
  if (call.evaluations > 0) part.calls.push_back(call);
  return part;
}

}  // namespace

void multistart_from(const Objective& objective, const Box& box, const SearchOptions& options,
                     const LocalSearch& local_search, SearchRun& run, Part& found) {
  std::vector<std::unique_ptr<Probe>> probes;
  for (long begun = 0; begun < local_search.starts && !run.ended();) {
    const long left = options.budget - found.trace.evaluations();
    if (left <= 0) return;
    const long most = std::min(local_search.max_parallel, local_search.starts - begun);
    const long count = std::clamp(left / local_search.evaluations_per_run, 1L, most);
    while (static_cast<long>(probes.size()) < count) {
      probes.push_back(
          std::make_unique<Probe>(objective, 0, run, options.starts_wanted > 0 ? &box : nullptr));
    }
    std::vector<Part> parts(static_cast<std::size_t>(count));
    parallel_for(options.threads, count, [&](long i) {
      probes[i]->grant(left / count + (i < left % count ? 1 : 0));
      parts[i] = optimise_once(*probes[i], box, options, local_search, begun + i);
    });
    begun += count;
    join(parts, found);
  }
}

SearchResult multistart_search(Objective& objective, const SearchOptions& options,
                               const LocalSearch& local_search) {
  check(options, objective);
  const Box box(objective);
  SearchRun run(options);
  Part found;
  if (box.free() == 0) {
    Probe probe(objective, 1, run);
    probe.evaluate(box.start(options.start));
    found = probe.take();
  } else {
    multistart_from(objective, box, options, local_search, run, found);
  }
  return make_result(std::move(found), box, options, run);
}

}  // namespace maxwrench
