#include "solvers/search/knot_starts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>

#include "lib/math/cubic_spline.h"
#include "solvers/search/knot_drawing.h"
#include "solvers/search/slp_run.h"

namespace maxwrench {
namespace {

constexpr long kSamples = 192;      // without the start; at most a tenth of the budget
constexpr long kEarlier = 8;        // points of an earlier search
constexpr long kNearOf = 4;         // every fourth table is near the start
constexpr double kFar = 0.8;        // rad or m, between starts of the same round
constexpr double kSame = 0.1;       // rad or m: closer starts belong to one family
constexpr std::size_t kAlike = 48;  // largest number of local searches with all knots alike
constexpr long kAlikeSteps = 30;  // evaluations of each; all together at most a fifth of the budget
/// The same of the coarser objective, with the local searches after those with all knots alike.
constexpr long kCoarseSamples = 384;
constexpr std::size_t kCoarseAlike = 96, kCoarseFree = 24;
constexpr long kCoarseAlikeSteps = 12, kCoarseFreeSteps = 24;
constexpr long kLeastCoarse = 120;  // budget with which each of these stages has a start
constexpr double kKickReach[] = {0.05, 0.15, 0.4, 0.8};  // rad or m
constexpr double kHopeful = 0.8;  // families are at most (1 - this) (1 + |best|) below the best

double distance(const Candidate& a, const Candidate& b) {
  return (a.theta_r - b.theta_r).lpNorm<Eigen::Infinity>();
}

bool is_near(const Candidate& start, std::span<const Candidate> others, double within) {
  return std::any_of(others.begin(), others.end(),
                     [&](const Candidate& other) { return distance(start, other) <= within; });
}

/// Sorts best first in rounds: each round takes the starts that are far from those it has taken.
std::vector<Candidate> spread(std::vector<Candidate> starts) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  std::vector<Candidate> ordered;
  while (!starts.empty()) {
    const std::size_t round = ordered.size();
    std::vector<Candidate> later;
    for (Candidate& start : starts) {
      const bool near = is_near(start, std::span(ordered).subspan(round), kFar);
      (near ? later : ordered).push_back(std::move(start));
    }
    starts = std::move(later);
  }
  return ordered;
}

/// The best start of each family that is good enough for a local search; `known` is the best value
/// so far.
std::vector<Candidate> families(std::vector<Candidate> starts, double known) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  const double best = starts.empty() ? known : std::max(known, starts.front().value);
  const double least = best - (1 - kHopeful) * (1 + std::abs(best));
  std::vector<Candidate> heads;
  for (Candidate& start : starts) {
    if (start.value >= least && !is_near(start, heads, kSame)) heads.push_back(std::move(start));
  }
  return heads;
}

/// The values of `count` tables at the instants, -infinity for those that have none. `coarse`: the
/// objective is not the function that the search maximises.
std::vector<double> evaluate_tables(const TrajectoryObjective& objective,
                                    const SearchOptions& options, long count,
                                    const std::function<Eigen::VectorXd(long)>& table,
                                    SearchRun& run, Part& found, bool coarse = false) {
  const bool throughout = objective.counts() != TrajectoryValue::kAtInstants;
  const bool guides = coarse || throughout;
  const auto at_instants = throughout ? objective.copy(TrajectoryValue::kAtInstants) : nullptr;
  std::vector<double> values = evaluate_all(at_instants ? *at_instants : objective, count, table,
                                            options.threads, run, guides);
  Part seen;
  add(values, table, seen);
  join({guides ? Part{{}, Trace({}, seen.trace.evaluations())} : seen}, found);
  return values;
}

/// Evaluates `count` tables and returns those that have a value.
std::vector<Candidate> with_value(const TrajectoryObjective& objective,
                                  const SearchOptions& options, long count,
                                  const std::function<Eigen::VectorXd(long)>& table, SearchRun& run,
                                  Part& found, bool coarse = false) {
  const std::vector<double> values =
      evaluate_tables(objective, options, count, table, run, found, coarse);
  std::vector<Candidate> valued;
  for (long i = 0; i < count; ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    if (value > -kInfinity) valued.push_back({table(i), value});
  }
  return valued;
}

