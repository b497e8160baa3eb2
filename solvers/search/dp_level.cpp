#include "solvers/search/dp_level.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>

namespace maxwrench {
namespace {

/// Number of states that are expanded at once; it does not depend on the threads.
constexpr std::size_t kExpanded = 8;
constexpr std::size_t kMostStates = 10'000'000;  // a gigabyte

}  // namespace

DpLevel::DpLevel(const ControlGrid& grid, std::vector<DpMotion>& motions, int threads,
                 SearchRun& run, Spend spend)
    : grid_(grid),
      motions_(motions),
      threads_(threads),
      run_(run),
      spend_(std::move(spend)),
      K_(motions.front().knots()) {}

/// Runs parts in parallel, each with the same share of the instants that are left. Returns whether
/// all of them ended by themselves.
bool DpLevel::run_batch(long parts, const std::function<void(long, DpMotion&)>& part) {
  const long share = left_ / parts;
  parallel_for(threads_, parts, [&](long p) {
    DpMotion& motion = motions_[static_cast<std::size_t>(p)];
    motion.begin(share, run_);
    part(p, motion);
  });
  long made = 0;
  bool ended = true;
  for (long p = 0; p < parts; ++p) {
    const DpMotion& motion = motions_[static_cast<std::size_t>(p)];
    made += motion.made();
    ended = ended && !motion.stopped();
  }
  left_ -= made;
  spend_(made);
  return ended;
}

/// Whether P_0 may be this cell: the given one if there is one.
bool DpLevel::starts_at(int cell) const { return !has_start() || cell == grid_.given(); }

void DpLevel::sort_followers(int i) {
  const std::vector<double>& V = V_[static_cast<std::size_t>(i)];
  std::vector<long>& order = order_[static_cast<std::size_t>(i)];
  order.resize(V.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](long pair) { return V[static_cast<std::size_t>(pair)]; };
  for (int cell = 0; cell < all_cells(); ++cell) {
    std::stable_sort(order.begin() + grid_.first(cell), order.begin() + grid_.first(cell + 1),
                     [&](long p, long q) { return at(p) > at(q); });
  }
}

/// V_i of all pairs that start at the cell b.
void DpLevel::bound_pairs(int i, int b, DpMotion& motion) {
  std::vector<double>& V = V_[static_cast<std::size_t>(i)];
  for (long pair = grid_.first(b); pair < grid_.first(b + 1) && !motion.stopped(); ++pair) {
    const int c = grid_.to(pair);
    double best = above_;
    if (is_last(i + 1)) {
      best = std::max(best, motion.at_knot(i + 1, grid_.at(b), grid_.at(c), grid_.at(b), best));
    } else {
      const auto next = static_cast<std::size_t>(i) + 1;
      for (long at = grid_.first(c); at < grid_.first(c + 1); ++at) {
        const long follower = order_[next][static_cast<std::size_t>(at)];
        const double then = V_[next][static_cast<std::size_t>(follower)];
        if (!(then > best)) break;
        const int d = grid_.to(follower);
        const double here = motion.at_knot(i + 1, grid_.at(b), grid_.at(c), grid_.at(d), best);
        best = std::max(best, std::min(here, then));
      }
    }
    V[static_cast<std::size_t>(pair)] = best > above_ ? best : -kInfinity;
  }
}

bool DpLevel::backward() {
  const auto pairs = static_cast<std::size_t>(grid_.pairs());
  V_.assign(static_cast<std::size_t>(K_), {});
  order_.assign(static_cast<std::size_t>(K_), {});
  const int cells = all_cells();
  const auto batch = static_cast<int>(motions_.size());
  for (int i = K_ - 2; i >= 0; --i) {
    V_[static_cast<std::size_t>(i)].assign(pairs, -kInfinity);
    // Only the given cell leads on from the given start.
    const int from = has_start() && i <= 1 ? grid_.given() : 0;
    for (int first = from; first < cells; first += batch) {
      const long parts = std::min(batch, cells - first);
      const bool done = run_batch(parts, [&](long p, DpMotion& motion) {
        bound_pairs(i, first + static_cast<int>(p), motion);
      });
      if (!done) return false;
    }
    sort_followers(i);
  }
  return true;
}

/// The states that follow. Of i = -1 the one whose first instant is evaluated.
void DpLevel::expand(const State& state, long number, DpMotion& motion,
                     std::vector<State>& children) {
  const auto a = grid_.at(state.a), b = grid_.at(state.b), c = grid_.at(state.c);
  const int next = state.i + 1;
  if (state.i < 0) {
    const double value = motion.at_knot(0, a, b, c, above_);
    const double bound = std::min(value, state.bound);
    if (bound > above_) children.push_back({0, state.a, state.b, state.c, value, bound, number});
    return;
  }
  const auto follow = [&](int d, double then) {
    const double value =
        std::min(state.value, motion.in_interval(state.i, a, b, c, grid_.at(d), above_));
    const double bound = std::min(value, then);
    if (bound > above_) children.push_back({next, state.b, state.c, d, value, bound, number});
  };
  if (is_last(next)) return follow(state.b, kInfinity);
  const std::size_t at = static_cast<std::size_t>(next);
  for (long p = grid_.first(state.c); p < grid_.first(state.c + 1) && !motion.stopped(); ++p) {
    const long follower = order_[at][static_cast<std::size_t>(p)];
    const double then = V_[at][static_cast<std::size_t>(follower)];
    if (!(then > above_)) break;
    follow(grid_.to(follower), then);
  }
}

bool DpLevel::forward(Result& result) {
  std::vector<State> states;
  const auto worse = [&](long p, long q) {
    const State &one = states[static_cast<std::size_t>(p)],
                &other = states[static_cast<std::size_t>(q)];
    if (one.bound != other.bound) return one.bound < other.bound;
    return one.i != other.i ? one.i < other.i : p > q;
  };
  std::priority_queue<long, std::vector<long>, decltype(worse)> queue(worse);
  const auto add = [&](const State& state) {
    states.push_back(state);
    queue.push(static_cast<long>(states.size()) - 1);
  };
  for (int b = 0; b < all_cells(); ++b) {
    if (!starts_at(b)) continue;
    if (K_ == 1) {
      add({-1, b, b, b});
      continue;
    }
    for (long pair = grid_.first(b); pair < grid_.first(b + 1); ++pair) {
      const double then = V_[0][static_cast<std::size_t>(pair)];
      const int c = grid_.to(pair);
      if (then > above_ && starts_at(c)) add({-1, c, b, c, kInfinity, then});
    }
  }
  std::unordered_map<std::uint64_t, double> known;
  const auto key = [&](const State& state) {
    const auto cells = static_cast<std::uint64_t>(grid_.cells()) + 1;
    std::uint64_t k = static_cast<std::uint64_t>(state.i);
    for (const int cell : {state.a, state.b, state.c}) {
      k = k * cells + static_cast<std::uint64_t>(cell);
    }
    return k;
  };
  std::vector<std::vector<State>> children(kExpanded);
  while (!queue.empty()) {
    std::vector<long> batch;
    while (!queue.empty() && batch.size() < kExpanded) {
      if (states[static_cast<std::size_t>(queue.top())].i == K_ - 1) break;
      batch.push_back(queue.top());
      queue.pop();
    }
    if (batch.empty()) break;  // the best one is complete
    const bool done = run_batch(static_cast<long>(batch.size()), [&](long p, DpMotion& motion) {
      const auto at = static_cast<std::size_t>(p);
      children[at].clear();
      expand(states[static_cast<std::size_t>(batch[at])], batch[at], motion, children[at]);
    });
    if (!done || states.size() > kMostStates) return false;
    for (std::size_t p = 0; p < batch.size(); ++p) {
      for (const State& child : children[p]) {
        const auto [at, is_new] = known.emplace(key(child), child.value);
        if (!is_new && !(child.value > at->second)) continue;
        at->second = child.value;
        add(child);
      }
    }
  }
  if (queue.empty()) return true;
  const long best = queue.top();
  result.value = states[static_cast<std::size_t>(best)].value;
  result.cells.assign(static_cast<std::size_t>(K_), 0);
  for (long at = best; at >= 0; at = states[static_cast<std::size_t>(at)].parent) {
    const State& state = states[static_cast<std::size_t>(at)];
    if (state.i >= 0) result.cells[static_cast<std::size_t>(state.i)] = state.b;
  }
  return true;
}

DpLevel::Result DpLevel::solve(double above, long instants) {
  above_ = above;
  left_ = instants;
  Result result;
  result.complete = backward() && forward(result);
  if (!result.complete) result = {};
  return result;
}

}  // namespace maxwrench
