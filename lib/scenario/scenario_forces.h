#pragma once

#include <stdexcept>

#include "maxwrench/scenario.h"
#include "maxwrench/types.h"

namespace maxwrench {

struct Posture;

/// The generalised forces of the wrenches and loads of a list of scenarios: at a posture, or
/// averaged over points.
class ScenarioForces {
 public:
  virtual ~ScenarioForces() = default;

  /// tau_d of the nominal robot (n).
  virtual const Eigen::VectorXd& tau_d() const = 0;
  /// Adds the generalised forces of a case to tau (n).
  virtual void add_load(const LoadCase& load, Eigen::VectorXd& tau) = 0;
  /// The posture. An average over points has none, and currents need one.
  virtual const Posture& posture() const {
    throw std::logic_error("currents: got an average over points, expected a posture");
  }
  /// tau = J'c (n).
  virtual void exert(const Vector6d& c, Eigen::VectorXd& tau) const = 0;
  /// The wrench of number i, without a ball.
  virtual Vector6d wrench(int i) const = 0;
  /// Axis i of the ball, times its radius.
  virtual Vector6d ball_axis(Eigen::Index i) const = 0;
};

}  // namespace maxwrench
