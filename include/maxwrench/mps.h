#pragma once

#include <string>

#include "maxwrench/linear_program.h"
#include "maxwrench/trajectory_program.h"
#include "maxwrench/wrench_program.h"

/// @file
/// Reads and writes linear programs as MPS files.

namespace maxwrench {

/// A linear program from an MPS file, in equality form.
///
/// The file states rl <= a'z <= ru for each row and zl <= z <= zu; the program states A [z; s] = b.
/// The first `file_cols` columns are those of the file. An equality row keeps its right-hand side
/// b. Every other row gets b = 0 and a logical column s = a'z. This column has the range of the row
/// as bounds, the coefficient -1 and the name of the row. The objective keeps its columns, and is
/// negated if the file minimises:
///
///     file objective = constant + (minimize ? -1 : +1) * c'x
struct MpsProgram {
  LinearProgram program;  ///< the program in equality form
  std::string name,       ///< name of the program in the file
      objective_name;     ///< name of the objective row
  bool minimize = true;   ///< whether the file minimises
  double constant = 0;    ///< constant term of the file objective
  int file_cols = 0;      ///< number of columns of the file

  /// Returns the file objective of a solution.
  double objective(const LpSolution& solution) const {
    return constant + (minimize ? -1 : 1) * solution.objective;
  }
  /// Returns d(file objective)/d(right-hand side), one number for each row of the file.
  Eigen::VectorXd duals(const LpSolution& solution) const {
    return (minimize ? -1.0 : 1.0) * solution.lambda;
  }
  /// Returns the values of the `file_cols` columns of the file.
  Eigen::VectorXd point(const LpSolution& solution) const { return solution.x.head(file_cols); }
};

/// Reads a linear program from a file in fixed or free MPS format.
///
/// Where the format is ambiguous, these conventions apply:
///
/// * The constant is minus the RHS entry of the objective.
/// * The first N row is the objective; others are ignored.
/// * A negative upper bound without a lower bound removes the lower bound of the column.
/// * MI leaves the upper bound at +infinity.
/// * A range R on an equality row gives [rhs - |R|, rhs] for R < 0, otherwise [rhs, rhs + R].
/// * If there are several RHS, RANGES or BOUNDS sets, the first one counts.
/// * A lower bound below -1e25, or an upper bound above 1e25, means no bound.
/// * Integrality is ignored.
///
/// @throws std::invalid_argument that names the file, the line and what was expected there. A
///         number that is given twice is such an error.
MpsProgram read_mps(const std::string& path);

/// Returns a wrench program as the text of an MPS file with physical names.
///
/// There is a row for each free base axis (base_x .. base_yaw) and each joint. There is a column
/// for each actuator and each wrench column: w_fx .. w_tz if it is along an axis, w_c if it is
/// along c.
///
/// @param problem  the task
/// @param program  its wrench program
std::string wrench_program_mps(const Problem& problem, const WrenchProgram& program);

/// Returns a trajectory program as the text of an MPS file with physical names.
///
/// The names are those of `wrench_program_mps`, followed by the number of the instant from 0, such
/// as base_x.3. There are also the column `t`, a row and a column `above_t` for each t <= c_w'w,
/// and `rate.NAME` for the change of an effort from one instant to the next.
///
/// @param problem  the task
/// @param program  its trajectory program
std::string trajectory_program_mps(const Problem& problem, const TrajectoryProgram& program);

}  // namespace maxwrench
