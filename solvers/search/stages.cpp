#include "solvers/search/stages.h"

#include <algorithm>
#include <cmath>

#include "solvers/search/refine.h"

namespace maxwrench {
namespace {

constexpr double kSeparation = 0.05;  // of two starts, as a share of the bounds
constexpr long kStarts = 256;

Eigen::VectorXd uniform(const Box& box, Random random) {
  Eigen::VectorXd x(box.free());
  for (double& x_j : x) x_j = random.uniform();
  return x;
}

/// Samples the bounds; `found` gets its evaluations, the result its points with a value.
std::vector<Candidate> sample(const Objective& objective, const Box& box,
                              const SearchOptions& options, EvaluationCounter& progress,
                              Part& found) {
  const long count = box.free() == 0 ? 1 : std::max(1L, options.budget / 10);
  const Eigen::VectorXd start = box.start(options.start);
  const auto point = [&](long i) {
    return i == 0 ? start : box.theta_r(uniform(box, Random(options.seed, RandomUse::kSample, i)));
  };
  const std::vector<double> values =
      evaluate_all(objective, count, point, options.threads, progress);
  std::vector<Candidate> candidates;
  for (long i = 0; i < count; ++i) {
    found.trace.add(values[i]);
    if (values[i] == -kInfinity) continue;
    candidates.push_back({point(i), values[i]});
    if (values[i] > found.best.value) found.best = candidates.back();
  }
  return candidates;
}

}  // namespace

long parts_of(long budget) { return std::clamp(budget / 10000, 1L, 8L); }

SearchResult search_in_stages(Objective& objective, const SearchOptions& options, long parts,
                              const Climb& climb) {
  check(options);
  const Box box(objective);
  EvaluationCounter progress(options.progress);
  Part found;
  std::vector<Candidate> candidates = sample(objective, box, options, progress, found);
  if (box.free() == 0) return make_result(found);
  Sample sample;
  for (const Candidate& candidate : candidates)
    sample.scale = std::max(sample.scale, std::abs(candidate.value));
  candidates = select_apart(box, std::move(candidates), kSeparation, kStarts);
  for (const Candidate& start : candidates) sample.starts.push_back(box.unit(start.theta_r));

  const long climbing = options.budget / 2;
  std::vector<Part> climbs(std::min(parts, climbing));
  const long count = static_cast<long>(climbs.size());
  std::vector<std::vector<Candidate>> peaks(count);
  parallel_for(options.threads, count, [&](long i) {
    Probe probe(objective, climbing / count + (i < climbing % count ? 1 : 0), progress, &box);
    climb(probe, box, sample, i, Random(options.seed, RandomUse::kClimb, i));
    climbs[i] = probe.found();
    peaks[i] = probe.peaks();
  });
  join(climbs, found);
  for (const std::vector<Candidate>& each : peaks)
    candidates.insert(candidates.end(), each.begin(), each.end());

  RefineOptions refinement;
  refinement.step = 0.02;
  refinement.separation = kSeparation;
  refinement.ascents = 24;
  refinement.budget = options.budget - found.trace.evaluations();
  refinement.seed = options.seed;
  refinement.threads = options.threads;
  refine(objective, box, std::move(candidates), refinement, progress, found);
  return make_result(found);
}

}  // namespace maxwrench
