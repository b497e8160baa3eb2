#pragma once

#include <string>

#include "maxwrench/linear_program.h"

namespace maxwrench {

/// The program as free MPS that maximises (section OBJSENSE). Numbers have 17 digits, so that
/// reading them gives the same values. Blanks in names become '_'; missing names become r1.. and
/// x1... Throws std::invalid_argument on names that collide or on crossing bounds.
std::string mps_text(const LinearProgram& program, const std::string& name);

}  // namespace maxwrench
