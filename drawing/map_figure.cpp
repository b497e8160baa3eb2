#include <stdexcept>

#include "maxwrench/map.h"

namespace maxwrench {
std::string map_figure(const CapabilityMap&) { throw std::invalid_argument("none"); }
}  // namespace maxwrench
