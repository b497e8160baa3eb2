#pragma once

#include <memory>

#include "lib/integrator.h"

namespace maxwrench {

/// ERKStep of ARKODE: an explicit Runge-Kutta method of order 5 with an embedded one of order 4
/// (Cash and Karp), its steps from the error estimate. Where the right side has no value it ends,
/// for unlike the implicit methods it does not try a shorter step.
std::unique_ptr<Integrator> make_arkode();

}  // namespace maxwrench
