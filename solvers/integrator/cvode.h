#pragma once

#include <memory>

#include "lib/integrator.h"

namespace maxwrench {

/// Backward differentiation formulas of orders 1 to 5 with Newton's method on a dense Jacobian, for
/// stiff problems: gradient flows near a maximum, a stiff load cell.
std::unique_ptr<Integrator> make_cvode();

/// Adams-Moulton formulas of orders 1 to 12 with a fixed-point iteration, for problems that are not
/// stiff.
std::unique_ptr<Integrator> make_cvode_adams();

}  // namespace maxwrench
