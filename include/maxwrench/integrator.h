#pragma once

#include <span>
#include <string>
#include <vector>

#include "maxwrench/ode.h"
#include "maxwrench/status.h"

namespace maxwrench {

struct IntegratorOptions {
  double relative_tolerance = 1e-8;  ///< of each step's error, of every component
  double absolute_tolerance = 1e-10;
  long max_steps = 10000;  ///< over the whole call
  double step = 1e-3;      ///< of methods with a fixed step, which ignore the tolerances
};

/// The points y[i] = y(t[i]) that an integration has passed.
struct Trajectory : Verdict {
  std::vector<double> t;
  std::vector<Eigen::VectorXd> y;
  int root = -1;  ///< the component of g that ended the integration at the last point, or -1

  /// Forgets everything but the initial value.
  void start(double t_0, const Eigen::VectorXd& y_0);
};

/// Integrates initial value problems.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Fills the trajectory, its verdict included, with y at `times`, the first of which is that of
  /// the initial value. kReached: all times were reached, or a root was, which is then the last
  /// point. kBudgetExhausted: max_steps did not suffice. kNumericalError: no step was short enough.
  /// After these two the last point is the last one that was reached. Throws std::invalid_argument
  /// unless the times increase and are at least two, absolute tolerance and step are positive and
  /// the relative tolerance is not negative.
  virtual Status integrate(Ode& ode, const IntegratorOptions& options,
                           std::span<const double> times, Trajectory& trajectory) = 0;
};

}  // namespace maxwrench
