#pragma once

#include <string>

#include "solvers/search/row_program.h"

namespace maxwrench {

/// Where a local solve ended, and the library's status.
struct RowEnd {
  Eigen::VectorXd y;
  std::string status;
};

/// A local solve by SLSQP of NLopt (Kraft 1994) from `program.start()`: sequential quadratic
/// programs with exact first derivatives, at most `points` points. SLSQP needs a number at every
/// point: where the rows have no values, all of them appear violated by ten of their units, so that
/// SLSQP shortens its step.
RowEnd solve_rows_by_slsqp(RowProgram& program, int points);

}  // namespace maxwrench
