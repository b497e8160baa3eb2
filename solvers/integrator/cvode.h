#pragma once

#include <memory>

#include "lib/integrator.h"

namespace maxwrench {

std::unique_ptr<Integrator> make_cvode();

}  // namespace maxwrench
