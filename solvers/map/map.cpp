#include "maxwrench/map.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <span>

#include "lib/math/random.h"
#include "maxwrench/batch.h"
#include "maxwrench/certify.h"
#include "solvers/map/lattice.h"
#include "solvers/map/plan_check.h"
#include "solvers/solve/format.h"
#include "solvers/solve/method.h"
#include "solvers/solve/solve_from.h"

namespace maxwrench {
namespace {

using Index = Lattice::Index;

constexpr double kNoCellValue = std::numeric_limits<double>::quiet_NaN();
/// The budget of a level after level 0, as a divisor of that of level 0.
constexpr long kWarmShare = 5;
/// How many cells are computed between looks at whether the map was interrupted.
constexpr std::size_t kCellsAtOnce = 4096;
/// A cell is improved if a search from scratch exceeds it by more than this share.
constexpr double kImproved = 1e-3;

/// Whether a share of cells, drawn by their places alone, includes this one.
bool is_drawn(const Index& index, double share, std::uint64_t seed) {
  std::uint64_t state = seed;
  for (const long i : index) {
    state = Random(state, RandomUse::kSample, static_cast<std::uint64_t>(i)).next() >> 8U;
  }
  return Random(state, RandomUse::kSample, 0).uniform() < share;
}

/// Whether the bound of a cell with a value is as near as `gap` asks.
bool is_proven(const MapCell& cell, double gap) {
  return std::isfinite(cell.bound) && cell.bound - cell.beta <= gap * std::abs(cell.bound);
}

class MapMaker {
 public:
  MapMaker(const Problem& task, const MapPlan& plan, const Options& options)
      : task_(task),
        plan_(plan),
        options_(options),
        lattice_(plan),
        threads_(thread_count(options.threads)) {
    options_.threads = 1;
    options_.progress = {};
  }

  void make() {
    for (int level = 0; level <= lattice_.grid_level(); ++level) {
      std::set<Index> places;
      for (const Index& cell : lattice_.shard_cells(level)) {
        if (ends()) return;
        for (Index& corner : lattice_.corners(cell, level)) places.insert(std::move(corner));
      }
      compute(places, level);
    }
    std::vector<Index> cells = lattice_.shard_cells(lattice_.grid_level());
    for (int level = lattice_.grid_level(); level < lattice_.last_level(); ++level) {
      std::set<Index> places;
      std::vector<Index> finer;
      for (const Index& cell : cells) {
        if (ends()) return;
        if (!changes_within(cell, level)) continue;
        for (Index& place : lattice_.halved(cell, level)) places.insert(std::move(place));
        const std::vector<Index> within = lattice_.children(cell, level);
        finer.insert(finer.end(), within.begin(), within.end());
      }
      compute(places, level + 1);
      cells = std::move(finer);
    }
  }

  std::vector<MapCell> take() {
    std::vector<MapCell> cells;
    for (auto& [index, cell] : cells_) cells.push_back(std::move(cell));
    return cells;
  }
  long computed() const { return computed_; }
  bool interrupted() const { return interrupted_; }

 private:
  /// Computes those places that are not known, in parallel: their starts are of earlier levels.
  void compute(const std::set<Index>& places, int level) {
    std::vector<const Index*> todo;
    for (const Index& place : places) {
      if (!cells_.contains(place)) todo.push_back(&place);
    }
    all_ += static_cast<long>(todo.size());
    for (std::size_t first = 0; first < todo.size() && !ends(); first += kCellsAtOnce) {
      compute_batch(std::span(todo).subspan(first, std::min(kCellsAtOnce, todo.size() - first)),
                    level);
    }
  }

