#pragma once

#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include "maxwrench/status.h"

namespace maxwrench {

/// An initial value problem y' = f(t, y), y(t_0) = y_0, where t_0 is the first of the times that an
/// `Integrator` is asked for. One object serves one thread.
class Ode {
 public:
  virtual ~Ode() = default;
  virtual const Eigen::VectorXd& initial() const = 0;  ///< y_0, d
  int dimension() const { return static_cast<int>(initial().size()); }

  /// f(t, y) into the d entries of y_dot. False where f has no value; the integrator then tries a
  /// shorter step.
  virtual bool derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) = 0;

  /// d f/d y, d×d. False: not offered, the integrator differences f.
  virtual bool jacobian(double /*t*/, const Eigen::VectorXd& /*y*/, Eigen::MatrixXd& /*df_dy*/) {
    return false;
  }

  /// The integration ends where one of the `roots()` components of g(t, y), which has
  /// its size already, passes through zero.
  virtual int roots() const { return 0; }
  virtual void root(double /*t*/, const Eigen::VectorXd& /*y*/, Eigen::VectorXd& /*g*/) {}

  /// The same problem as F(t, y, y') = 0, for integrators of implicit equations: y' - f(t, y)
  /// unless the problem has a form of its own that saves a factorisation.
  virtual bool residual(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                        Eigen::VectorXd& F) {
    if (!derivative(t, y, F)) return false;
    F = y_dot - F;
    return true;
  }
};

struct IntegratorOptions {
  double relative_tolerance = 1e-8;  ///< of each step's error, of every component
  double absolute_tolerance = 1e-10;
  long max_steps = 10000;  ///< over the whole call
  double step = 1e-3;      ///< of methods with a fixed step, which ignore the tolerances
};

/// Throws std::invalid_argument, with one line, unless absolute tolerance and step are positive,
/// the relative tolerance is not negative, all are finite, and there is at least one step.
void check(const IntegratorOptions& options);

/// The points y[i] = y(t[i]) that an integration has passed.
struct OdeSolution : Verdict {
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
  /// unless the times increase and are at least two, and as `check`.
  virtual Status integrate(Ode& ode, const IntegratorOptions& options,
                           std::span<const double> times, OdeSolution& trajectory) = 0;
};

}  // namespace maxwrench
