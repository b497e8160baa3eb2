#pragma once

#include <Eigen/Dense>

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

}  // namespace maxwrench
