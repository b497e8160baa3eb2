#include "solvers/search/knot_starts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>

#include "lib/math/decompositions.h"
#include "lib/math/random.h"
#include "solvers/search/slp_run.h"

namespace maxwrench {
namespace {

constexpr long kSamples = 192;  // without the start; at most a tenth of the budget
constexpr long kEarlier = 8;    // points of an earlier search
constexpr long kNearOf = 4;     // every fourth table is near the start
constexpr double kNear = 0.5;   // [rad or m] distance of near tables, at most
constexpr double kBump = 1.2;   // [rad or m] the largest wave that is added to a transfer
constexpr int kWaves = 3;
constexpr double kFar = 0.8;      // rad or m, between starts of the same round
constexpr double kSame = 0.1;     // rad or m: closer starts belong to one family
constexpr long kAlike = 48;       // largest number of local searches with all knots alike
constexpr long kAlikeSteps = 30;  // evaluations of each; all together at most a fifth of the budget
constexpr double kKickReach[] = {0.05, 0.15, 0.4, 0.8};  // rad or m
constexpr double kHopeful = 0.8;  // families are at most (1 - this) (1 + |best|) below the best

/// Draws tables around the start that satisfy the rows of the limits.
class Drawing {
 public:
  Drawing(const Objective& objective, const TrajectoryEvaluator& trajectories,
          const Eigen::VectorXd& start)
      : objective_(objective),
        rows_(trajectories.rows()),
        start_(start),
        alike_(!trajectories.starts()),
        knots_(trajectories.knots()),
        between_(trajectories.starts() && trajectories.program().common) {
    std::vector<Eigen::Index> equations;
    for (Eigen::Index row = 0; row < rows_.r_min.size(); ++row) {
      if (rows_.r_min[row] == rows_.r_max[row]) equations.push_back(row);
    }
    const Eigen::MatrixXd R = rows_.R;
    equations_ = R(equations, Eigen::all);
    if (!equations.empty()) inverse_ = pseudo_inverse(equations_);
    const Eigen::Index moved = alike_ ? start.size() / trajectories.knots() : start.size();
    const Eigen::Index times = start.size() / moved;
    down_ = (objective.lower() - start).reshaped(moved, times).rowwise().maxCoeff();
    up_ = (objective.upper() - start).reshaped(moved, times).rowwise().minCoeff();
  }

  Eigen::VectorXd draw(Random random, bool near) const {
    if (between_) return bump(random, near ? kNear : kBump);
    Eigen::VectorXd offset(down_.size());
    for (Eigen::Index i = 0; i < offset.size(); ++i) {
      offset[i] = near ? std::clamp(random.uniform(-kNear, kNear), down_[i], up_[i])
                       : random.uniform(down_[i], up_[i]);
    }
    return moved(offset.replicate(start_.size() / offset.size(), 1));
  }

  /// Moves each number of the table by `reach` at most; with `alike`, each coordinate alike at all
  /// knots.
  Eigen::VectorXd kick(Random random, double reach, bool alike) const {
    const Eigen::Index drawn = alike ? down_.size() : start_.size();
    const Eigen::VectorXd offset =
        Eigen::VectorXd::NullaryExpr(drawn, [&] { return random.uniform(-reach, reach); });
    return moved(offset.replicate(start_.size() / drawn, 1)
                     .cwiseMax(objective_.lower() - start_)
                     .cwiseMin(objective_.upper() - start_));
  }

 private:
  /// Adds a smooth curve to each coordinate that vanishes at both ends of a transfer.
  Eigen::VectorXd bump(Random& random, double reach) const {
    const Eigen::Index r = start_.size() / knots_;
    Eigen::MatrixXd offset = Eigen::MatrixXd::Zero(r, knots_);
    for (int wave = 1; wave <= kWaves; ++wave) {
      const Eigen::RowVectorXd shape = Eigen::RowVectorXd::NullaryExpr(knots_, [&](Eigen::Index i) {
        return std::sin(wave * std::numbers::pi * static_cast<double>(i + 1) /
                        static_cast<double>(knots_ + 1)) /
               wave;
      });
      for (Eigen::Index j = 0; j < r; ++j) offset.row(j) += random.uniform(-reach, reach) * shape;
    }
    return moved(offset.reshaped()
                     .cwiseMax(objective_.lower() - start_)
                     .cwiseMin(objective_.upper() - start_));
  }

