#pragma once

#include <optional>
#include <vector>

#include "maxwrench/zonotope.h"
#include "solvers/certify/bound/loop_model.h"

namespace maxwrench {

/// What the thrusters add to the rows of tau through the force of a second contact, K u with
/// K = A B_f - B, at the control points of a box. A are the levers of the model. At each control
/// point u can be another one: that of the largest -lambda'K u within the limits.
class ThrustPoints {
 public:
  /// Keeps a reference to the model. B is that of all actuators, thrusters first.
  ThrustPoints(const LoopModel& model, const Zonotope& set, Eigen::Index thrusters);

  void set(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    points_ = &corners_.over(lower, upper);
  }
  /// Subtracts the largest -lambda'K u from g at each control point.
  void weigh(const Eigen::VectorXd& lambda, Eigen::VectorXd& g);
  /// The pattern of the u with the largest -lambda'K u at control point v, after `weigh`.
  int pattern(Eigen::Index v) const { return patterns_[place(v)]; }
  /// Adds K u of a pattern at control point v.
  void add(Eigen::Index v, int pattern, Eigen::VectorXd& load);
  /// Magnitudes of K u (n).
  const Eigen::VectorXd& sizes() const { return sizes_; }

 private:
  std::size_t place(Eigen::Index v) const { return static_cast<std::size_t>(v / repeat_); }

  const Eigen::Index n_, repeat_;  ///< rows, and control points with the same levers
  Eigen::MatrixXd B_;              ///< n×thrusters
  Eigen::VectorXd u_min_, u_max_, sizes_;
  ControlPoints corners_;
  const Eigen::MatrixXd* points_ = nullptr;
  std::vector<int> patterns_;
  Eigen::Vector3d weights_;
  Eigen::VectorXd slopes_, own_, u_;
};

}  // namespace maxwrench
