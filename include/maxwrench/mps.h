#pragma once

#include <string>

#include "maxwrench/linear_program.h"
#include "maxwrench/trajectory_program.h"
#include "maxwrench/wrench_program.h"

namespace maxwrench {

/// A linear program read from an MPS file, `rl <= a'z <= ru, zl <= z <= zu`, in equality form
/// `A [z; s] = b`. The objective keeps its columns; it is negated when the file minimises:
///
///   file objective = constant + (minimize ? -1 : +1) * c'x.
///
/// An equality row keeps its right-hand side b; every other row r gets b = 0 and a logical column
/// `s = a'z` with the row's range as bounds, coefficient -1 and the row's name. The `file_cols`
/// columns of the file come first.
struct MpsProgram {
  LinearProgram program;
  std::string name, objective_name;
  bool minimize = true;
  double constant = 0;
  int file_cols = 0;

  double objective(const LpSolution& solution) const {
    return constant + (minimize ? -1 : 1) * solution.objective;
  }
  /// d(file objective)/d(right-hand side), one for each row of the file.
  Eigen::VectorXd duals(const LpSolution& solution) const {
    return (minimize ? -1.0 : 1.0) * solution.lambda;
  }
  /// The file's own columns.
  Eigen::VectorXd point(const LpSolution& solution) const { return solution.x.head(file_cols); }
};

/// Reads fixed or free MPS. Conventions where the format is ambiguous: the constant is minus the
/// objective's RHS entry; the first N row is the objective and others are dropped; a negative upper
/// bound without a lower one makes the column free below; MI leaves the upper bound at +infinity; a
/// range R on an equality row gives [rhs - |R|, rhs] for R < 0 and [rhs, rhs + R] otherwise; of
/// several RHS, RANGES or BOUNDS sets the first counts; a lower bound below -1e25 or an upper one
/// above 1e25 is none; integrality is ignored. Throws std::invalid_argument that names the file,
/// the line and what was expected there, also on a number that is given twice.
MpsProgram read_mps(const std::string& path);

/// A wrench program of `problem` as the text of an MPS file with physical names: a row for each
/// base axis (base_x .. base_yaw) and joint, a column for each actuator and wrench (w_fx .. w_tz
/// where it is along an axis, w_c where it is along c).
std::string wrench_program_mps(const Problem& problem, const WrenchProgram& program);

/// The same of a trajectory program: names end with the number of the instant, counted from 0, such
/// as base_x.3. Besides, `t`; a row and a column `above_t` for each t <= c_w'w, and `rate.NAME`
/// from instant to instant.
std::string trajectory_program_mps(const Problem& problem, const TrajectoryProgram& program);

}  // namespace maxwrench
