#pragma once

#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// Three ways to hand one wrench program to a general solver; all have the same optimum.
enum class ProgramForm {
  kPaper,        ///< F1: columns (u, h), and the rows (W W^+ - I) h = 0, some redundant
  kSubstituted,  ///< F2: columns (u, w), as `assemble` gives it
  kReduced,      ///< F3: the smallest, see `reduce`
};
const char* to_string(ProgramForm form);

LinearProgram make_form(const WrenchProgram& program, ProgramForm form);

/// F3. A directly driven joint j is known from w, u_j = (tau_d + J'W w)_i / B_ij. With one column
/// its limits are bounds on w; with several it is a row between two limits (whose logical column
/// carries them). If the rest of the rows are as many as the columns w and these are free, they
/// give w = (J'W)^-1 (B u - tau_d), and only the efforts of the thrusters and one row for each
/// joint are left. Then the optimum lies below that of the program by a constant, the `offset`.
struct Reduced {
  LinearProgram program;
  double offset = 0;
};
Reduced reduce(const WrenchProgram& program);

}  // namespace maxwrench
