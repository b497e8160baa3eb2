#pragma once

#include <string>

#include "maxwrench/linear_program.h"

namespace maxwrench {

/// The program as free MPS that maximises (section OBJSENSE), with 17 digits, so that reading it
/// gives the same numbers. Blanks in names become '_'; missing names are r1.. and x1... Throws
/// std::invalid_argument on names that collide or crossing bounds.
std::string mps_text(const LinearProgram& program, const std::string& name);

}  // namespace maxwrench
