#pragma once

#include <memory>

#include "lib/integrator.h"

namespace maxwrench {

/// The classical Runge-Kutta method of order 4 with steps of at most `IntegratorOptions::step`, the
/// same between two neighbouring times. It ignores the tolerances: a reference for those that
/// choose their own steps.
std::unique_ptr<Integrator> make_runge_kutta();

}  // namespace maxwrench
