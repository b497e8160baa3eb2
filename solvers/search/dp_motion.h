#pragma once

#include <memory>
#include <vector>

#include "lib/trajectory/instant_evaluator.h"
#include "maxwrench/batch.h"
#include "solvers/search/dp_grid.h"

namespace maxwrench {

/// Evaluations of instants for one part of a search: its own evaluator, the number that it may make
/// and the number that it made.
///
/// A motion is the uniform cubic B-spline with control points P_i, dt apart, of which the clamped
/// spline through the knots is one. At the share s of interval i, between knots i and i + 1,
///
///     theta_r = sum_j b_j(s) P_(i - 1 + j), j = 0 .. 3,
///
/// and likewise its derivatives. So the motion at knot i depends on three control points, and that
/// in an interval on four. The curve is in the hull of its control points, and its rate in that of
/// their differences divided by dt: if neighbours differ by q_dot_max dt at most, the speed limits
/// hold at all times.
class DpMotion {
 public:
  using Point = Eigen::Ref<const Eigen::VectorXd>;

  explicit DpMotion(const InstantSource& source);

  const InstantEvaluator& instants() const { return *instants_; }
  int knots() const { return instants_->maps().knots(); }
  /// The knot of the peak of an impulse, or -1; at other instants an impulse needs balance only.
  void set_peak(int peak) { peak_ = peak; }

  /// Begins a part: forgets the last instant, and may then evaluate this many. The run is asked
  /// whether it ended once per as many as the task has.
  void begin(long allowed, SearchRun& run);
  /// Whether the part ended because it may evaluate no more, or the run did.
  bool stopped() const { return stopped_; }
  long made() const { return made_; }

  /// The value at knot i with the control points a, b, c before, at and after it. Checks collisions
  /// if the value exceeds `above`; otherwise it does not matter.
  double at_knot(int i, const Point& a, const Point& b, const Point& c, double above);
  /// The least value of the instants after knot i until knot i + 1; or any value not above `above`
  /// if one of them is not.
  double in_interval(int i, const Point& a, const Point& b, const Point& c, const Point& d,
                     double above);

 private:
  double value(int instant, bool at_knot, double above);

  std::unique_ptr<InstantEvaluator> instants_;
  int peak_ = -1;
  long allowed_ = 0, made_ = 0, asks_every_;
  bool stopped_ = false;
  SearchRun* run_ = nullptr;
  Eigen::VectorXd theta_r_, rate_, acceleration_, q_;
};

}  // namespace maxwrench