  void compute_batch(std::span<const Index* const> todo, int level) {
    std::vector<MapCell> made(todo.size());
    parallel_for(threads_, static_cast<long>(todo.size()), [&](long i) {
      const Index& place = *todo[static_cast<std::size_t>(i)];
      std::optional<MapCell> known = plan_.known ? plan_.known(place) : std::nullopt;
      const bool whole = known && !lacks(*known);
      MapCell& cell = made[static_cast<std::size_t>(i)];
      cell = known ? std::move(*known) : solved(place, level);
      if (!whole) complete(cell);
      store(cell, !whole);
    });
    for (std::size_t i = 0; i < todo.size(); ++i) {
      if (made[i].status == Status::kBudgetExhausted) continue;
      cells_.emplace(*todo[i], std::move(made[i]));
    }
  }

  /// Whether the map was interrupted.
  bool ends() {
    if (options_.interrupted && options_.interrupted()) interrupted_ = true;
    return interrupted_;
  }

  /// Whether a cell lacks a check or a bound that the plan asks for.
  bool lacks(const MapCell& cell) const {
    return (!cell.scratch && is_drawn(cell.index, plan_.check, options_.seed)) ||
           (plan_.bound && cell.status == Status::kBestFound && !is_proven(cell, plan_.gap));
  }

  MapCell solved(const Index& place, int level) const {
    MapCell cell;
    cell.index = place;
    cell.at = lattice_.at(place);
    cell.level = level;
    cell.beta = kNoCellValue;
    if (options_.interrupted && options_.interrupted()) {
      cell.conclude(Status::kBudgetExhausted, "interrupted");
      return cell;
    }
    const auto task = std::make_shared<const Problem>(task_at(cell.at));
    std::vector<Eigen::VectorXd> near;
    Options options = options_;
    if (level > 0) {
      for (const Index& parent : lattice_.parents(place, level)) {
        const auto found = cells_.find(parent);
        if (found != cells_.end() && found->second.theta_r.size() > 0) {
          near.push_back(found->second.theta_r);
        }
      }
      options.budget = std::max(1L, options.budget / kWarmShare);
    }
    const Answer answer = solve_from(task, near, options);
    static_cast<Verdict&>(cell) = answer;
    cell.unit = answer.unit;
    cell.evaluations = answer.evaluations;
    if (!answer.has_value()) return cell;
    cell.beta = answer.beta();
    cell.theta_r = answer.posture.theta_r;
    cell.q = answer.posture.q;
    cell.base.resize(6);
    cell.base << answer.posture.base.p, rpy(answer.posture.base.R);
    return cell;
  }

  Problem task_at(const Eigen::VectorXd& at) const {
    Problem here = posed(task_, plan_.over, at);
    prepare_ik_solutions(here);
    return here;
  }

  /// Adds what the plan asks for beyond the value.
  void complete(MapCell& cell) const {
    if (cell.status == Status::kBudgetExhausted) return;
    if (!cell.scratch && is_drawn(cell.index, plan_.check, options_.seed)) {
      const Answer scratch = solve(task_at(cell.at), from_scratch_);
      if (scratch.status == Status::kBudgetExhausted) {
        cell.conclude(Status::kBudgetExhausted, "interrupted");
        return;
      }
      cell.scratch = scratch.has_value() ? scratch.beta() : -kInfinity;
    }
    if (!plan_.bound || cell.status != Status::kBestFound || is_proven(cell, plan_.gap)) return;
    ProofOptions how;
    how.gap = plan_.gap;
    how.seconds = plan_.seconds;
    const Proof proof = certify(task_at(cell.at), options_, how);
    if (options_.interrupted && options_.interrupted()) {
      cell.conclude(Status::kBudgetExhausted, "interrupted");
      return;
    }
    cell.bound = std::min(cell.bound, proof.bound);
  }

  void store(const MapCell& cell, bool is_new) {
    if (cell.status == Status::kBudgetExhausted) {
      interrupted_ = true;
      return;
    }
    const std::lock_guard guard(mutex_);
    if (is_new) ++computed_;
    if (is_new && plan_.computed) plan_.computed(cell);
    ++finished_;
    if (plan_.progress) plan_.progress(finished_, all_);
  }