/// Evaluates the start and drawn tables, `most` in all, and returns those that have a value.
std::vector<Candidate> sample(const TrajectoryObjective& objective, const SearchOptions& options,
                              const KnotDrawing& drawing, const Eigen::VectorXd& start, long most,
                              SearchRun& run, Part& found, bool coarse = false) {
  const auto table = [&](long i) {
    if (i == 0) return start;
    const auto stream = static_cast<std::uint64_t>(i);
    return drawing.draw(Random(options.seed, RandomUse::kSample, stream), i % kNearOf == 1);
  };
  const long count = std::clamp(options.budget / 10, 1L, most);
  return with_value(objective, options, count, table, run, found, coarse);
}

/// How local searches continue from starts.
struct Descent {
  bool alike;        ///< all knots take the same step
  std::size_t most;  ///< number of local searches
  long evaluations;  ///< of each; all together use at most a fifth of the budget
  bool coarse;       ///< the objective is not the function that the search maximises
};

/// The results of local searches from the first of the starts.
std::vector<Candidate> optimise(const TrajectoryObjective& objective, const SearchOptions& options,
                                std::span<const Candidate> starts, const Descent& descent,
                                SearchRun& run, Part& found) {
  const auto share = static_cast<std::size_t>(options.budget / 5 / descent.evaluations);
  std::vector<std::unique_ptr<SlpRun>> slp_runs;
  for (const Candidate& start : starts.first(std::min({starts.size(), descent.most, share}))) {
    slp_runs.push_back(
        std::make_unique<SlpRun>(objective, start, run, descent.alike, descent.coarse));
  }
  parallel_for(options.threads, static_cast<long>(slp_runs.size()), [&](long i) {
    SlpRun& slp_run = *slp_runs[static_cast<std::size_t>(i)];
    slp_run.optimise(descent.evaluations);
    run.add(slp_run.found().trace.evaluations());
  });
  std::vector<Candidate> ends;
  std::vector<Part> parts;
  for (const auto& slp_run : slp_runs) {
    ends.push_back(slp_run->at());
    parts.push_back(slp_run->found());
  }
  join(parts, found);
  return ends;
}

/// The clamped spline through a table of `knots` knots at another number of knots.
Eigen::VectorXd resampled(const Eigen::VectorXd& x, Eigen::Index knots, Eigen::Index wanted) {
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(knots, 0, 1);
  const std::span<const double> times(at.data(), static_cast<std::size_t>(knots));
  const Eigen::MatrixXd values = unstacked(x, knots).transpose();
  const Eigen::MatrixXd bends = clamped_spline_bends(times, values);
  Eigen::MatrixXd table(wanted, values.rows());
  for (Eigen::Index i = 0; i < wanted; ++i) {
    const SplineInstant instant =
        spline_at(times, static_cast<double>(i) / static_cast<double>(wanted - 1));
    Eigen::MatrixXd four(values.rows(), 4);
    four << values.middleCols<2>(instant.interval), bends.middleCols<2>(instant.interval);
    table.row(i) = (four * instant.weights.col(0)).transpose();
  }
  return stacked(table);
}

}  // namespace

TrajectoryObjective* as_trajectories(Objective& objective) {
  return dynamic_cast<TrajectoryObjective*>(&objective);
}

TrajectoryObjective& require_trajectories(Objective& objective, const char* search) {
  if (TrajectoryObjective* trajectories = as_trajectories(objective)) return *trajectories;
  throw std::invalid_argument(std::string("search: got '") + search +
                              "', which supports only linf_polytope at a fixed pose, without a "
                              "second contact and, at rest, without a list of scenarios, expected "
                              "another search");
}

std::vector<Candidate> draw_knot_starts(TrajectoryObjective& objective,
                                        const SearchOptions& options, SearchRun& run, Part& found) {
  const Eigen::VectorXd start = Box(objective).start(options.start);
  if (start.size() == 0) {  // nothing to choose
    return with_value(
        objective, options, 1, [&](long) { return start; }, run, found);
  }
  const KnotDrawing drawing(objective, objective.trajectories(), start);
  return spread(sample(objective, options, drawing, start, kSamples + 1, run, found));
}

