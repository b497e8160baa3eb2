#pragma once

#include <functional>
#include <vector>

#include "solvers/search/dp_grid.h"
#include "solvers/search/dp_motion.h"

namespace maxwrench {

/// The best motion whose control points are on a grid: the largest least value over all instants,
///
///     max over P_0 .. P_K-1 of min over instants of value(instant),
///
/// exactly, by dynamic programming, for values of instants by themselves (`InstantEvaluator`). A
/// stage is a knot. A motion may change its acceleration, so the state at knot i is (P_i-1, P_i,
/// P_i+1), and the step to the next one takes P_i+2.
///
/// * Backward: with the instants at knots only, a state is a pair. V_i(P_i, P_i+1), the best least
///   value at the knots after i, is
///
///       V_i(b, c) = max over d of min(value at knot i + 1 (b, c, d), V_i+1(c, d)),   V_K-1 = inf.
///
///   It bounds what all instants after knot i can have. d is tried in the order of V_i+1, until no
///   other can be better.
/// * Forward: states are expanded in the order of the least value so far or, if that is smaller,
///   V_i. The first complete motion is therefore the best one (A* for bottlenecks).
///
/// States that cannot exceed a known value are left out.
class DpLevel {
 public:
  /// Called after each batch with the instants that it evaluated.
  using Spend = std::function<void(long instants)>;

  /// One of `motions` for each part of a batch.
  DpLevel(const ControlGrid& grid, std::vector<DpMotion>& motions, int threads, SearchRun& run,
          Spend spend);

  struct Result {
    bool complete = false;      ///< false: needs more instants than it was allowed, or interrupted
    double value = -kInfinity;  ///< -infinity: no motion exceeds `above`
    std::vector<int> cells;     ///< of the control points P_0 .. P_K-1
  };
  /// The best motion whose value exceeds `above`, if it takes at most this many instants.
  Result solve(double above, long instants);

 private:
  struct State {
    int i = -1;                ///< the last knot that was evaluated
    int a = 0, b = 0, c = 0;   ///< cells of P_i-1, P_i, P_i+1; of i = -1 those of i = 0
    double value = kInfinity;  ///< the least one so far
    double bound = kInfinity;  ///< of the complete motion
    long parent = -1;
  };
  bool backward();
  bool forward(Result& result);
  bool run_batch(long parts, const std::function<void(long, DpMotion&)>& part);
  void bound_pairs(int i, int b, DpMotion& motion);
  void sort_followers(int i);
  void expand(const State& state, long number, DpMotion& motion, std::vector<State>& children);
  bool is_last(int i) const { return i == K_ - 1; }
  bool has_start() const { return motions_.front().instants().maps().starts; }
  int all_cells() const { return grid_.cells() + (has_start() ? 1 : 0); }
  bool starts_at(int cell) const;

  const ControlGrid& grid_;
  std::vector<DpMotion>& motions_;
  int threads_;
  SearchRun& run_;
  Spend spend_;
  int K_;
  double above_ = -kInfinity;
  long left_ = 0;
  std::vector<std::vector<double>> V_;  ///< by knot and pair
  /// By knot and pair: the pairs from the same cell, best V_ first.
  std::vector<std::vector<long>> order_;
};

}  // namespace maxwrench
