#pragma once

#include <memory>

#include "maxwrench/integrator.h"

// Integrators.

namespace maxwrench {

/// ERKStep of ARKODE: an explicit Runge-Kutta method of order 5 with an embedded one of order 4
/// (Cash and Karp), which controls its steps by the error estimate. It ends where the right side
/// has no value; unlike the implicit methods, it does not try a shorter step.
std::unique_ptr<Integrator> make_arkode();

/// Backward differentiation formulas of orders 1 to 5 with Newton's method on a dense Jacobian, for
/// stiff problems: gradient flows near a maximum, a stiff load cell.
std::unique_ptr<Integrator> make_cvode();

/// Adams-Moulton formulas of orders 1 to 12 with a fixed-point iteration, for non-stiff problems.
std::unique_ptr<Integrator> make_cvode_adams();

/// IDA of SUNDIALS on the residual form F(t, y, y') = 0: backward differentiation formulas with
/// Newton's method on dF/dy + alpha dF/dy', by finite differences. y'(t_0) is f(t_0, y_0).
std::unique_ptr<Integrator> make_ida();

/// The classical Runge-Kutta method of order 4 with steps of at most `IntegratorOptions::step`, all
/// equal between two neighbouring times. It ignores the tolerances: a reference for methods that
/// choose their own steps.
std::unique_ptr<Integrator> make_runge_kutta();

}  // namespace maxwrench
