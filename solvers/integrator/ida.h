#pragma once

#include <memory>

#include "lib/integrator.h"

namespace maxwrench {

/// IDA of SUNDIALS on the residual form F(t, y, y') = 0: backward differentiation formulas with
/// Newton's method on dF/dy + alpha dF/dy', differenced. y'(t_0) is f(t_0, y_0).
std::unique_ptr<Integrator> make_ida();

}  // namespace maxwrench
