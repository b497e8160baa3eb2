#pragma once

#include <memory>

#include "lib/search.h"

namespace maxwrench {

std::unique_ptr<Search> make_mlsl();

}  // namespace maxwrench
