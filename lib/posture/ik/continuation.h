#pragma once

#include "lib/posture/ik/tool_chain.h"

namespace maxwrench {

/// Solves J_d y = b for J_d 6×d of full rank and b in its range, by elimination with row exchanges.
template <class T>
class PivotedLu {
 public:
  void factor(const Six<Vector6<T>>& J_d, int d);
  /// Whether a pivot, as a share of the largest entry of its column of J_d, is smaller than
  /// `threshold` times the largest share.
  bool is_singular(const Six<Vector6<T>>& J_d, double threshold) const;
  Six<T> solve(const Vector6<T>& b) const;

 private:
  std::array<Six<T>, 6> rows_;  ///< L below the diagonal, U on it and above
  std::array<int, 6> from_;     ///< the original index of each row
  Six<T> inverse_pivots_;
  int d_ = 0;
};

/// A path of (theta_r, X), 0 <= s <= 1: theta_r(s) = from + s (to - from) + s (1 - s) bend. X(s) is
/// either `pose`, moved and rotated by s twist, or the pose of the end effector at theta_r(s) and
/// y_from + s (y_to - y_from).
template <class T>
struct HomotopyPath {
  VectorX<T> from, to, bend;
  bool moves_pose = false;
  Pose<T> pose;                       ///< X(0), unless `moves_pose` is set
  Vector6d twist = Vector6d::Zero();  ///< [m; rad]
  Six<T> y_from{}, y_to{};
};

/// Tracks a solution y of X_e(theta_r, y) = X along a path. A step follows the polynomial of second
/// order through the last two tangents, then Newton's method corrects it. The first correction must
/// be small and each further one must contract; otherwise the step is quartered.
template <class T>
class Continuation {
 public:
  /// The chain must outlive this object.
  explicit Continuation(const ToolChain& chain);
  explicit Continuation(const ToolChain&&) = delete;

  /// Tracks y from s = 0 to 1, up to rounding. False if the steps would be too short, for example
  /// where solutions meet or go to infinity; y is then the last point.
  bool track(const HomotopyPath<T>& path, Six<T>& y);
  /// Newton's method at (theta_r, pose) from a nearby y; whether it converges.
  bool correct(const VectorX<T>& theta_r, const Pose<T>& pose, Six<T>& y);
  /// Newton's method from any y; whether it converges.
  bool seek(const VectorX<T>& theta_r, const Pose<T>& pose, Six<T>& y);
  /// Whether y is so far from real that rounding magnifies by more than `most`.
  bool is_far(const Six<T>& y, double most) const;
  /// Whether J_d is singular at the end of the last successful call.
  bool is_singular(double threshold) const { return J_d_.is_singular(state_.J, threshold); }
  /// The end effector at that point.
  const ToolState<T>& state() const { return state_; }

 private:
  void place(const HomotopyPath<T>& path, double s);
  double linearise(const Six<T>& y);
  bool contract(Six<T>& y, bool exact, double& first);
  Six<T> tangent();
  bool is_finite(const Six<T>& y) const;
  double least_error(const Six<T>& y) const;

  const ToolChain& chain_;
  const int d_, r_;
  VectorX<T> theta_r_, rate_;
  Pose<T> pose_;
  Vector6<T> twist_, error_;
  ToolState<T> state_, reference_;
  PivotedLu<T> J_d_;
};

/// The largest magnitude of a y_i.
template <class T>
double largest(const Six<T>& y, int d);

}  // namespace maxwrench
