#pragma once

#include <string>

namespace maxwrench {

/// Processor, cores, system, compiler and version: what stands beside every measured time.
std::string describe_machine();

}  // namespace maxwrench
