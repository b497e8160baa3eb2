#pragma once

#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// Three forms of one wrench program for a general solver, all with the same optimum.
enum class ProgramForm {
  kPaper,        ///< F1: columns (u, h), and the rows (W W^+ - I) h = 0, some redundant
  kSubstituted,  ///< F2: columns (u, w), the form of `assemble`
  kReduced,      ///< F3: the smallest, see `reduce`
};
const char* to_string(ProgramForm form);

LinearProgram make_form(const WrenchProgram& program, ProgramForm form);

/// F3. The effort of a directly driven joint j follows from w: u_j = (tau_d + J'W w)_i / B_ij. With
/// one column, its limits are bounds on w; with several, they give a row between two limits (which
/// the row's logical column carries). If the remaining rows are as many as the columns w and these
/// are free, they give w = (J'W)^-1 (B u - tau_d). Then only the efforts of the thrusters and one
/// row for each joint remain, and the optimum is lower than that of the program by a constant, the
/// `offset`.
struct Reduced {
  LinearProgram program;
  double offset = 0;
};
Reduced reduce(const WrenchProgram& program);

}  // namespace maxwrench