  Eigen::VectorXd moved(Eigen::VectorXd offset) const {
    if (equations_.rows() > 0) offset -= inverse_ * (equations_ * offset);
    return (start_ + share(offset) * offset)
        .cwiseMax(objective_.lower())
        .cwiseMin(objective_.upper());
  }

  /// The share of a step from the start that the rows permit.
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
  const Eigen::VectorXd& start_;
  bool alike_;  ///< whether the knots of a table move alike
  Eigen::Index knots_;
  bool between_;  ///< whether both ends are given: a transfer
  Eigen::MatrixXd equations_, inverse_;
  Eigen::VectorXd down_, up_;  ///< limits of the offset, for all knots if they move alike
};

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

/// Evaluates `count` tables and returns those that have a value.
std::vector<Candidate> with_value(const TrajectoryObjective& objective,
                                  const SearchOptions& options, long count,
                                  const std::function<Eigen::VectorXd(long)>& table, SearchRun& run,
                                  Part& found) {
  const bool guides = objective.counts() != TrajectoryValue::kAtInstants;
  const auto at_instants = guides ? objective.copy(TrajectoryValue::kAtInstants) : nullptr;
  std::vector<double> values = evaluate_all(at_instants ? *at_instants : objective, count, table,
                                            options.threads, run, guides);
  Part seen;
  add(values, table, seen);
  join({guides ? Part{{}, Trace({}, seen.trace.evaluations())} : seen}, found);
  std::vector<Candidate> valued;
  for (long i = 0; i < count; ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    if (value > -kInfinity) valued.push_back({table(i), value});
  }
  return valued;
}

/// Evaluates the start and drawn tables and returns those that have a value.
std::vector<Candidate> sample(const TrajectoryObjective& objective, const SearchOptions& options,
                              const Drawing& drawing, const Eigen::VectorXd& start, SearchRun& run,
                              Part& found) {
  const auto table = [&](long i) {
    if (i == 0) return start;
    const auto stream = static_cast<std::uint64_t>(i);
    return drawing.draw(Random(options.seed, RandomUse::kSample, stream), i % kNearOf == 1);
  };
  const long count = std::clamp(options.budget / 10, 1L, kSamples + 1);
  return with_value(objective, options, count, table, run, found);
}

/// The results of local searches with all knots alike.
std::vector<Candidate> optimise_alike(const TrajectoryObjective& objective,
                                      const SearchOptions& options,
                                      std::span<const Candidate> starts, SearchRun& run,
                                      Part& found) {
  const long count = std::min(static_cast<long>(starts.size()),
                              std::min(kAlike, options.budget / 5 / kAlikeSteps));
  std::vector<std::unique_ptr<SlpRun>> slp_runs;
  for (long i = 0; i < count; ++i) {
    slp_runs.push_back(
        std::make_unique<SlpRun>(objective, starts[static_cast<std::size_t>(i)], run, true));
  }
  parallel_for(options.threads, count, [&](long i) {
    SlpRun& slp_run = *slp_runs[static_cast<std::size_t>(i)];
    slp_run.optimise(kAlikeSteps);
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

}  // namespace

TrajectoryObjective* as_trajectories(Objective& objective) {
  return dynamic_cast<TrajectoryObjective*>(&objective);
}

TrajectoryObjective& require_trajectories(Objective& objective, const char* search) {
  if (TrajectoryObjective* trajectories = as_trajectories(objective)) return *trajectories;
  throw std::invalid_argument(std::string("search: got '") + search +
                              "', which supports only linf_polytope at a fixed pose without a "
                              "second contact, expected another search");
}

std::vector<Candidate> draw_knot_starts(TrajectoryObjective& objective,
                                        const SearchOptions& options, SearchRun& run, Part& found) {
  const Eigen::VectorXd start = Box(objective).start(options.start);
  if (start.size() == 0) {  // nothing to choose
    return with_value(
        objective, options, 1, [&](long) { return start; }, run, found);
  }
  const Drawing drawing(objective, objective.trajectories(), start);
  return spread(sample(objective, options, drawing, start, run, found));
}

std::vector<Candidate> kick_knots(TrajectoryObjective& objective, const SearchOptions& options,
                                  const Candidate& best, long first, long count, SearchRun& run,
                                  Part& found) {
  const Drawing drawing(objective, objective.trajectories(), best.theta_r);
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
      families(optimise_alike(objective, options, starts, run, found), starts.front().value);
  ordered.insert(ordered.end(), starts.begin(), starts.end());
  return ordered;
}

}  // namespace maxwrench