std::vector<Candidate> kick_knots(TrajectoryObjective& objective, const SearchOptions& options,
                                  const Candidate& best, long first, long count, SearchRun& run,
                                  Part& found) {
  const KnotDrawing drawing(objective, objective.trajectories(), best.theta_r);
  const auto table = [&](long i) {
    const auto number = static_cast<std::uint64_t>(first + i);
    return drawing.kick(Random(options.seed, RandomUse::kKick, number),
                        kKickReach[number / 2 % std::size(kKickReach)], number % 2 == 0);
  };
  return with_value(objective, options, count, table, run, found);
}

std::vector<Candidate> earlier_starts(const TrajectoryObjective& objective,
                                      const SearchOptions& options, SearchRun& run, Part& found) {
  const long count = std::min(static_cast<long>(options.starts.size()), kEarlier);
  const auto table = [&](long i) { return options.starts[static_cast<std::size_t>(i)].theta_r; };
  return with_value(objective, options, std::min(count, options.budget), table, run, found);
}

std::vector<Candidate> find_knot_starts(TrajectoryObjective& objective,
                                        const SearchOptions& options, SearchRun& run, Part& found) {
  const std::vector<Candidate> starts = draw_knot_starts(objective, options, run, found);
  if (starts.empty() || objective.dimension() == 0 || objective.trajectories().starts())
    return starts;
  std::vector<Candidate> ordered =
      families(optimise(objective, options, starts, {true, kAlike, kAlikeSteps, false}, run, found),
               starts.front().value);
  ordered.insert(ordered.end(), starts.begin(), starts.end());
  return ordered;
}

std::vector<Candidate> find_coarse_starts(TrajectoryObjective& objective,
                                          const SearchOptions& options, SearchRun& run,
                                          Part& found) {
  const auto coarse = objective.dimension() > 0 ? objective.coarser() : nullptr;
  if (!coarse || options.budget < kLeastCoarse) return {};
  const Eigen::Index knots = objective.trajectories().knots(), few = coarse->trajectories().knots();
  const auto inside = [](const Objective& of, const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return x.cwiseMax(of.lower()).cwiseMin(of.upper());
  };
  const Eigen::VectorXd start = Box(objective).start(options.start);
  // First the start, which an interrupted search returns.
  const double given = evaluate_tables(
                           objective, options, 1, [&](long) { return start; }, run, found)
                           .front();
  const Eigen::VectorXd coarse_start = inside(*coarse, resampled(start, knots, few));
  const KnotDrawing drawing(*coarse, coarse->trajectories(), coarse_start);
  const std::vector<Candidate> drawn =
      spread(sample(*coarse, options, drawing, coarse_start, kCoarseSamples + 1, run, found, true));
  std::vector<Candidate> starts;
  if (run.ended() && given > -kInfinity) starts.push_back({start, given});
  if (drawn.empty() || run.ended()) return starts;
  const std::vector<Candidate> alike = families(
      optimise(*coarse, options, drawn, {true, kCoarseAlike, kCoarseAlikeSteps, true}, run, found),
      drawn.front().value);
  const std::vector<Candidate> free =
      optimise(*coarse, options, alike, {false, kCoarseFree, kCoarseFreeSteps, true}, run, found);
  // The whole and the half step to each from where all knots are alike: the whole one may collide.
  const std::vector<Candidate> best = families(free, -kInfinity);
  std::vector<Eigen::VectorXd> tables;
  for (const Candidate& end : best) {
    const auto from =
        std::find_if(free.begin(), free.end(),
                     [&](const Candidate& other) { return other.theta_r == end.theta_r; }) -
        free.begin();
    const Eigen::VectorXd base =
        inside(objective, resampled(alike[static_cast<std::size_t>(from)].theta_r, few, knots));
    const Eigen::VectorXd step = resampled(end.theta_r, few, knots) - base;
    const KnotDrawing steps(objective, objective.trajectories(), base);
    tables.push_back(steps.moved(step));
    tables.push_back(steps.moved(0.5 * step));
  }
  const auto table = [&](long i) { return tables[static_cast<std::size_t>(i)]; };
  const std::vector<double> values =
      evaluate_tables(objective, options, static_cast<long>(tables.size()), table, run, found);
  for (std::size_t i = 0; i < tables.size(); i += 2) {
    const std::size_t at = values[i + 1] > values[i] ? i + 1 : i;
    if (values[at] > -kInfinity) starts.push_back({tables[at], values[at]});
  }
  if (given > -kInfinity) starts.push_back({start, given});
  return starts;
}

}  // namespace maxwrench
