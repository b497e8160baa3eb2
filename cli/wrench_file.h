#pragma once

#include <string>

#include "lib/wrench_program.h"

namespace maxwrench {

/// Writes a wrench program of `problem` as an MPS file with physical names: a row for each base
/// axis (base_x .. base_yaw) and joint, a column for each actuator and wrench (w_fx .. w_mz where
/// it is along an axis, w_c where it is along c). Throws std::invalid_argument if the file cannot
/// be written.
void write_wrench_program(const Problem& problem, const WrenchProgram& program,
                          const std::string& file);

}  // namespace maxwrench
