#pragma once

#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include "maxwrench/status.h"

/// @file
/// Initial value problems and the interface of their integrators.

namespace maxwrench {

/// An initial value problem y' = f(t, y), y(t_0) = y_0.
///
/// t_0 is the first of the times that are passed to an `Integrator`. Use one object per thread.
class Ode {
 public:
  virtual ~Ode() = default;
  virtual const Eigen::VectorXd& initial() const = 0;  ///< Returns y_0 (d).
  /// Returns d, the number of components of y.
  int dimension() const { return static_cast<int>(initial().size()); }

  /// Computes f(t, y).
  ///
  /// @param t      the time
  /// @param y      the state (d)
  /// @param y_dot  receives f (d); the caller sets its size
  /// @return false where f has no value; the integrator then tries a shorter step
  virtual bool derivative(double t, const Eigen::VectorXd& y, Eigen::VectorXd& y_dot) = 0;

  /// Computes d f/d y.
  ///
  /// The arguments are t, y (d), and the d×d matrix that receives the result. The default returns
  /// false: the problem offers no Jacobian, and the integrator uses differences of f.
  virtual bool jacobian(double /*t*/, const Eigen::VectorXd& /*y*/, Eigen::MatrixXd& /*df_dy*/) {
    return false;
  }

  /// Returns the number of components of the root function g(t, y).
  ///
  /// The integration ends where one of them passes through zero.
  virtual int roots() const { return 0; }
  /// Computes g(t, y).
  ///
  /// The arguments are t, y (d), and the vector of `roots()` numbers that receives g. The caller
  /// sets its size.
  virtual void root(double /*t*/, const Eigen::VectorXd& /*y*/, Eigen::VectorXd& /*g*/) {}

  /// Computes the residual F(t, y, y') of the same problem, for integrators of implicit equations.
  ///
  /// The default is y' - f(t, y). A problem may override it with another form that saves a
  /// factorisation.
  ///
  /// @param t      the time
  /// @param y      the state (d)
  /// @param y_dot  its derivative y' (d)
  /// @param F      receives the residual (d)
  /// @return false where it has no value
  virtual bool residual(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& y_dot,
                        Eigen::VectorXd& F) {
    if (!derivative(t, y, F)) return false;
    F = y_dot - F;
    return true;
  }

  /// Computes d F/d y + alpha d F/d y' of the residual, for Newton's method.
  ///
  /// The arguments are t, y (d), y' (d), alpha, and the d×d matrix that receives the result. Terms
  /// that are small beside those that make the problem stiff may be left out. The default returns
  /// false: the problem offers no such matrix, and the integrator uses differences of F.
  virtual bool residual_jacobian(double /*t*/, const Eigen::VectorXd& /*y*/,
                                 const Eigen::VectorXd& /*y_dot*/, double /*alpha*/,
                                 Eigen::MatrixXd& /*dF*/) {
    return false;
  }
};

/// Tolerances and limits of an integration.
struct IntegratorOptions {
  double relative_tolerance = 1e-8;   ///< of the error of each step, for every component
  double absolute_tolerance = 1e-10;  ///< likewise, in the unit of the component
  long max_steps = 10000;             ///< largest number of steps of one call
  double step = 1e-3;                 ///< of methods with a fixed step, which ignore the tolerances
};

/// Checks the options of an integration.
///
/// @throws std::invalid_argument, with one line, unless the absolute tolerance and the step are
///         positive, the relative tolerance is not negative, all are finite, and `max_steps` is at
///         least 1.
void check(const IntegratorOptions& options);

/// The points y[i] = y(t[i]) that an integration has reached.
struct OdeSolution : Verdict {
  std::vector<double> t;           ///< the times
  std::vector<Eigen::VectorXd> y;  ///< the states (d) at these times
  int root = -1;  ///< the component of g that ended the integration at the last point; -1: none

  /// Removes all points and stores the initial value y_0 at t_0.
  void start(double t_0, const Eigen::VectorXd& y_0);
};

/// Integrates initial value problems.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Integrates an initial value problem and stores the solution at given times.
  ///
  /// @param ode         the problem
  /// @param options     tolerances and limits
  /// @param times       at least two increasing times; the first one is that of the initial value
  /// @param trajectory  receives the solution at `times` and its status; after a failure its last
  ///                    point is the last one that was reached
  /// @return kReached: all times were reached, or a root was, which is then the last point.
  ///         kBudgetExhausted: `max_steps` did not suffice. kNumericalError: no step was short
  ///         enough.
  /// @throws std::invalid_argument if the times are fewer than two or do not increase, or if
  ///         `check` throws.
  virtual Status integrate(Ode& ode, const IntegratorOptions& options,
                           std::span<const double> times, OdeSolution& trajectory) = 0;
};

}  // namespace maxwrench