  /// Whether the corners of a cell differ by more than the tolerance, or in status.
  bool changes_within(const Index& lower, int level) const {
    double least = kInfinity, most = -kInfinity, size = 0;
    int with_value = 0, without = 0;
    for (const Index& corner : lattice_.corners(lower, level)) {
      const auto found = cells_.find(corner);
      if (found == cells_.end()) return false;  // interrupted
      const bool has = found->second.status == Status::kBestFound;
      ++(has ? with_value : without);
      if (!has) continue;
      least = std::min(least, found->second.beta);
      most = std::max(most, found->second.beta);
      size = std::max(size, std::abs(found->second.beta));
    }
    return with_value > 0 && (without > 0 || most - least > plan_.tolerance * size);
  }

 public:
  /// The options of a search from scratch.
  void check_with(const Options& options) { from_scratch_ = options; }

 private:
  const Problem& task_;
  const MapPlan& plan_;
  Options options_, from_scratch_;
  Lattice lattice_;
  int threads_;
  std::map<Index, MapCell> cells_;
  std::mutex mutex_;
  long all_ = 0, finished_ = 0, computed_ = 0;
  std::atomic<bool> interrupted_ = false;
};

}  // namespace

Case with_map_search(const Problem& task, Case c) {
  if (c.search.empty()) {
    c.search = default_search(task, c.measure, c.wrench);
    // A second stage helps a single task; here the neighbours do more for the same cost.
    if (c.search == "facet_sqp+cmaes") c.search = "facet_sqp";
  }
  if (c.budget == 0) c.budget = kMapBudget;
  return c;
}

CapabilityMap map(const Problem& task, const MapPlan& plan, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  check_plan(task, plan);
  CapabilityMap result;
  result.task = std::make_shared<const Problem>(task);
  result.plan = plan;
  Options each = options;
  static_cast<Case&>(each) = with_map_search(task, options);
  const Method method = resolve(*result.task, each);
  result.choice = method.choice;
  if (plan.bound) require_bound(*result.task, plan, result.choice);
  result.unit = method.unit;
  result.unchanging = find_unchanging(task, plan, each);
  Options scratch = options;
  scratch.search.clear();
  scratch.budget = plan.check_budget;
  scratch.threads = 1;
  scratch.progress = {};
  MapMaker maker(*result.task, result.plan, each);
  maker.check_with(scratch);
  maker.make();
  result.cells = maker.take();
  result.computed = maker.computed();
  if (maker.interrupted()) {
    result.conclude(Status::kBudgetExhausted, "interrupted");
  } else if (result.best() != nullptr) {
    result.conclude(Status::kBestFound);
  } else {
    result.conclude(Status::kNoneFound, "no cell has a value");
  }
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

long CapabilityMap::checked() const {
  return std::count_if(cells.begin(), cells.end(),
                       [](const MapCell& cell) { return cell.scratch.has_value(); });
}

long CapabilityMap::improved() const {
  return std::count_if(cells.begin(), cells.end(), [](const MapCell& cell) {
    if (!cell.scratch || *cell.scratch == -kInfinity) return false;
    if (cell.status != Status::kBestFound) return true;
    return *cell.scratch - cell.beta > kImproved * std::abs(cell.beta);
  });
}

long CapabilityMap::proven() const {
  return std::count_if(cells.begin(), cells.end(), [this](const MapCell& cell) {
    return cell.status == Status::kBestFound && is_proven(cell, plan.gap);
  });
}

double CapabilityMap::widest_gap() const {
  double widest = 0;
  for (const MapCell& cell : cells) {
    if (cell.status != Status::kBestFound || cell.bound == cell.beta) continue;
    widest = std::max(widest, (cell.bound - cell.beta) / std::abs(cell.beta));
  }
  return widest;
}

const MapCell* CapabilityMap::best() const {
  const MapCell* best = nullptr;
  for (const MapCell& cell : cells) {
    if (cell.status != Status::kBestFound) continue;
    if (best == nullptr || cell.beta > best->beta) best = &cell;
  }
  return best;
}

}  // namespace maxwrench
